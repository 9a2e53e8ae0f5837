#include "sim/mind/driver.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

std::vector<std::string> names_of_facts(const program::Program& program) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < program.facts; ++i) names.emplace_back(program.cells[i].name);
  return names;
}

std::vector<mts::FactRun> runs_of(const std::vector<program::CellRun>& cells) {
  std::vector<mts::FactRun> runs;
  for (const program::CellRun& run : cells) runs.push_back({static_cast<std::uint32_t>(run.first), run.count});
  return runs;
}

void add_word(std::string& words, const std::string& word) { words += words.empty() ? word : ' ' + word; }

}  // namespace

mts::Body as_driven(mts::Body body, const SensorBuild& range, const DriveLimits& drive) {
  constexpr double kNever_s = 3600.0;   // a robot that waits this long for a reading stands anyway; without a bound its braking distance would be infinite
  const double late_s = range.latency_s + drive.motor_lag_s + static_cast<double>(kControlUs) / 1e6;
  if (range.rate_hz > 0.0) body.range_latency_s = static_cast<float>(std::min(kNever_s, 1.0 / range.rate_hz + late_s));
  return body;
}

Driver::Driver(const Knowledge& knowledge, const Labyrinth& labyrinth, const mts::Body& body)
    : knowledge_(&knowledge),
      roads_(labyrinth),
      lines_(knowledge),
      names_(names_of_facts(*knowledge.program)),
      landmarks_(runs_of(knowledge.landmarks)),
      halls_(knowledge, labyrinth, roads_, pilot_),
      body_(body),
      pilot_(body, halls_.host()),
      lookout_(body, {landmarks_.data(), landmarks_.size()}, {&roads_}, {&names_}),
      mind_(knowledge),
      perceived_(knowledge.program->facts, 0.0f) {}

void Driver::read(const TagHeard& tag) {
  sign_ = {.reader = tag.alive};
  if (tag.memory == nullptr) return;
  if (tag.memory != memory_) {   // what a tag says is never changed
    memory_ = tag.memory;
    closed_.clear();
    cross_by_.clear();
    for (const Memory::Exit& exit : memory_->exits) {
      if (exit.closed) add_word(closed_, exit.name);
    }
    for (const std::string& method : memory_->methods) add_word(cross_by_, method);
  }
  sign_ = {memory_->landmark.c_str(), memory_->exits[tag.arm].name.c_str(), memory_->safe, closed_.c_str(), cross_by_.c_str()};
}

mts::Motion Driver::hear(const mts::Senses& senses, const TagHeard& tag, float period_s, bool measured) {
  senses_ = senses;
  const mts::Motion wanted = pilot_.step(senses, period_s);
  read(tag);
  lookout_.step(pilot_, sign_, period_s, measured);
  return mts::slowed(wanted, limit_m_s());
}

std::optional<RoadEnd> Driver::came_by() const {
  if (const mts::MapRoad* road = pilot_.place().road()) return RoadEnd{road->from, road->exit};
  const mts::RoadWatch& watch = lookout_.watch();
  const bool before_sign = watch.at() == mts::RoadWatch::At::kApproach || watch.at() == mts::RoadWatch::At::kCrossing;
  if (!before_sign || watch.sign().exit[0] == '\0') return std::nullopt;
  return RoadEnd{watch.sign().landmark, watch.sign().exit};
}

/// The limits of its knowledge, and until it leaves a road also those that held there when it took that knowledge.
float Driver::limit_m_s() {
  const auto came = came_by();
  if (!kept_.empty() && (!came || std::isinf(kept_.at(*came)))) kept_ = SpeedLimits();
  const SpeedLimits& limits = knowledge_->limits;
  float limit_m_s = std::min(came ? limits.at(*came) : limits.lowest(), kept_.lowest());
  const mts::MapRoad* const leaves_by = pilot_.in_crossing() ? pilot_.road_of_leg() : nullptr;
  if (came && leaves_by != nullptr) limit_m_s = std::min(limit_m_s, limits.at({leaves_by->from, leaves_by->exit}));
  return limit_m_s;
}

