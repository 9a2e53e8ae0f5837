#include "sim/mind/perception.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kInOrOut = 0.35f;            // cosine: heads for the crossing, or away from it
constexpr float kReadingLasts = 0.25f;       // s: a reading fails now and then
constexpr float kApproachLasts = 0.8f;       // m, past the last reading
constexpr float kCrossingLasts = 3.0f;       // m, in a crossing without a sign of its exits
constexpr float kFades = 0.15f;              // of the certainty of a landmark, a metre
constexpr float kObstacleNear = 0.40f;       // m, on a road
constexpr float kObstacleCrossing = 0.22f;   // m, where walls may stand ahead
constexpr float kObstacleAside = 0.20f;      // m, ahead to the left and right
constexpr double kDue = 0.35, kDrift = 0.03;    // m, and of the way
constexpr double kTrackHalf = 0.20;           // m: the robot's radius, and room
constexpr double kBehind = 0.08;              // m
constexpr float kRoadOff = 0.35f;             // m: so far from the middle of the road it is not to be found
constexpr float kAlong = 0.7f;                // rad: so far turned it does not come back to the road from an obstacle
constexpr float kBendNear = 0.7f;            // m
constexpr double kNearBy = 0.4;              // m, along a road: the odometry's error, and the bend's
constexpr float kAcross = 1.3f;              // rad: so far turned it does not drive along a road
constexpr float kWallNear = 0.5f;            // m
constexpr float kAside = 0.12f;              // m: so far from the middle of a road it is beside it
constexpr float kRejoin = 0.35f;             // m, ahead, where it comes back to the middle
constexpr float kHalfTurn = 2.96f;           // rad: 170 degrees

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

void Perception::hear(const mts::Senses& senses, const TagHeard& tag, float dt_s) {
  senses_ = senses;
  if (!reckons_) reckoning_.start(senses, {});
  reckons_ = true;
  const float before_m = reckoning_.travelled_m();
  reckoning_.step(senses, dt_s);
  since_m_ += reckoning_.travelled_m() - before_m;
  round_rad_ += static_cast<float>(wrap(static_cast<double>(reckoning_.at.heading_rad - last_heading_rad_)));
  last_heading_rad_ = reckoning_.at.heading_rad;
  hear_tag(tag, dt_s);
  hear_line(dt_s);
  hear_range();
}

void Perception::hear_tag(const TagHeard& tag, float dt_s) {
  tag_alive_ = tag.alive;
  unread_s_ += dt_s;
  const bool wanders = doing_ != nullptr && (doing_->doing == Doing::kAvoid || (doing_->doing == Doing::kMove && in_hall()));
  const bool goes_round = wanders && (phase_ == Phase::kOnRoad || phase_ == Phase::kLeaving) && road_ != nullptr;
  const bool left_behind = goes_round && tag.memory != nullptr && tag.memory->landmark == road_->landmark;   // seen again on the way round
  if (tag.memory != nullptr && reckoning_.heading_known() && !left_behind) {
    const double outwards = std::cos(static_cast<double>(reckoning_.at.heading_rad) - tag.memory->exits[tag.arm].heading_rad);
    const bool same = memory_ != nullptr && memory_->landmark == tag.memory->landmark;
    const bool inside = phase_ == Phase::kInside && same;
    if (outwards < -kInOrOut && !inside) phase_ = Phase::kApproach;
    if (outwards > kInOrOut && (!inside || since_m_ > 0.2f)) phase_ = Phase::kLeaving;
    if (phase_ != Phase::kOnRoad) {
      if (phase_ != Phase::kInside || same) memory_ = tag.memory;
      if (phase_ != Phase::kInside) arm_ = tag.arm;
      unread_s_ = 0.0f;
      if (phase_ != Phase::kInside) since_m_ = 0.0f;
    }
  }
  const bool passed = (phase_ == Phase::kLeaving && unread_s_ > kReadingLasts && since_m_ > 0.05f) ||
                      (phase_ == Phase::kApproach && since_m_ > kApproachLasts) || (phase_ == Phase::kInside && since_m_ > kCrossingLasts);
  if (passed) phase_ = Phase::kOnRoad;
}

