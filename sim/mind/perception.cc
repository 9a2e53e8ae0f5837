#include "sim/mind/perception.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kInOrOut = 0.35f;            // cosine of the angle within which it heads for the crossing, or away from it
constexpr float kReads = 0.25f;              // s: how long the sign of an arrival must be read before it counts
constexpr float kApproachLasts = 0.8f;       // m, after the last reading of a sign
constexpr float kCrossingLasts = 3.0f;       // m, in a crossing: without a sign of its exits it counts as left after this way
constexpr float kFades = 0.15f;              // by how much the certainty of a landmark falls with each metre
constexpr float kEndless = 1e3f;             // m: a piece of which only the heading is known
constexpr double kSameArm = kPi / 4;         // rad
constexpr float kHalfTurn = 2.96f;           // rad: 170 degrees
constexpr double kTurnedTo = 0.17;           // rad: this near to the road's direction it has come about
constexpr float kSignReach = 0.6f;           // m, from a stop line: no sign is read farther away, even with the error of odometry

struct TurnWord { std::string_view word; double angle_rad; mts::Turn turn; };
constexpr std::array kTurns{
    TurnWord{"back", kPi, mts::Turn::kBack},           TurnWord{"left", kPi / 2, mts::Turn::kLeft},
    TurnWord{"forward", 0.0, mts::Turn::kForward},     TurnWord{"right", -kPi / 2, mts::Turn::kRight},
    TurnWord{"half_left", kPi / 4, mts::Turn::kLeft},  TurnWord{"sharp_left", 3 * kPi / 4, mts::Turn::kLeft},
    TurnWord{"half_right", -kPi / 4, mts::Turn::kRight}, TurnWord{"sharp_right", -3 * kPi / 4, mts::Turn::kRight}};

const TurnWord& turn_word(std::string_view word) {
  for (const TurnWord& turn : kTurns) {
    if (turn.word == word) return turn;
  }
  return kTurns[2];
}

}  // namespace

void Perception::hear(const mts::Senses& senses, const TagHeard& tag, float dt_s, bool measured) {
  senses_ = senses;
  hear_blindness(dt_s, measured);
  if (!reckons_) reckoning_.start(senses, {});
  reckons_ = true;
  touched_ = touched_ || senses.touched;
  reckoning_.step(senses, dt_s);
  const float way_m = reckoning_.way_m();
  since_m_ += way_m;
  to_line_out_m_ -= way_m;
  if (doing_ != nullptr && doing_->doing == Doing::kMove) beside_m_ = std::max(beside_m_ - way_m, 0.0f);
  const auto turned_rad = static_cast<float>(wrap(static_cast<double>(reckoning_.at.heading_rad - last_heading_rad_)));
  round_rad_ += turned_rad;
  last_heading_rad_ = reckoning_.at.heading_rad;
  hear_carried(dt_s);
  hear_tag(tag, dt_s);
  const bool follows = doing_ != nullptr && (doing_->method == "mark" || doing_->method == "dist");
  guided_ = guided_ || (follows && doing_->doing == Doing::kMove && !road_.known() && phase_ == Phase::kOnRoad);
  hear_line(dt_s);
  obstacle_sight_.step(senses_, doing_ != nullptr && doing_->drives() && !in_hall(), way_m, turned_rad, dt_s);
  hear_way_without_line(way_m);
  if (doing_ != nullptr && phase_ != Phase::kInside) road_.settle(senses_, reckoning_.at, body_, dt_s);
  hear_pushed();
  hear_told();
  clear_s_ = rounding_ && on_track() ? 0.0f : clear_s_ + dt_s;
}

