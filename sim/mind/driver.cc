#include "sim/mind/driver.h"

#include <algorithm>
#include <cmath>

#include <waymark/controllers/heard.h>

namespace kb::sim {

mts::Body as_driven(mts::Body body, const SensorBuild& range, const DriveLimits& drive) {
  constexpr double kNever_s = 3600.0;   // a robot that waits this long for a reading stands anyway; without a bound its braking distance would be infinite
  const double late_s = range.latency_s + drive.motor_lag_s + static_cast<double>(kControlUs) / 1e6;
  if (range.rate_hz > 0.0) body.range_latency_s = static_cast<float>(std::min(kNever_s, 1.0 / range.rate_hz + late_s));
  return body;
}

mts::Motion Driver::hear(const mts::Senses& senses, const TagHeard& tag, float period_s, bool measured) {
  senses_ = senses;
  const float dt_s = as_.in(period_s, "s");
  steady_ = steadied_.step(as_.in(senses), dt_s);
  perception_.hear(steady_, memories_.of(tag), dt_s, measured);
  const mts::Motion wanted = pilot_.step(steady_, dt_s);
  perception_.tell(pilot_.plight(), pilot_.lost());
  return mts::slowed(as_.out(wanted), limit_m_s());
}

/// The limits of its knowledge, and until it leaves a road also those that held there when it took that knowledge.
float Driver::limit_m_s() {
  if (!kept_.empty()) {
    const auto here = perception_.came_by();
    if (!here || std::isinf(kept_.at(*here))) kept_ = SpeedLimits();
  }
  return std::min(perception_.limit_m_s(knowledge_->limits), kept_.lowest());
}

void Driver::take(const Knowledge& next) {
  if (const auto here = perception_.came_by()) {
    const float limit_m_s = std::min(knowledge_->limits.at(*here), kept_.at(*here));
    kept_ = SpeedLimits();
    if (std::isfinite(limit_m_s)) kept_.add(*here, limit_m_s);
  }
  mind_.take(next);
  knowledge_ = &next;
}

const program::Tick& Driver::tick(std::int64_t now_us, std::uint32_t dt_us) {
  const program::Tick& tick = mind_.tick(perception_, senses_, now_us, dt_us);
  pilot_.choose(mind_.strategy(), perception_, steady_);
  return tick;
}

const Leg* Driver::leg() const {
  const auto current = std::find_if(knowledge_->legs.begin(), knowledge_->legs.end(), [&](const Leg& leg) { return mind_.high(leg.cell); });
  return current != knowledge_->legs.end() ? &*current : nullptr;
}

void Driver::put(const std::shared_ptr<const Memory>& memory, std::uint32_t exit, double along_m) {
  const TagHeard heard{true, memory, exit};
  const TagHeard& there = memories_.of(heard);   // the same object if the robot is of size 1
  perception_.put(there.memory, there.arm, along_m * static_cast<double>(as_.in(1.0f, "m")));
}

std::optional<MapPlace> Driver::place() const {
  std::optional<MapPlace> place = perception_.on_road();
  if (const std::string* at = perception_.tag_text(); !place && at != nullptr) place = MapPlace{*at, {}};
  if (place) place->along_m *= static_cast<double>(as_.out(1.0f, "m"));
  return place;
}

const Strategy* Driver::strategy() const {
  const int strategy = pilot_.strategy();
  return strategy >= 0 ? &knowledge_->strategies[static_cast<std::size_t>(strategy)] : nullptr;
}

program::CellId Driver::mission() const {
  const auto route = std::find_if(knowledge_->routes.begin(), knowledge_->routes.end(), [&](program::CellId cell) { return mind_.high(cell); });
  return route != knowledge_->routes.end() ? *route : program::CellId::kNone;
}

bool Driver::reports_any() const {
  return std::any_of(knowledge_->reports.begin(), knowledge_->reports.end(), [&](program::CellId report) { return mind_.high(report); });
}

std::vector<std::string> Driver::high_of(const std::vector<program::CellId>& satellites) const {
  std::vector<std::string> names;
  for (const program::CellId satellite : satellites) {
    if (mind_.high(satellite)) names.emplace_back(knowledge_->program->cells[program::index(satellite)].name);
  }
  return names;
}

}  // namespace kb::sim
