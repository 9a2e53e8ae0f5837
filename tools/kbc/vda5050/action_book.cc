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

const ActionState* ActionBook::find(std::string_view id) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [id](const ActionState& state) { return state.action.id == id; });
  return found == all_.end() ? nullptr : &*found;
}

void ActionBook::plan(const std::vector<Node>& nodes, const std::vector<Edge>& edges, bool first) {
  const auto add = [this](const std::vector<Action>& actions, ActionState::Origin origin, std::uint32_t sequence) {
    for (const Action& action : actions) all_.push_back({action, origin, sequence});
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0) add(edges[i - 1].actions, ActionState::Origin::kEdge, edges[i - 1].sequence);
    if (i > 0 || first) add(nodes[i].actions, ActionState::Origin::kNode, nodes[i].sequence);
  }
  changed_ = true;
}

void ActionBook::forget_after(std::uint32_t sequence) {
  changed_ = std::erase_if(all_, [sequence](const ActionState& state) {
    return state.origin != ActionState::Origin::kInstant && state.sequence > sequence;
  }) > 0 || changed_;
}

void ActionBook::forget_order() {
  changed_ = std::erase_if(all_, [](const ActionState& state) { return state.origin != ActionState::Origin::kInstant || state.over(); }) > 0 || changed_;
}

void ActionBook::begin_instant(const Action& action) {
  all_.push_back({action, ActionState::Origin::kInstant, 0});
  all_.back().triggered = true;
  start(all_.back());
}

void ActionBook::put_own(const Action& action, Status status, std::string result) {
  all_.push_back({action, ActionState::Origin::kInstant, 0, status, std::move(result)});
  all_.back().own = true;
  changed_ = true;
}

void ActionBook::end_own(std::string_view id, Status status, std::string result) {
  for (ActionState& state : all_) {
    if (state.own && state.action.id == id && !state.over()) end(state, status, std::move(result));
  }
}

void ActionBook::trigger(ActionState::Origin origin, std::uint32_t sequence) {
  for (ActionState& state : all_) {
    if (state.origin == origin && state.sequence == sequence && state.status == Status::kWaiting) state.triggered = true;
  }
}

void ActionBook::leave_edge(std::uint32_t sequence) {
  for (ActionState& state : all_) {
    if (state.origin != ActionState::Origin::kEdge || state.sequence != sequence || state.over()) continue;
    if (state.doing()) end(state, Status::kFinished, "");
    else end(state, Status::kFailed, "the edge was left before it began");
  }
}

void ActionBook::cancel() {
  for (ActionState& state : all_) {
    if (state.origin == ActionState::Origin::kInstant || state.over()) continue;
    const bool by_host = state.doing() && !state.left_us && state.action.type != "waitForTrigger";
    if (by_host) state.cancelled = true;
    else end(state, Status::kFailed, "the order was cancelled");
  }
}

void ActionBook::fail_order(const std::string& why) {
  for (ActionState& state : all_) {
    if (state.origin != ActionState::Origin::kInstant && !state.over()) end(state, Status::kFailed, why);
  }
}

void ActionBook::pause(bool on) {
  paused_ = on;
  for (ActionState& state : all_) {
    if (!state.doing() || !state.left_us) continue;
    const Status status = on ? Status::kPaused : Status::kRunning;
    changed_ = changed_ || state.status != status;
    state.status = status;
  }
}

void ActionBook::pass(std::int64_t us) {
  if (paused_) return;
  for (ActionState& state : all_) {
    if (!state.doing() || !state.left_us) continue;
    *state.left_us -= us;
    if (*state.left_us <= 0) end(state, Status::kFinished, "");
  }
}

void ActionBook::begin(bool stands) {
  if (paused_) return;
  if (hard_running()) return;
  bool running = any_running();
  for (ActionState& state : all_) {
    if (state.status != Status::kWaiting || !state.triggered) continue;
    const Blocking blocking = state.action.blocking;
    const bool can = blocking == Blocking::kNone || (stands && (blocking == Blocking::kSoft || !running));
    if (can) start(state);
    running = running || can;
    if (!can || blocking == Blocking::kHard) return;   // those behind it wait
  }
}

void ActionBook::hear(const HostActionState& report) {
  for (ActionState& state : all_) {
    if (state.action.id != report.id || !state.doing() || state.own || state.left_us) continue;
    const std::string result = report.result.substr(0, kLongestResult);
    if (report.status == "finished") return end(state, Status::kFinished, result);
    if (report.status == "failed") {
      end(state, Status::kFailed, result);
      if (!state.cancelled) failures_.push_back(state);
      return;
    }
    if (report.status != "paused" && report.status != "running") return;
    const Status status = report.status == "paused" ? Status::kPaused : Status::kRunning;
    if (status != state.status || state.result != result) changed_ = true;
    state.status = status;
    state.result = result;
    return;
  }
}

bool ActionBook::order_live() const {
  return std::any_of(all_.begin(), all_.end(), [](const ActionState& state) { return state.origin != ActionState::Origin::kInstant && !state.over(); });
}

bool ActionBook::must_stand() const {
  return std::any_of(all_.begin(), all_.end(), [](const ActionState& state) {
    return state.triggered && !state.over() && state.action.blocking != Blocking::kNone;
  });
}

bool ActionBook::hard_running() const {
  return std::any_of(all_.begin(), all_.end(), [](const ActionState& state) { return state.doing() && !state.own && state.action.blocking == Blocking::kHard; });
}

bool ActionBook::any_running() const {
  return std::any_of(all_.begin(), all_.end(), [](const ActionState& state) { return state.doing() && !state.own; });
}

std::size_t ActionBook::instants_live() const {
  return static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), [](const ActionState& state) { return state.origin == ActionState::Origin::kInstant && !state.over(); }));
}

std::size_t ActionBook::live() const {
  return static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), [](const ActionState& state) { return !state.over(); }));
}

std::vector<HostAction> ActionBook::host_actions() const {
  std::vector<const ActionState*> now;
  for (const ActionState& state : all_) {
    if (state.doing() && !state.own && !state.left_us) now.push_back(&state);
  }
  std::sort(now.begin(), now.end(), [](const ActionState* a, const ActionState* b) { return a->begun < b->begun; });
  std::vector<HostAction> actions;
  for (const ActionState* state : now) actions.push_back({state->action.id, state->action.type, state->action.parameters, paused_, state->cancelled});
  return actions;
}

bool ActionBook::take_changed() {
  if (changed_) tidy();
  return std::exchange(changed_, false);
}

std::vector<ActionState> ActionBook::take_failures() { return std::exchange(failures_, {}); }

void ActionBook::start(ActionState& state) {
  state.status = Status::kRunning;
  state.begun = ++begun_;
  const Skill* how = skill(state.action.type);
  if (how != nullptr && how->takes_s && std::isfinite(*how->takes_s)) state.left_us = static_cast<std::int64_t>(std::llround(std::clamp(*how->takes_s, 0.0, kLongest_s) * 1e6));
  changed_ = true;
}

void ActionBook::end(ActionState& state, Status status, std::string result) {
  state.status = status;
  state.result = std::move(result);
  changed_ = true;
}

void ActionBook::tidy() {
  const auto forget = [this](bool instant, std::size_t most) {
    const auto counts = [instant](const ActionState& state) { return state.over() && (state.origin == ActionState::Origin::kInstant) == instant; };
    auto over = static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), counts));
    std::erase_if(all_, [&](const ActionState& state) { return counts(state) && over > most && over-- > 0; });
  };
  forget(false, kMostOver);
  forget(true, kMostInstantsOver);
}

}  // namespace kb::vda5050