void Perception::hear_tag(const TagHeard& tag, float dt_s) {
  tag_alive_ = tag.alive;
  unread_s_ += dt_s;
  const bool wanders = rounding_ || (doing_ != nullptr && doing_->doing == Doing::kMove && in_hall());
  // The sign where its road began may be seen again on the way round something.
  const bool left_behind = wanders && phase_ != Phase::kInside && tag.memory != nullptr && road_.begins_at(*tag.memory, tag.arm);
  if (tag.memory != nullptr && turned_away_from_sign()) {
    phase_ = Phase::kLeaving;
    since_m_ = unread_s_ = 0.0f;
  } else if (tag.memory != nullptr && reckoning_.heading_known() && !left_behind) {
    const double outwards = std::cos(static_cast<double>(reckoning_.at.heading_rad) - tag.memory->exits[tag.arm].heading_rad);
    const bool same = memory_ != nullptr && memory_->landmark == tag.memory->landmark;
    const bool inside = phase_ == Phase::kInside && (same || memory_ == nullptr);   // entered without a sign: that of the way in no longer counts
    if (outwards < -kInOrOut && !inside) phase_ = Phase::kApproach;
    const bool looks_away = rounding_ && phase_ == Phase::kApproach;   // it looks away to go round something, not to leave the crossing
    if (outwards > kInOrOut && (!inside || since_m_ > 0.2f) && !looks_away) phase_ = Phase::kLeaving;
    if (phase_ != Phase::kOnRoad) {
      sign_s_ = same ? sign_s_ + dt_s : 0.0f;
      if (phase_ != Phase::kInside || same) memory_ = tag.memory;
      if (phase_ != Phase::kInside) arm_ = tag.arm;
      if (unread_s_ > kReadingLasts) without_line_m_ = 0.0f;   // the robot comes to the sign anew
      unread_s_ = 0.0f;
      if (phase_ != Phase::kInside) since_m_ = 0.0f;
      const bool sets_out = phase_ == Phase::kLeaving && !road_.known() && doing_ != nullptr && doing_->doing == Doing::kMove;
      if (sets_out) road_.enter(memory_, arm_, reckoning_.at, {});   // until now it did not know where it was
    }
  }
  const bool passed = (phase_ == Phase::kLeaving && unread_s_ > kReadingLasts && since_m_ > 0.05f) ||
                      (phase_ == Phase::kApproach && since_m_ > kApproachLasts) || (phase_ == Phase::kInside && since_m_ > kCrossingLasts);
  if (passed && phase_ == Phase::kInside) crosses_ = false;
  if (passed) phase_ = Phase::kOnRoad;
}

/// Whether the robot has turned round at the end of its road and, still there, faces away from it. Then a sign that it reads is the one
/// that could not be read before or was wrong, whatever arm of whatever landmark it names.
bool Perception::turned_away_from_sign() const {
  if (!road_.turned_back() || phase_ == Phase::kInside) return false;
  const Progress now = road_.progress(reckoning_.at);
  return now.along_m < kSignReach && std::cos(now.turned_rad) > kInOrOut;
}

/// Whether the robot, going round something, has come to the end of the road in its middle: from beside the road a crossing cannot be
/// entered.
bool Perception::rounds_to_end() const {
  return rounding_ && due() && road_.progress(reckoning_.at).aside_m < kAside && std::abs(wrap(static_cast<double>(reckoning_.at.heading_rad) - road_.end_heading_rad())) < kSameArm;
}

void Perception::hear_line(float dt_s) {
  line_.step(senses_, dt_s, rounds_to_end());
  line_seen_ = line_seen_ || line_.now();
  met_line_ = phase_ == Phase::kApproach && (met_line_ || line_.now());
  waits_at_line_ = waits_at_line_ && met_line_;
}

bool Perception::in_hall() const {
  if (road_.hall() == nullptr || phase_ == Phase::kInside) return false;
  // The sign of an exit may be read before the road behind it has begun.
  return phase_ != Phase::kLeaving || road_.turned_back() || memory_ == nullptr || road_.leaves(memory_->landmark);
}

std::uint32_t Perception::exit_for(const Strategy& strategy) const {
  if (memory_ == nullptr) return kNoExit;
  const auto& exits = memory_->exits;
  const double turn = turn_word(strategy.turn).angle_rad;
  if (strategy.turn == "back") return arm_;
  // Exits that are named by points of the compass are matched by name: where roads are slanted, names tell the turn better than headings.
  const auto came = compass_heading(exits[arm_].name);
  std::uint32_t best = kNoExit;
  double best_rad = kPi / 2;
  for (std::uint32_t i = 0; i < exits.size(); ++i) {
    if (i == arm_ || !exits[i].leads_out) continue;
    const auto goes = compass_heading(exits[i].name);
    if (came && goes && std::abs(wrap(*goes - *came - kPi - turn)) < 0.1) return i;
    const double off = std::abs(wrap(exits[i].heading_rad - exits[arm_].heading_rad - kPi - turn));
    if (off < best_rad) {
      best_rad = off;
      best = i;
    }
  }
  return best;
}