void Driver::take(const Knowledge& next) {
  if (const auto here = came_by()) {
    const float limit_m_s = std::min(knowledge_->limits.at(*here), kept_.at(*here));
    kept_ = SpeedLimits();
    if (std::isfinite(limit_m_s)) kept_.add(*here, limit_m_s);
  }
  mind_.take(next);
  knowledge_ = &next;
}

const program::Tick& Driver::tick(std::int64_t now_us, std::uint32_t dt_us) {
  lookout_.write(perceived_);
  const program::Tick& tick = mind_.tick({perceived_, &senses_, tag_text(), memory_text()}, now_us, dt_us);
  if (mind_.strategy() != strategy_) halls_.choose(mind_.strategy());
  strategy_ = mind_.strategy();
  pilot_.choose(lines_.of(strategy_), road_of_leg());
  return tick;
}

const std::string* Driver::tag_text() const {
  const mts::RoadWatch& watch = lookout_.watch();
  const bool reads = watch.at() != mts::RoadWatch::At::kNowhere && watch.sign().landmark[0] != '\0';
  return reads ? &names_[watch.sign().fact] : nullptr;
}

const std::string* Driver::memory_text() {
  using At = mts::RoadWatch::At;
  const mts::RoadWatch& watch = lookout_.watch();
  if (tag_text() == nullptr || memory_ == nullptr) return nullptr;
  const char* const move_by = watch.move_by();
  if (watch.at() == At::kApproach && !memory_->methods.empty()) memory_text_ = "cross " + memory_->methods.front();
  else if (watch.at() != At::kApproach && move_by[0] != '\0') memory_text_ = std::string("move ") + move_by;
  else return nullptr;
  return &memory_text_;
}

const Leg* Driver::leg() const {
  const auto current = std::find_if(knowledge_->legs.begin(), knowledge_->legs.end(), [&](const Leg& leg) { return mind_.high(leg.cell); });
  return current != knowledge_->legs.end() ? &*current : nullptr;
}

const mts::MapRoad* Driver::road_of_leg() const {
  const Leg* const now = leg();
  return now != nullptr ? roads_.find(now->from, now->exit) : nullptr;
}

void Driver::put(std::string_view landmark, std::string_view exit, double along_m) {
  if (const mts::MapRoad* road = roads_.find(landmark, exit)) pilot_.put(*road, static_cast<float>(along_m));
}

std::optional<MapPlace> Driver::place() const {
  if (const mts::MapRoad* road = pilot_.place().road(); road != nullptr && !pilot_.in_crossing()) {
    const mts::OnRoad::Spot spot = pilot_.place().spot();
    return MapPlace{road->from, road->exit, static_cast<double>(spot.along_m), pilot_.place().turned_rad(spot.along_m) < 0.5f * mts::kPi};
  }
  return place_by_sign();
}

std::optional<MapPlace> Driver::place_by_sign() const {
  const std::string* const at = tag_text();
  if (at == nullptr) return std::nullopt;
  const mts::RoadWatch& watch = lookout_.watch();
  const bool leaves = watch.at() == mts::RoadWatch::At::kLeaving;
  const mts::MapRoad* road = watch.at() == mts::RoadWatch::At::kCrossing || pilot_.in_crossing() ? nullptr : roads_.find(*at, watch.sign().exit);
  const bool faces_anywhere = leaves && !pilot_.heard().heading_known;   // by its wheels alone it does not know how it was set down
  if (road == nullptr || faces_anywhere) return MapPlace{*at, {}};
  const float sign_m = mts::sign_m(*road, body_), since_m = watch.since_sign_m();
  return MapPlace{road->from, road->exit, static_cast<double>(leaves ? sign_m + since_m : std::max(sign_m - since_m, 0.0f)), leaves};
}

const Strategy* Driver::strategy() const { return strategy_ >= 0 ? &knowledge_->strategies[static_cast<std::size_t>(strategy_)] : nullptr; }

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
