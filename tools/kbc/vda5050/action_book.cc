#include "tools/kbc/vda5050/action_book.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kb::vda5050 {
namespace {

constexpr std::size_t kMostOver = 1'000;        // of an order's actions that are over, so many are still in the state
constexpr std::size_t kMostInstantsOver = 100;
constexpr double kLongest_s = 1e9;
constexpr std::size_t kLongestResult = 1'000;   // bytes

}  // namespace

std::string_view status_name(Status status) {
  static constexpr std::string_view kNames[] = {"WAITING", "RUNNING", "PAUSED", "FINISHED", "FAILED"};
  return kNames[static_cast<std::size_t>(status)];
}

const Skill* ActionBook::skill(std::string_view type) const {
  const auto found = std::find_if(skills_.begin(), skills_.end(), [type](const Skill& skill) { return skill.type == type; });
  return found == skills_.end() ? nullptr : &*found;
}

const Doing* ActionBook::find(std::string_view id) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [id](const Doing& doing) { return doing.action.id == id; });
  return found == all_.end() ? nullptr : &*found;
}

void ActionBook::plan(const std::vector<Node>& nodes, const std::vector<Edge>& edges, bool first) {
  const auto add = [this](const std::vector<Action>& actions, Doing::Origin origin, std::uint32_t sequence) {
    for (const Action& action : actions) all_.push_back({action, origin, sequence});
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0) add(edges[i - 1].actions, Doing::Origin::kEdge, edges[i - 1].sequence);
    if (i > 0 || first) add(nodes[i].actions, Doing::Origin::kNode, nodes[i].sequence);
  }
  changed_ = true;
}

void ActionBook::forget_after(std::uint32_t sequence) {
  changed_ = std::erase_if(all_, [sequence](const Doing& doing) {
    return doing.origin != Doing::Origin::kInstant && doing.sequence > sequence;
  }) > 0 || changed_;
}

void ActionBook::forget_order() {
  changed_ = std::erase_if(all_, [](const Doing& doing) { return doing.origin != Doing::Origin::kInstant || doing.over(); }) > 0 || changed_;
}

void ActionBook::begin_instant(const Action& action) {
  all_.push_back({action, Doing::Origin::kInstant, 0});
  all_.back().triggered = true;
  start(all_.back());
}

void ActionBook::put_own(const Action& action, Status status, std::string result) {
  all_.push_back({action, Doing::Origin::kInstant, 0, status, std::move(result)});
  all_.back().own = true;
  changed_ = true;
}

void ActionBook::end_own(std::string_view id, Status status, std::string result) {
  for (Doing& doing : all_) {
    if (doing.own && doing.action.id == id && !doing.over()) end(doing, status, std::move(result));
  }
}

void ActionBook::trigger(Doing::Origin origin, std::uint32_t sequence) {
  for (Doing& doing : all_) {
    if (doing.origin == origin && doing.sequence == sequence && doing.status == Status::kWaiting) doing.triggered = true;
  }
}

void ActionBook::leave_edge(std::uint32_t sequence) {
  for (Doing& doing : all_) {
    if (doing.origin != Doing::Origin::kEdge || doing.sequence != sequence || doing.over()) continue;
    if (doing.doing()) end(doing, Status::kFinished, "");
    else end(doing, Status::kFailed, "the edge was left before it began");
  }
}

void ActionBook::cancel() {
  for (Doing& doing : all_) {
    if (doing.origin == Doing::Origin::kInstant || doing.over()) continue;
    if (doing.status == Status::kWaiting || doing.action.type == "waitForTrigger") end(doing, Status::kFailed, "the order was cancelled");
  }
}

void ActionBook::fail_order(const std::string& why) {
  for (Doing& doing : all_) {
    if (doing.origin != Doing::Origin::kInstant && !doing.over()) end(doing, Status::kFailed, why);
  }
}

void ActionBook::pause(bool on) {
  paused_ = on;
  for (Doing& doing : all_) {
    if (!doing.doing() || doing.own) continue;
    const Status status = on || doing.host_paused ? Status::kPaused : Status::kRunning;
    changed_ = changed_ || doing.status != status;
    doing.status = status;
  }
}