void Perception::enter(const Strategy& strategy, bool resumes) {
  const bool at_exit = resumes && phase_ == Phase::kLeaving && arm_ == exit_;   // the sign of the exit is read before its stop line is met
  if (phase_ == Phase::kInside || at_exit || (resumes && out_awaited_)) return;   // still in the same manoeuvre, after an obstacle
  road_.enter_crossing();
  set_down_ = out_awaited_ = out_told_ = false;
  crosses_ = true;
  begins_on_road_ = false;
  if (strategy.signless) memory_ = nullptr;
  exit_ = exit_for(strategy);
  phase_ = Phase::kInside;
  since_m_ = 0.0f;
  if (exit_ != kNoExit) to_line_out_m_ = static_cast<float>(memory_->exits[arm_].stop_m + memory_->exits[exit_].stop_m);
}

/// A `Move` begins, and with it a new road unless the robot is still on the one before. Out of a crossing the road begins at the stop line.
void Perception::set_out() {
  crosses_ = false;
  const bool known = memory_ != nullptr && (phase_ == Phase::kLeaving || (phase_ == Phase::kInside && exit_ != kNoExit));
  if (phase_ != Phase::kInside && (phase_ != Phase::kLeaving || road_.turned_back())) return;   // on the same road as before
  const bool went_round = rounding_ || beside_m_ > 0.0f;
  if (went_round && phase_ == Phase::kLeaving && memory_ != nullptr && road_.begins_at(*memory_, arm_)) return;   // the same road
  if (known) {
    const std::uint32_t exit = phase_ == Phase::kInside ? exit_ : arm_;
    // On a line, the line sensors are at the stop line, and the robot's centre is behind them. Without a line the drive starts in mid-road,
    // beside a tag.
    const bool line = phase_ == Phase::kInside || line_.now() || memory_->exits[exit].hall != nullptr;
    const double begin_m = line ? -static_cast<double>(body_.line_ahead_m) : static_cast<double>(kTagBefore);
    road_.enter(memory_, exit, reckoning_.at, begin_m * direction(memory_->exits[exit].heading_rad));
  } else {
    road_.forget();
    guided_ = false;
  }
  beside_m_ = 0.0f;
  if (phase_ == Phase::kInside) {
    if (known) arm_ = exit_;
    phase_ = Phase::kLeaving;
    since_m_ = unread_s_ = 0.0f;
  }
}

void Perception::begin(const Strategy* strategy, bool resumes) {
  const bool avoided = doing_ != nullptr && doing_->doing == Doing::kAvoid;
  const bool on_line = drove_ != nullptr && drove_->doing == Doing::kMove && drove_->method == "mark";
  const bool crossed = drove_ != nullptr && drove_->doing == Doing::kCross;
  doing_ = strategy;
  const bool avoids = strategy != nullptr && strategy->doing == Doing::kAvoid;
  if (avoids && !avoided) {
    if (crossed && at_way_out()) leave_for_road();
    avoid();
    avoids_line_ = on_line || (out_awaited_ && road_.method() == "mark");
  }
  if (strategy == nullptr) return;
  if (strategy->drives()) drove_ = strategy;
  if (strategy->doing == Doing::kCross) enter(*strategy, resumes);
  if (strategy->doing == Doing::kMove) set_out();
  if (road_.pieces() > mts::kLongestCourse) told_to_ = road_.progress(reckoning_.at).piece + mts::kLongestCourse - 2;   // the first piece may lead back to the road
  if (strategy->drives()) rounding_ = false;
  if (strategy->doing == Doing::kRound) {
    round_rad_ = 0.0f;
    met_line_ = waits_at_line_ = false;
    road_.turn_back();
  }
}

/// The arm on which the robot arrives, by the direction of the road that it came on; null if it is not at its end, or if the sign says the
/// same.
const std::string* Perception::arrival() const {
  if (!due()) return nullptr;
  const double back_rad = wrap(road_.end_heading_rad() + kPi);
  if (phase_ == Phase::kApproach && std::abs(wrap(memory_->exits[arm_].heading_rad - back_rad)) < kSameArm) return nullptr;   // the sign says the same
  const std::string* best = nullptr;
  double best_rad = kSameArm;
  for (const NamedFact& in : cells_->in) {
    const auto there = compass_heading(in.name);
    const double off_rad = there ? std::abs(wrap(*there - back_rad)) : kPi;
    if (off_rad >= best_rad) continue;
    best_rad = off_rad;
    best = &in.name;
  }
  return best;
}

/// Whether, by the way driven, the robot is where its road ends.
bool Perception::due() const { return phase_ != Phase::kInside && senses_.odometry_known && road_.due(reckoning_.at); }

