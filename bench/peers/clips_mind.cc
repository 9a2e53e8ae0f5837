#include "bench/peers/clips_mind.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

extern "C" {
#include <clips/clips.h>
}

namespace peers {
namespace {

ClipsMind& mind_of(void* environment) { return *static_cast<ClipsMind*>(GetEnvironmentContext(environment)); }

void call_fire(void* environment) { mind_of(environment).fire(static_cast<std::uint32_t>(EnvRtnLong(environment, 1))); }
void call_timer(void* environment) {
  mind_of(environment).set_timer(static_cast<std::uint32_t>(EnvRtnLong(environment, 1)), EnvRtnLong(environment, 2) != 0);
}

}  // namespace

ClipsMind::ClipsMind(const ClipsProgram& program) : p_(program) {
  build();
  reset();
}

ClipsMind::~ClipsMind() { DestroyEnvironment(environment_); }

void ClipsMind::build() {
  environment_ = CreateEnvironment();
  SetEnvironmentContext(environment_, this);
  EnvDefineFunction2(environment_, "fire", 'v', PTIEF call_fire, "call_fire", "11i");
  EnvDefineFunction2(environment_, "timer", 'v', PTIEF call_timer, "call_timer", "22i");
  for (const std::string& construct : p_.constructs) {
    if (EnvBuild(environment_, construct.c_str()) == 0) throw std::runtime_error("CLIPS does not take " + construct);
  }
  for (std::uint32_t l = 0; l < p_.levels; ++l) {
    level_modules_.push_back(EnvFindDefmodule(environment_, ("L" + std::to_string(l)).c_str()));
    timer_modules_.push_back(EnvFindDefmodule(environment_, ("T" + std::to_string(l)).c_str()));
  }
  EnvSetCurrentModule(environment_, EnvFindDefmodule(environment_, "MAIN"));
  tick_template_ = EnvFindDeftemplate(environment_, "tick");
  terms_.resize(p_.cells.size());
  held_.assign(p_.timers.size(), kNobody);
  for (std::uint32_t a = 0; a < p_.asked.size(); ++a) {
    const Asked& asked = p_.asked[a];
    stands_.push_back({EnvFindDeftemplate(environment_, asked.template_name.c_str()), nullptr});
    if (asked.kind == Asked::Kind::kHeld) {
      held_[asked.of] = a;
      continue;
    }
    Terms& t = terms_[asked.of];
    std::uint32_t* const slots[] = {&t.high, &t.zero, &t.low, &t.seen, &t.event, &t.lost};
    *slots[static_cast<std::size_t>(asked.kind)] = a;
  }
}

void ClipsMind::reset() {
  for (ClipsFact& stands : stands_) stands.fact = nullptr;
  tick_fact_ = nullptr;
  EnvReset(environment_);
  value_.assign(p_.cells.size(), 0.0f);
  attended_.assign(p_.cells.size(), 0);
  seen_.assign(p_.cells.size(), 0);
  changed_.assign(p_.cells.size(), 0);
  since_.assign(p_.timers.size(), -1);
  writer_.assign(p_.cells.size(), 0);
  to_look_at_.clear();
  momentary_.clear();
  on_.clear();
  commits_ = 0;
  now_us_ = 0;
  first_ = true;
  contradicted_ = false;
  for (std::uint32_t c = 0; c < p_.cells.size(); ++c) {
    if (terms_[c].zero != kNobody) stand(terms_[c].zero, true);
    set_cell(c, p_.cells[c].initial);
  }
}

void ClipsMind::stand(std::uint32_t asked, bool now) { stands_[asked].stand(environment_, now); }

void ClipsMind::attend(std::uint32_t satellite, int by) {
  for (const std::uint32_t fact : p_.cells[satellite].draws) {
    attended_[fact] += by;
    if (changed_[fact] == 0) to_look_at_.push_back(fact);
    changed_[fact] = 1;
  }
}

void ClipsMind::set_cell(std::uint32_t cell, float value) {
  const float before = value_[cell];
  if (before == value) return;
  value_[cell] = value;
  const Terms& t = terms_[cell];
  if (t.high != kNobody) stand(t.high, value >= p_.firing);
  if (t.low != kNobody) stand(t.low, value <= -p_.firing);
  if (t.zero != kNobody) stand(t.zero, 1.0f - std::fabs(value) >= p_.firing);
  if ((before >= p_.firing) != (value >= p_.firing)) attend(cell, value >= p_.firing ? 1 : -1);
}

void ClipsMind::give(Fact fact, float value) {
  const auto cell = static_cast<std::uint32_t>(fact);
  set_cell(cell, value);
  if (changed_[cell] == 0) to_look_at_.push_back(cell);
  changed_[cell] = 1;
}

/// Events of the last tick are over; facts come into view and go out of it.
void ClipsMind::notice() {
  for (const std::uint32_t asked : momentary_) stand(asked, false);
  momentary_.clear();
  for (const std::uint32_t fact : to_look_at_) {
    changed_[fact] = 0;
    const bool was = seen_[fact] != 0;
    const bool now = value_[fact] > (was || attended_[fact] > 0 ? p_.cells[fact].attended : p_.cells[fact].plain);
    if (now == was) continue;
    seen_[fact] = now;
    if (terms_[fact].seen != kNobody) stand(terms_[fact].seen, now);
    const std::uint32_t momentary = now ? terms_[fact].event : terms_[fact].lost;
    if (first_ || momentary == kNobody) continue;
    stand(momentary, true);
    momentary_.push_back(momentary);
  }
  to_look_at_.clear();
}

void ClipsMind::set_timer(std::uint32_t timer, bool on) {
  if (!on) {
    since_[timer] = -1;
    stand(held_[timer], false);
  } else if (since_[timer] < 0) {
    since_[timer] = now_us_;
  }
}

void ClipsMind::run_module(void* module) {
  EnvFocus(environment_, module);
  EnvRun(environment_, -1);
}

void ClipsMind::run_level(std::uint32_t level) {
  run_module(timer_modules_[level]);
  for (std::uint32_t t = 0; t < p_.timers.size(); ++t) {
    if (p_.timers[t].level == level && since_[t] >= 0 && now_us_ - since_[t] >= p_.timers[t].duration_us) stand(held_[t], true);
  }
  const std::size_t first = fired_.size();
  run_module(level_modules_[level]);
  if (fired_.size() != first || level + 1 == p_.levels) commit(level, first);
}

/// What the rules of a level write is written when all of them have been looked at. A rule that resets silences the others.
void ClipsMind::commit(std::uint32_t level, std::size_t first) {
  const auto begin = fired_.begin() + static_cast<std::ptrdiff_t>(first);
  if (std::any_of(begin, fired_.end(), [this](std::uint32_t r) { return p_.rules[r].resets; })) {
    fired_.erase(std::remove_if(begin, fired_.end(), [this](std::uint32_t r) { return !p_.rules[r].resets; }), fired_.end());
  }
  std::sort(begin, fired_.end());
  if (level + 1 == p_.levels) {   // strategies are off unless a rule of the last level wants them
    for (const std::uint32_t cell : on_) {
      const bool wanted = std::any_of(begin, fired_.end(), [&](std::uint32_t r) { return p_.rules[r].writes[0].cell == cell; });
      if (!wanted) set_cell(cell, -1.0f);
    }
    on_.clear();
  }
  ++commits_;
  for (std::size_t i = first; i < fired_.size(); ++i) {
    for (const ClipsProgram::Write& write : p_.rules[fired_[i]].writes) {
      if (writer_[write.cell] == commits_ && value_[write.cell] != write.value) contradicted_ = true;
      writer_[write.cell] = commits_;
      set_cell(write.cell, write.value);
      if (p_.cells[write.cell].strategy) on_.push_back(write.cell);
    }
  }
}

Strategy ClipsMind::tick(std::uint32_t dt_us) {
  if (!first_) now_us_ += dt_us;
  fired_.clear();
  notice();
  if (tick_fact_ != nullptr) EnvRetract(environment_, tick_fact_);
  tick_fact_ = EnvAssert(environment_, EnvCreateFact(environment_, tick_template_));
  for (std::uint32_t l = 0; l < p_.levels; ++l) run_level(l);
  first_ = false;
  if (on_.empty()) return kNoStrategy;
  return static_cast<Strategy>(on_.front() - paper::Knowledge::kShape.facts - paper::Knowledge::kShape.satellites);
}

}  // namespace peers