void ActionBook::pass(std::int64_t us) {
  if (paused_) return;
  for (Doing& doing : all_) {
    if (!doing.doing() || !doing.left_us) continue;
    *doing.left_us -= us;
    if (*doing.left_us <= 0) end(doing, Status::kFinished, "");
  }
}

void ActionBook::begin(bool stands) {
  if (paused_) return;
  if (hard_running()) return;
  bool running = any_running();
  for (Doing& doing : all_) {
    if (doing.status != Status::kWaiting || !doing.triggered) continue;
    const Blocking blocking = doing.action.blocking;
    const bool can = blocking == Blocking::kNone || (stands && (blocking == Blocking::kSoft || !running));
    if (can) start(doing);
    running = running || can;
    if (!can || blocking == Blocking::kHard) return;   // those behind it wait
  }
}

void ActionBook::hear(const DeedWord& word) {
  for (Doing& doing : all_) {
    if (doing.action.id != word.id || !doing.doing() || doing.own || doing.left_us) continue;
    const std::string result = word.result.substr(0, kLongestResult);
    if (word.status == "finished") return end(doing, Status::kFinished, result);
    if (word.status == "failed") {
      end(doing, Status::kFailed, result);
      return failures_.push_back(doing);
    }
    if (word.status != "paused" && word.status != "running") return;
    doing.host_paused = word.status == "paused";
    const Status status = paused_ || doing.host_paused ? Status::kPaused : Status::kRunning;
    if (status != doing.status || doing.result != result) changed_ = true;
    doing.status = status;
    doing.result = result;
    return;
  }
}

bool ActionBook::order_live() const {
  return std::any_of(all_.begin(), all_.end(), [](const Doing& doing) { return doing.origin != Doing::Origin::kInstant && !doing.over(); });
}

bool ActionBook::must_stand() const {
  return std::any_of(all_.begin(), all_.end(), [](const Doing& doing) {
    return doing.triggered && !doing.over() && doing.action.blocking != Blocking::kNone;
  });
}

bool ActionBook::hard_running() const {
  return std::any_of(all_.begin(), all_.end(), [](const Doing& doing) { return doing.doing() && !doing.own && doing.action.blocking == Blocking::kHard; });
}

bool ActionBook::any_running() const {
  return std::any_of(all_.begin(), all_.end(), [](const Doing& doing) { return doing.doing() && !doing.own; });
}

std::size_t ActionBook::instants_live() const {
  return static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), [](const Doing& doing) { return doing.origin == Doing::Origin::kInstant && !doing.over(); }));
}

std::size_t ActionBook::live() const {
  return static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), [](const Doing& doing) { return !doing.over(); }));
}

std::vector<Deed> ActionBook::deeds() const {
  std::vector<const Doing*> now;
  for (const Doing& doing : all_) {
    if (doing.doing() && !doing.own && !doing.left_us) now.push_back(&doing);
  }
  std::sort(now.begin(), now.end(), [](const Doing* a, const Doing* b) { return a->begun < b->begun; });
  std::vector<Deed> deeds;
  for (const Doing* doing : now) deeds.push_back({doing->action.id, doing->action.type, doing->action.parameters});
  return deeds;
}

bool ActionBook::take_changed() {
  if (changed_) tidy();
  return std::exchange(changed_, false);
}

std::vector<Doing> ActionBook::take_failures() { return std::exchange(failures_, {}); }

void ActionBook::start(Doing& doing) {
  doing.status = Status::kRunning;
  doing.begun = ++begun_;
  const Skill* how = skill(doing.action.type);
  if (how != nullptr && how->takes_s && std::isfinite(*how->takes_s)) doing.left_us = static_cast<std::int64_t>(std::llround(std::clamp(*how->takes_s, 0.0, kLongest_s) * 1e6));
  changed_ = true;
}

void ActionBook::end(Doing& doing, Status status, std::string result) {
  doing.status = status;
  doing.result = std::move(result);
  changed_ = true;
}

void ActionBook::tidy() {
  const auto forget = [this](bool instant, std::size_t most) {
    const auto counts = [instant](const Doing& doing) { return doing.over() && (doing.origin == Doing::Origin::kInstant) == instant; };
    auto over = static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), counts));
    std::erase_if(all_, [&](const Doing& doing) { return counts(doing) && over > most && over-- > 0; });
  };
  forget(false, kMostOver);
  forget(true, kMostInstantsOver);
}

}  // namespace kb::vda5050