mts::Task Perception::task_for(const Strategy& strategy) const {
  mts::Task task;
  task.turn = turn_word(strategy.turn).turn;
  if (strategy.doing == Doing::kCross && memory_ != nullptr) {
    const Memory::Exit& came = memory_->exits[arm_];
    task.entry_heading_rad = static_cast<float>(wrap(came.heading_rad + kPi));
    task.entry_known = true;
    const double turned = came.heading_rad + kPi + turn_word(strategy.turn).angle_rad;
    task.exit_known = true;
    task.exit_heading_rad = static_cast<float>(wrap(exit_ == kNoExit ? turned : memory_->exits[exit_].heading_rad));
    if (beside_m_ > 0.0f) task.entry_left_m = road_.left_of_end_m(reckoning_.at);
    task.middle_m = static_cast<float>(came.stop_m);
    task.crossing_m = static_cast<float>(came.stop_m + (exit_ == kNoExit ? came.stop_m : memory_->exits[exit_].stop_m));
  }
  if (strategy.signless && road_.known()) {
    task.entry_heading_rad = static_cast<float>(road_.end_heading_rad());
    task.entry_known = true;
    task.exit_known = true;
    task.exit_heading_rad = static_cast<float>(wrap(road_.end_heading_rad() + turn_word(strategy.turn).angle_rad));
  }
  if (strategy.doing == Doing::kAvoid && avoids_) {
    // A robot that begins far from the road, since it has just gone round something else, has to come back to it; not past the road's end,
    // where it would come to a crossing first.
    const bool far_off = road_.progress(reckoning_.at).aside_m > kRoadOff && !road_.passed(reckoning_.at);
    const auto back = far_off ? RoadAhead::Back::kToMiddle : RoadAhead::Back::kNever;
    // Between walls, the walls show where the road bends.
    if (road_.known() && road_.method() != "dist") road_.tell(task, reckoning_.at, back);
    if (task.pieces == 0) task.course[task.pieces++] = {avoid_.heading_rad, kEndless};
  }
  if (const auto back = way_back_rad(); back && strategy.doing == Doing::kRound) task.course[task.pieces++] = {*back, kEndless};
  if (strategy.doing == Doing::kMove && !road_.known() && set_down_) task.course[task.pieces++] = {lifted_.facing_rad(), kEndless};
  if (strategy.doing != Doing::kMove || !road_.known()) return task;
  // A robot that strayed knows how far along its road it is, and so whether there is room to look for the line; one that was pushed does not.
  const bool gone = pushed_ || (strayed_ && road_.has_room_to_seek(reckoning_.at));
  const bool seeks = gone && road_.method() == "mark" && strategy.method == "azimuth";
  road_.tell(task, reckoning_.at, seeks ? RoadAhead::Back::kToLine : RoadAhead::Back::kToMiddle);
  task.in_hall = in_hall();
  return task;
}

/// The exit by which the robot leaves a crossing, or has just left it, in its memory; kNoExit if it does neither or does not know.
std::uint32_t Perception::leaves_by() const {
  if (memory_ == nullptr) return kNoExit;
  return phase_ == Phase::kInside ? exit_ : phase_ == Phase::kLeaving ? arm_ : kNoExit;
}

std::optional<RoadEnd> Perception::came_by() const {
  if (road_.known()) return road_.entered();
  const bool before_sign = memory_ != nullptr && (phase_ == Phase::kApproach || phase_ == Phase::kInside);
  return before_sign ? std::optional(RoadEnd{memory_->landmark, memory_->exits[arm_].name}) : std::nullopt;
}

float Perception::limit_m_s(const SpeedLimits& limits) const {
  const auto came = came_by();
  if (!came) return limits.lowest();
  const std::uint32_t exit = leaves_by();
  return exit == kNoExit ? limits.at(*came) : std::min(limits.at(*came), limits.at({memory_->landmark, memory_->exits[exit].name}));
}

void Perception::write_landmark(std::span<float> facts) const {
  const bool turned_away = road_.turned_back() && phase_ == Phase::kLeaving;   // from a sign that could not be read or was wrong
  const bool set_down_beside = set_down_ && phase_ == Phase::kLeaving;   // facing away from the sign: it neither arrives there nor has crossed there
  // A sign that was read once may be that of a place from which the robot has just been carried: see note [carried].
  const bool read = phase_ != Phase::kApproach || (sign_s_ >= kReads && !lifted_.suspected());
  const bool here = phase_ != Phase::kOnRoad && memory_ != nullptr && !turned_away && !set_down_beside && read;
  const float nothing = tag_alive_ ? -kSure : 0.0f;
  for (const NamedFact& landmark : cells_->landmarks) {
    const bool it = here && landmark.name == memory_->landmark;
    put(facts, landmark.fact, it ? std::max(kSure - kFades * since_m_, 0.0f) : nothing);
  }
}

