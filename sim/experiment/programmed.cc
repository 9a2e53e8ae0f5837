#include "sim/experiment/programmed.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim::experiment {
namespace {

constexpr float kStandOff = 0.20f;        // m, from the robot's centre: it stops before anything ahead that is nearer
constexpr float kLeastRoadWay = 0.25f;    // m: a stop line met sooner is still the one that the robot has left

mts::Turn word_for(double turn_rad) {
  if (std::abs(turn_rad) > 0.75 * kPi) return mts::Turn::kBack;
  if (turn_rad > 0.25 * kPi) return mts::Turn::kLeft;
  return turn_rad < -0.25 * kPi ? mts::Turn::kRight : mts::Turn::kForward;
}

void add_pieces(mts::Task& task, const std::vector<Spot>& course) {
  for (std::size_t i = 1; i < course.size() && task.pieces < mts::kLongestCourse; ++i) {
    const Spot piece = course[i] - course[i - 1];
    if (length(piece) > 0.01) task.course[task.pieces++] = {static_cast<float>(heading(piece)), static_cast<float>(length(piece))};
  }
}

}  // namespace

Programmed::Programmed(const Labyrinth& labyrinth, const mts::Body& body, const Pose& start, const RoutePlan& route) : body_(body), line_(body) {
  moves_.doing = Doing::kMove;
  crosses_.doing = Doing::kCross;
  const CrossingId first = route.crossings.front();
  goal_ = labyrinth[route.crossings.back()].name;
  const Whereabouts where = locate(labyrinth, {start.x_m, start.y_m});
  const Road& road = labyrinth[where.road];
  const bool forward = road.to == first;
  const double from_m = forward ? road.begins_m + where.along_m : road.begins_m, to_m = forward ? road.ends_m : road.begins_m + where.along_m;
  std::vector<Spot> course = part_of(road.along, from_m, to_m);
  if (!forward) std::reverse(course.begin(), course.end());
  add_road(labyrinth, where.road, course, {.to = labyrinth[first].name});
  const Arm* came = labyrinth[first].arm(forward ? road.approach : road.exit);
  for (std::size_t i = 0; i < route.exits.size(); ++i) {
    add_crossing(labyrinth, route, i, *came);
    const Arm& exit = *route.exits[i];
    add_road(labyrinth, exit.road, labyrinth.course(exit), pieces_.back().leg);
    const Road& taken = labyrinth[exit.road];
    came = labyrinth[route.crossings[i + 1]].arm(exit.forward ? taken.approach : taken.exit);
  }
}

void Programmed::add_crossing(const Labyrinth& labyrinth, const RoutePlan& route, std::size_t i, const Arm& came) {
  const Crossing& crossing = labyrinth[route.crossings[i]];
  const Arm& exit = *route.exits[i];
  Piece piece;
  piece.crossing = true;
  piece.leg = {.from = crossing.name, .exit = exit.name, .to = labyrinth[route.crossings[i + 1]].name};
  const std::string method = crossing.methods.empty() ? "azimuth" : crossing.methods.front();
  piece.controller = method == "mark" ? mts::ControllerId::kTurnOnLine : method == "dist" ? mts::ControllerId::kTurnByWalls : mts::ControllerId::kTurnByCompass;
  piece.task.turn = word_for(wrap(exit.heading_rad - came.heading_rad - kPi));
  piece.task.entry_heading_rad = static_cast<float>(wrap(came.heading_rad + kPi));
  piece.task.entry_known = true;
  piece.task.exit_known = true;
  piece.task.exit_heading_rad = static_cast<float>(wrap(exit.heading_rad));
  piece.task.middle_m = static_cast<float>(came.stop_m);
  piece.task.crossing_m = static_cast<float>(came.stop_m + exit.stop_m);
  pieces_.push_back(std::move(piece));
}

void Programmed::add_road(const Labyrinth& labyrinth, RoadId road, std::vector<Spot> course, Leg leg) {
  Piece piece;
  const std::string& method = labyrinth[road].method;
  piece.controller = method == "mark" ? mts::ControllerId::kFollowLine : method == "dist" ? mts::ControllerId::kKeepWall : mts::ControllerId::kHoldHeading;
  piece.leg = std::move(leg);
  add_pieces(piece.task, course);
  pieces_.push_back(std::move(piece));
}

void Programmed::begin(const mts::Senses& senses) {
  const Piece& piece = pieces_[at_];
  controller_.choose(piece.controller, body_);
  if (!piece.crossing) static_cast<void>(controller_.set("speed", static_cast<float>(piece.controller == mts::ControllerId::kFollowLine ? kMarkSpeed : kOtherSpeed)));
  controller_.start(piece.task, senses);
  way_m_ = 0.0f;
  clear_ = false;
  began_ = true;
}

/// Whether the piece is over: a crossing when its manoeuvre is, a road at its next stop line.
bool Programmed::over(const mts::Senses& senses, float dt_s) {
  if (pieces_[at_].crossing) return controller_.done();
  way_m_ += std::abs(senses.speed_m_s) * dt_s;
  clear_ = clear_ || !line_.now();
  return clear_ && way_m_ > kLeastRoadWay && line_.now();
}

mts::Motion Programmed::step(std::int64_t /*now_us*/, const mts::Senses& raw, const TagHeard& /*tag*/, float dt_s) {
  const mts::Senses senses = steadied_.step(raw, dt_s);
  line_.step(senses, dt_s, false);
  if (!on_mission()) return {};
  if (!began_) begin(senses);
  if (over(senses, dt_s)) {
    ++at_;
    if (!on_mission()) return {};
    begin(senses);
  }
  const mts::Motion motion = controller_.step(senses, dt_s);
  const bool in_the_way = senses.range_known && senses.range_m[0] < kStandOff && motion.speed_m_s > 0.0f;
  return in_the_way ? mts::Motion{} : motion;
}

Judge::Belief Programmed::belief() const {
  Judge::Belief belief;
  if (!on_mission()) return belief;
  belief.leg = &pieces_[at_].leg;
  belief.strategy = pieces_[at_].crossing ? &crosses_ : &moves_;
  belief.driving = true;
  return belief;
}

}  // namespace kb::sim::experiment