void Perception::hear_line(float dt_s) {
  line_.hear(senses_, dt_s);
  line_seen_ = line_seen_ || line_.now();
}

void Perception::hear_range() {
  if (!senses_.range_known) {
    ahead_m_ = mts::kOutOfRange;
    return;
  }
  ahead_m_ += 0.5f * (senses_.range_m[0] - ahead_m_);   // a reading that is alone is none
}

Perception::Progress Perception::progress() const {
  Progress answer;
  if (road_ == nullptr) return answer;
  const std::vector<Spot>& chain = road_->exits[road_exit_].course;
  const Spot here{static_cast<double>(reckoning_.at.x_m - road_x_m_), static_cast<double>(reckoning_.at.y_m - road_y_m_)};
  const Along near = nearest_along(chain, here);
  answer.along_m = static_cast<float>(near.along_m);
  answer.aside_m = static_cast<float>(near.distance_m);
  // Past an end it is the distance from the end piece's line that counts: how long the road is, odometry knows only roughly.
  const double end_m = length_of(chain);
  const bool past_end = near.along_m < 1e-6 || near.along_m > end_m - 1e-6;
  if (past_end && near.distance_m < kNearBy) {
    const std::size_t end = near.along_m < 1e-6 ? 1 : chain.size() - 1;
    answer.aside_m = static_cast<float>(std::abs(cross(direction(heading(chain[end] - chain[end - 1])), here - chain[end])));
  }
  double passed = 0.0, turned = 4.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const double piece_m = distance(chain[i - 1], chain[i]);
    const bool near_by = near.along_m > passed - kNearBy && near.along_m < passed + piece_m + kNearBy;
    if (near_by) turned = std::min(turned, std::abs(wrap(static_cast<double>(reckoning_.at.heading_rad) - heading(chain[i] - chain[i - 1]))));
    passed += piece_m;
  }
  answer.turned_rad = static_cast<float>(turned);
  passed = 0.0;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    passed += distance(chain[i - 1], chain[i]);
    if (std::abs(passed - near.along_m) < static_cast<double>(answer.to_bend_m)) answer.to_bend_m = static_cast<float>(std::abs(passed - near.along_m));
  }
  return answer;
}

bool Perception::in_hall() const {
  if (road_ == nullptr || phase_ == Phase::kInside || road_->exits[road_exit_].hall == nullptr) return false;
  // The sign of an exit may be read before the road behind it has begun.
  const bool elsewhere = phase_ == Phase::kLeaving && !turned_back_ && memory_ != nullptr && memory_->landmark != road_->landmark;
  return !elsewhere;
}

/// How near something ahead must be to be an obstacle: where walls stand ahead as a matter of course, nearer.
float Perception::obstacle_at() const {
  if (phase_ == Phase::kInside) return kObstacleCrossing;
  const bool walled = road_ != nullptr && road_->exits[road_exit_].method == "dist";
  return walled && progress().to_bend_m < kBendNear ? kObstacleCrossing : kObstacleNear;
}