void Perception::write_memory(std::span<float> facts) const {
  const std::string* arrives = cells_->carried != kNoFact ? arrival() : nullptr;
  if (arrives != nullptr && phase_ != Phase::kApproach) {
    for (const NamedFact& in : cells_->in) put(facts, in.fact, in.name == *arrives ? kSure : -kSure);
  }
  if (memory_ == nullptr) return;
  if (phase_ == Phase::kApproach) {
    put(facts, cells_->safe, memory_->safe ? kSure : -kSure);
    const std::string& from = arrives != nullptr ? *arrives : memory_->exits[arm_].name;
    for (const NamedFact& in : cells_->in) put(facts, in.fact, in.name == from ? kSure : -kSure);
    for (const NamedFact& closed : cells_->closed) {
      for (const Memory::Exit& exit : memory_->exits) {
        if (exit.name == closed.name) put(facts, closed.fact, exit.closed ? kSure : -kSure);
      }
    }
    for (const NamedFact& by : cells_->cross_by) {
      const bool serves = std::find(memory_->methods.begin(), memory_->methods.end(), by.name) != memory_->methods.end();
      put(facts, by.fact, serves ? kSure : -kSure);
    }
  }
  const std::uint32_t exit = leaves_by();
  if (exit == kNoExit) return;
  const std::string_view method = road_.turned_back() && phase_ == Phase::kLeaving ? road_.method() : memory_->exits[exit].method;
  for (const NamedFact& by : cells_->move_by) put(facts, by.fact, by.name == method ? kSure : -kSure);
}

/// If the robot has turned back on its road: the heading of that road, the way it now leads, beside the robot.
std::optional<float> Perception::way_back_rad() const {
  const auto middle = road_.turned_back() ? road_.middle(reckoning_.at) : std::nullopt;
  return middle ? std::optional(middle->heading_rad) : std::nullopt;
}

/// Whether the robot faces back along its road; if the road is unknown, whether it has made half a turn.
bool Perception::come_about() const {
  const auto back = way_back_rad();
  if (!back) return std::abs(round_rad_) > kHalfTurn;
  return std::abs(wrap(static_cast<double>(reckoning_.at.heading_rad - *back))) < kTurnedTo;
}

void Perception::write(std::span<float> facts) {
  write_landmark(facts);
  write_memory(facts);
  write_tracks(facts);
  const bool line = line_counts();
  put(facts, cells_->line, !senses_.line_known ? 0.0f : line ? kSure : -kSure);
  out_told_ = out_told_ || (line && phase_ != Phase::kApproach);
  out_awaited_ = out_awaited_ && !line;
  line_seen_ = false;
  put(facts, cells_->obstacle, obstacle_certainty());
  put(facts, cells_->touched, touched_ ? kSure : -kSure);
  touched_ = false;
  for (const NamedFact& blind : cells_->blind) {
    const bool sees = blind.name == "line" ? line_sight_.sees() && !line_missed() : range_sight_.sees() && !front_unknown_;
    put(facts, blind.fact, sees ? -kSure : kSure);
  }
  put(facts, cells_->carried, carried_s_ > 0.0f ? kSure : -kSure);
  put(facts, cells_->due, due() ? kSure : -kSure);
  put(facts, cells_->trapped, plight_ == mts::Plight::kTrapped ? kSure : -kSure);
  put(facts, cells_->no_way, plight_ == mts::Plight::kNoWay ? kSure : -kSure);
  const bool turning = doing_ != nullptr && doing_->doing == Doing::kRound;
  put(facts, cells_->turned, turning && come_about() ? kSure : -kSure);
}

const std::string* Perception::tag_text() const {
  return phase_ != Phase::kOnRoad && memory_ != nullptr ? &memory_->landmark : nullptr;
}

const std::string* Perception::memory_text() {
  if (memory_ == nullptr) return nullptr;
  if (phase_ == Phase::kApproach && !memory_->methods.empty()) {
    memory_text_ = "cross " + memory_->methods.front();
  } else if (phase_ == Phase::kLeaving || (phase_ == Phase::kInside && exit_ != kNoExit)) {
    memory_text_ = "move " + memory_->exits[phase_ == Phase::kLeaving ? arm_ : exit_].method;
  } else {
    return nullptr;
  }
  return &memory_text_;
}

}  // namespace kb::sim
