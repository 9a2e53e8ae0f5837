#include "compiler/tables/fleet_rest.h"

#include <cmath>

#include <waymark/runtime/facts.h>

namespace kb::tables {
namespace {

using StepKind = FleetStep::Kind;
using PlaneKind = FleetPlane::Kind;

/// One robot, as its planes say it.
class OneRobot {
 public:
  OneRobot(const FleetForm& form, const Tables& tables)
      : form_(form), t_(tables), planes_(form.planes.size(), false), before_(planes_), values_(form.steps.size(), false),
        began_us_(tables.shape.timers + std::size_t{1}, 0) {
    for (std::uint32_t s = 0; s < form.satellites.size(); ++s) start(s);
  }

  void tick(std::uint32_t dt_us, const float* facts) {
    last_us_ = now_us_;
    if (!first_) now_us_ += dt_us;
    for (std::uint32_t i = 0; i < form_.given; ++i) planes_[i] = given(form_.planes[i], facts[form_.planes[i].of]);
    before_ = planes_;
    for (std::size_t i = 1; i < form_.steps.size() && form_.steps[i].kind != StepKind::kTraced; ++i) step(i);
    first_ = false;
  }
  [[nodiscard]] const std::vector<bool>& planes() const { return planes_; }

 private:
  void start(std::uint32_t satellite) {
    const FleetCode& code = form_.satellites[satellite];
    std::size_t place = 0;
    while (place + 1 < code.values.size() && code.values[place] != t_.initial[satellite] + 0.0f) ++place;
    for (std::uint32_t b = 0; b < code.bits; ++b) planes_[code.first_plane + b] = (place >> b & 1u) != 0;
  }

  [[nodiscard]] bool given(const FleetPlane& plane, float certainty) const {
    const auto [x, bad] = mts::sane_fact(certainty);
    switch (plane.kind) {
      case PlaneKind::kHigh: return x >= t_.firing;
      case PlaneKind::kLow: return x <= -t_.firing;
      case PlaneKind::kZero: return 1.0f - std::fabs(x) >= t_.firing;
      case PlaneKind::kPlain: return x > t_.fact_atoms[plane.of].plain;
      case PlaneKind::kAttended: return x > t_.fact_atoms[plane.of].attended;
      default: return bad;
    }
  }

  [[nodiscard]] bool value(Ref ref) const { return values_[ref >> 1] != ((ref & 1u) != 0); }
  void step(std::size_t i) {
    const FleetStep& s = form_.steps[i];
    switch (s.kind) {
      case StepKind::kLoad: values_[i] = before_[s.what]; return;
      case StepKind::kLater: values_[i] = !first_; return;
      case StepKind::kAnd: values_[i] = value(s.a) && value(s.b); return;
      case StepKind::kOr: values_[i] = value(s.a) || value(s.b); return;
      case StepKind::kAndNot: values_[i] = value(s.a) && !value(s.b); return;
      case StepKind::kTimer: values_[i] = over(s, now_us_, t_.queue_us[t_.timers[s.what].queue]); return;
      case StepKind::kHold: values_[i] = over(s, last_us_, t_.hold_limit_us + std::int64_t{1}); return;
      case StepKind::kPut: planes_[s.what] = value(s.a); return;
      default: return;
    }
  }
  bool over(const FleetStep& s, std::int64_t begin_us, std::int64_t duration_us) {
    if (value(s.a) && !value(s.b)) began_us_[s.what] = begin_us;
    return value(s.a) && (value(s.c) || now_us_ - began_us_[s.what] >= duration_us);
  }

  const FleetForm& form_;
  const Tables& t_;
  std::vector<bool> planes_, before_;   // as they are made, and as the tick began
  std::vector<bool> values_;            // by step
  std::vector<std::int64_t> began_us_;  // by timer; the last: idle = hold
  std::int64_t now_us_ = 0, last_us_ = 0;
  bool first_ = true;
};

}  // namespace

FleetRest planes_at_rest(const FleetForm& form, const Tables& tables, std::span<const FleetMission> missions) {
  std::vector<bool> rests(form.planes.size(), true), bits;   // by plane: never differs; the bit that it has
  for (const FleetMission& mission : missions) {
    OneRobot robot(form, tables);
    const std::size_t ticks = mission.dt_us.size();
    for (std::size_t tick = 0; tick < 2 * ticks; ++tick) {
      robot.tick(mission.dt_us[tick % ticks], mission.facts.data() + tick % ticks * tables.shape.facts);
      if (tick < ticks) continue;
      if (bits.empty()) bits = robot.planes();
      for (std::size_t i = 0; i < rests.size(); ++i) rests[i] = rests[i] && robot.planes()[i] == bits[i];
    }
  }
  if (bits.empty()) return {};
  for (const FleetCode& code : form.satellites) {   // its planes stay together
    bool all = true;
    for (std::uint32_t b = 0; b < code.bits; ++b) all = all && rests[code.first_plane + b];
    for (std::uint32_t b = 0; b < code.bits; ++b) rests[code.first_plane + b] = all;
  }
  FleetRest rest;
  for (std::uint32_t i = 0; i < form.plain_planes; ++i) {
    const bool read = i < form.read_given && !bits[i];   // the host's planes rest at 0
    if (rests[i] && (read || i >= form.given)) rest[key_of(form.planes[i])] = bits[i];
  }
  return rest;
}

}  // namespace kb::tables