std::uint32_t Perception::exit_for(const Strategy& strategy) const {
  if (memory_ == nullptr) return kNoExit;
  const auto& exits = memory_->exits;
  const double turn = turn_word(strategy.turn).angle_rad;
  if (strategy.turn == "back") return arm_;
  // By the names, if they are points of the compass: of slanted roads they say more than the headings.
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

void Perception::enter(const Strategy& strategy) {
  if (phase_ == Phase::kInside) return;   // after an obstacle: it is still the same manoeuvre
  turned_back_ = false;
  exit_ = exit_for(strategy);
  phase_ = Phase::kInside;
  since_m_ = 0.0f;
}

/// A road begins: at the stop line, if it comes out of a crossing.
void Perception::set_out() {
  const bool known = memory_ != nullptr && (phase_ == Phase::kLeaving || (phase_ == Phase::kInside && exit_ != kNoExit));
  if (phase_ != Phase::kInside && (phase_ != Phase::kLeaving || turned_back_)) return;   // on the same road as before
  road_ = known ? memory_ : nullptr;
  if (known) {
    road_exit_ = phase_ == Phase::kInside ? exit_ : arm_;
    // On a map centimetres count: the row of sensors, ahead of the robot, has just seen the stop line.
    const bool hall = road_->exits[road_exit_].hall != nullptr;
    const double past_m = hall ? -static_cast<double>(kRobot.line_ahead_m) : phase_ == Phase::kInside ? 0.0 : static_cast<double>(kTagBefore);
    const Spot begin = past_m * direction(road_->exits[road_exit_].heading_rad);
    road_x_m_ = reckoning_.at.x_m - static_cast<float>(begin.x_m);
    road_y_m_ = reckoning_.at.y_m - static_cast<float>(begin.y_m);
  }
  if (phase_ == Phase::kInside) {
    if (known) arm_ = exit_;
    phase_ = Phase::kLeaving;
    since_m_ = unread_s_ = 0.0f;
  }
}

void Perception::begin(const Strategy* strategy) {
  const bool avoided = doing_ != nullptr && doing_->doing == Doing::kAvoid;
  doing_ = strategy;
  const bool avoids = strategy != nullptr && strategy->doing == Doing::kAvoid;
  if (avoids && !avoided) avoid();
  if (strategy == nullptr) return;
  if (strategy->doing == Doing::kCross) enter(*strategy);
  if (strategy->doing == Doing::kMove) set_out();
  if (strategy->doing == Doing::kRound) {
    round_rad_ = 0.0f;
    turn_back();
  }
}

/// The way back is the way that it came, whatever a tag at its end says.
void Perception::turn_back() {
  if (road_ == nullptr) return;
  const Memory::Exit& came = road_->exits[road_exit_];
  auto back = std::make_shared<Memory>();
  Memory::Exit exit;
  exit.method = came.method;
  for (auto at = came.course.rbegin(); at != came.course.rend(); ++at) exit.course.push_back(*at - came.course.back());
  exit.heading_rad = heading(exit.course[1] - exit.course[0]);
  exit.hall = came.hall;
  exit.hall_begins = came.hall_begins + came.course.back();
  road_x_m_ += static_cast<float>(came.course.back().x_m);
  road_y_m_ += static_cast<float>(came.course.back().y_m);
  back->exits.push_back(std::move(exit));
  road_ = std::move(back);
  road_exit_ = 0;
  turned_back_ = true;
}

/// By the way that was driven the robot stands where the road ends.
bool Perception::due() const {
  if (road_ == nullptr || phase_ == Phase::kInside || !senses_.odometry_known) return false;
  const std::vector<Spot>& course = road_->exits[road_exit_].course;
  const Spot here{static_cast<double>(reckoning_.at.x_m - road_x_m_), static_cast<double>(reckoning_.at.y_m - road_y_m_)};
  return distance(here, course.back()) < kDue + kDrift * length_of(course);
}

mts::Task Perception::task_for(const Strategy& strategy) const {
  mts::Task task;
  task.turn = turn_word(strategy.turn).turn;
  if (strategy.doing == Doing::kCross && memory_ != nullptr) {
    const Memory::Exit& came = memory_->exits[arm_];
    task.entry_heading_rad = static_cast<float>(wrap(came.heading_rad + kPi));
    task.entry_known = true;
    const double turned = came.heading_rad + kPi + turn_word(strategy.turn).angle_rad;
    task.exit_heading_rad = static_cast<float>(wrap(exit_ == kNoExit ? turned : memory_->exits[exit_].heading_rad));
    task.crossing_m = static_cast<float>(came.stop_m + (exit_ == kNoExit ? came.stop_m : memory_->exits[exit_].stop_m));
  }
  if (strategy.doing == Doing::kAvoid && avoids_) task.course[task.pieces++] = {avoid_heading_rad_, 1e3f};
  if (strategy.doing != Doing::kMove || road_ == nullptr) return task;
  const std::vector<Spot>& chain = road_->exits[road_exit_].course;
  const Progress now = progress();
  Spot here{static_cast<double>(reckoning_.at.x_m - road_x_m_), static_cast<double>(reckoning_.at.y_m - road_y_m_)};
  const double end_m = length_of(chain);
  double along_m = static_cast<double>(now.along_m);
  const auto add = [&](Spot to) {
    if (task.pieces == mts::kLongestCourse || distance(here, to) < 0.01) return;
    task.course[task.pieces++] = {static_cast<float>(heading(to - here)), static_cast<float>(distance(here, to))};
    here = to;
  };
  if (now.aside_m > 0.03f) {
    along_m = std::min(along_m + static_cast<double>(kRejoin), end_m);
    add(point_on(chain, along_m).at);
  } else {
    here = point_on(chain, along_m).at;
  }
  double passed = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    passed += distance(chain[i - 1], chain[i]);
    if (passed > along_m) add(chain[i]);
  }
  if (now.aside_m > 0.03f) add(here + static_cast<double>(kRejoin) * direction(heading(chain.back() - chain[chain.size() - 2])));   // square over the line
  const auto door = [&](Spot at, Spot along) {
    return mts::Door{static_cast<float>(at.x_m) - (reckoning_.at.x_m - road_x_m_), static_cast<float>(at.y_m) - (reckoning_.at.y_m - road_y_m_),
                     static_cast<float>(heading(along))};
  };
  task.in_hall = in_hall();
  task.in = door(chain.front(), chain[1] - chain[0]);
  task.out = door(chain.back(), chain.back() - chain[chain.size() - 2]);
  return task;
}

void Perception::write_landmark(std::span<float> facts) const {
  const bool turned_away = turned_back_ && phase_ == Phase::kLeaving;   // from a sign that could not be read, or was wrong
  const bool here = phase_ != Phase::kOnRoad && memory_ != nullptr && !turned_away;
  const float nothing = tag_alive_ ? -kSure : 0.0f;
  for (const NamedFact& landmark : cells_->landmarks) {
    const bool it = here && landmark.name == memory_->landmark;
    put(facts, landmark.fact, it ? std::max(kSure - kFades * since_m_, 0.0f) : nothing);
  }
}

void Perception::write_memory(std::span<float> facts) const {
  if (memory_ == nullptr) return;
  if (phase_ == Phase::kApproach) {
    put(facts, cells_->safe, memory_->safe ? kSure : -kSure);
    for (const NamedFact& in : cells_->in) put(facts, in.fact, in.name == memory_->exits[arm_].name ? kSure : -kSure);
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
  const std::uint32_t exit = phase_ == Phase::kInside ? exit_ : phase_ == Phase::kLeaving ? arm_ : kNoExit;
  if (exit == kNoExit) return;
  const std::string& method = turned_back_ && phase_ == Phase::kLeaving ? road_->exits[road_exit_].method : memory_->exits[exit].method;
  for (const NamedFact& by : cells_->move_by) put(facts, by.fact, by.name == method ? kSure : -kSure);
}

void Perception::write_tracks(std::span<float> facts) const {
  const bool on_road = road_ != nullptr && phase_ == Phase::kOnRoad;
  const Progress now = on_road ? progress() : Progress{};
  const bool beside = now.aside_m > kAside, avoiding = doing_ != nullptr && doing_->doing == Doing::kAvoid;
  for (const NamedFact& track : cells_->track) {
    const bool paved = track.name == "mark" || track.name == "dist" || track.name == "azimuth";
    if (!paved || in_hall()) {
      const bool sensed = senses_.odometry_known && senses_.range_known;
      const bool here = in_hall() && road_->exits[road_exit_].method == track.name;
      put(facts, track.fact, !here ? -kSure : sensed ? kSure : 0.0f);
    } else if (now.turned_rad > (avoiding ? kAlong : kAcross)) {   // nothing that it sees there is the road
      put(facts, track.fact, -kSure);
    } else if (track.name == "mark") {
      bool dark = false;
      for (const float darkness : senses_.line) dark = dark || darkness > StopLine::kDarkFrom;
      put(facts, track.fact, !senses_.line_known ? 0.0f : dark ? kSure : -kSure);
    } else if (track.name == "dist") {
      const int walls = (senses_.range_m[2] < kWallNear ? 1 : 0) + (senses_.range_m[6] < kWallNear ? 1 : 0);
      const bool enough = walls == 2 || (walls == 1 && now.to_bend_m < kBendNear);   // the outer one recedes there
      put(facts, track.fact, !senses_.range_known ? 0.0f : enough ? kSure : walls == 1 ? 0.3f : -kSure);
    } else {
      put(facts, track.fact, senses_.heading_known && !beside ? kSure : -kSure);
    }
  }
}

// note [an obstacle on the track]
// On a road an obstacle is what stands ahead. While it is driven round the robot looks elsewhere: then an obstacle is what stands
// on the track, wherever the robot looks.
void Perception::avoid() {
  avoids_ = phase_ != Phase::kInside;
  avoid_heading_rad_ = reckoning_.at.heading_rad;
  avoid_x_m_ = reckoning_.at.x_m;
  avoid_y_m_ = reckoning_.at.y_m;
  if (road_ == nullptr || phase_ == Phase::kInside) return;
  const OnChain there = point_on(road_->exits[road_exit_].course, static_cast<double>(progress().along_m));
  const double off = wrap(static_cast<double>(avoid_heading_rad_) - there.heading_rad);
  if (std::abs(off) > 0.5 * kPi || progress().aside_m > kRoadOff) return;
  avoid_heading_rad_ = static_cast<float>(there.heading_rad);
  avoid_x_m_ = road_x_m_ + static_cast<float>(there.at.x_m);
  avoid_y_m_ = road_y_m_ + static_cast<float>(there.at.y_m);
}

/// Something that a range finder sees stands on the track, not far ahead.
bool Perception::on_track() const {
  const Spot along = direction(static_cast<double>(avoid_heading_rad_));
  const double left_m = cross(along, {static_cast<double>(reckoning_.at.x_m - avoid_x_m_), static_cast<double>(reckoning_.at.y_m - avoid_y_m_)});
  for (std::size_t i = 0; i < mts::kRangeFinders; ++i) {
    const double range_m = static_cast<double>(senses_.range_m[i]);
    const double rad = static_cast<double>(reckoning_.at.heading_rad - avoid_heading_rad_ + mts::range_finder_rad(i));
    const double ahead_m = range_m * std::cos(rad), aside_m = left_m + range_m * std::sin(rad);
    if (ahead_m > -kBehind && ahead_m < static_cast<double>(obstacle_at()) + kBehind && std::abs(aside_m) < kTrackHalf) return true;
  }
  return false;
}

float Perception::obstacle_certainty() const {
  if (!senses_.range_known) return 0.0f;
  const bool avoiding = avoids_ && doing_ != nullptr && doing_->doing == Doing::kAvoid;
  if (avoiding) return on_track() ? kSure : -kSure;   // see note [an obstacle on the track]
  const bool aside = phase_ != Phase::kInside && std::min(senses_.range_m[1], senses_.range_m[7]) < kObstacleAside;
  const float room_m = ahead_m_ - obstacle_at();
  return aside ? kSure : std::clamp(kSure - 2.0f * kSure * room_m / 0.08f, -kSure, kSure);
}

void Perception::write(std::span<float> facts) {
  write_landmark(facts);
  write_memory(facts);
  write_tracks(facts);
  put(facts, cells_->line, !senses_.line_known ? 0.0f : line_.now() || line_seen_ ? kSure : -kSure);
  line_seen_ = false;
  put(facts, cells_->obstacle, obstacle_certainty());
  put(facts, cells_->due, due() ? kSure : -kSure);
  put(facts, cells_->trapped, plight_ == mts::Plight::kTrapped ? kSure : -kSure);
  put(facts, cells_->no_way, plight_ == mts::Plight::kNoWay ? kSure : -kSure);
  const bool turning = doing_ != nullptr && doing_->doing == Doing::kRound;
  put(facts, cells_->turned, turning && std::abs(round_rad_) > kHalfTurn ? kSure : -kSure);
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
