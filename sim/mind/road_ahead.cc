#include "sim/mind/road_ahead.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <waymark/controllers/line_sight.h>
#include <waymark/controllers/road_map.h>
#include <waymark/controllers/road_sight.h>

namespace kb::sim {
namespace {

constexpr double kDue = 0.35, kDrift = 0.03;   // m, and as a share of the way
constexpr double kPassedEnd = 0.12, kRounding = 1e-4;   // m
constexpr double kNearBy = 0.4;                // m along a road, plus kDrift of the way to there: the errors of odometry and of the rounded bend
constexpr double kSeeks = 0.3;                 // m to either side, in search of a line from which it was pushed away
constexpr float kRejoin = 0.35f;               // m ahead: where it comes back to the middle of the road
constexpr double kStillBeside = 0.08;               // m
constexpr float kClearOfBend = 0.45f;          // m: this far from a bend, line and walls are straight beside the robot
constexpr float kFacesAlong = 0.25f;           // rad
constexpr double kBendShows = 0.5;             // rad: the heading tells a sharper bend from straight on
constexpr double kNoticed = 0.12, kStopLineEnds = 0.45;   // m, to either side of a road's end
constexpr double kLargestShift = 0.3;          // m: a line farther aside is not that of this road
constexpr float kShiftTau = 0.5f;              // s

}  // namespace

void RoadAhead::enter(std::shared_ptr<const Memory> memory, std::uint32_t exit, const mts::Place& at, Spot begin) {
  memory_ = entered_ = std::move(memory);
  exit_ = entered_by_ = exit;
  x_m_ = at.x_m - static_cast<float>(begin.x_m);
  y_m_ = at.y_m - static_cast<float>(begin.y_m);
  turned_back_ = over_ = reversed_ = false;
}

void RoadAhead::turn_back() {
  if (!known()) return;
  const Memory::Exit& came = memory_->exits[exit_];
  auto back = std::make_shared<Memory>();
  Memory::Exit exit;
  exit.method = came.method;
  for (auto at = came.course.rbegin(); at != came.course.rend(); ++at) exit.course.push_back(*at - came.course.back());
  exit.heading_rad = heading(exit.course[1] - exit.course[0]);
  exit.hall = came.hall;
  exit.hall_begins = came.hall_begins + came.course.back();
  x_m_ += static_cast<float>(came.course.back().x_m);
  y_m_ += static_cast<float>(came.course.back().y_m);
  back->exits.push_back(std::move(exit));
  memory_ = std::move(back);
  exit_ = 0;
  turned_back_ = true;
  reversed_ = !reversed_;
  over_ = false;
}

bool RoadAhead::begins_at(const Memory& memory, std::uint32_t arm) const {
  return known() && memory_->landmark == memory.landmark && exit_ == arm && !turned_back_;
}

std::string_view RoadAhead::method() const { return known() ? std::string_view(memory_->exits[exit_].method) : std::string_view(); }

Progress RoadAhead::progress(const mts::Place& at) const {
  Progress answer;
  if (!known()) return answer;
  const std::vector<Spot>& chain = course();
  const Spot here = spot_of(at);
  const Along near = nearest_along(chain, here);
  answer.along_m = static_cast<float>(near.along_m);
  answer.aside_m = static_cast<float>(near.distance_m);
  // Past an end, the distance from the line of the end piece counts, not that from the end: odometry knows only roughly how long the road is.
  const double end_m = length_of(chain);
  const bool past_end = near.along_m < 1e-6 || near.along_m > end_m - 1e-6;
  if (past_end && near.distance_m < kNearBy) {
    const std::size_t end = near.along_m < 1e-6 ? 1 : chain.size() - 1;
    answer.aside_m = static_cast<float>(std::abs(cross(direction(heading(chain[end] - chain[end - 1])), here - chain[end])));
  }
  const double near_m = kNearBy + kDrift * near.along_m;
  double passed = 0.0, turned = 4.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const double piece_m = distance(chain[i - 1], chain[i]);
    const double off_rad = std::abs(wrap(static_cast<double>(at.heading_rad) - heading(chain[i] - chain[i - 1])));
    const bool near_by = near.along_m > passed - near_m && near.along_m < passed + piece_m + near_m;
    if (near_by && off_rad < turned) turned = off_rad, answer.piece = i;
    passed += piece_m;
    const double to_bend_m = std::max(std::abs(passed - near.along_m) - kDrift * near.along_m, 0.0);
    if (i + 1 < chain.size()) answer.to_bend_m = std::min(answer.to_bend_m, static_cast<float>(to_bend_m));
  }
  answer.turned_rad = static_cast<float>(turned);
  return answer;
}

bool RoadAhead::due(const mts::Place& at) const {
  return known() && distance(spot_of(at), course().back()) < kDue + kDrift * length_of(course());
}

double RoadAhead::behind_end_m(Spot here) const {
  if (nearest_along(course(), here).along_m < length_of(course()) - kRounding) return 0.0;
  return std::max(dot(here - course().back(), direction(end_heading_rad())), 0.0);
}

bool RoadAhead::passed(const mts::Place& at) const {
  return known() && behind_end_m(spot_of(at)) > kPassedEnd + kDrift * length_of(course());
}

std::optional<MapPlace> RoadAhead::where(const mts::Place& at) const {
  if (!known()) return std::nullopt;
  const Progress now = progress(at);
  const auto along_m = static_cast<double>(now.along_m);
  const Memory::Exit& by = entered_->exits[entered_by_];
  return MapPlace{entered_->landmark, by.name, by.stop_m + (reversed_ ? length_of(course()) - along_m : along_m), (static_cast<double>(now.turned_rad) < kPi / 2) != reversed_};
}

float RoadAhead::left_of_end_m(const mts::Place& at) const {
  if (!known() || turned_back_) return 0.0f;
  const double left_m = cross(direction(end_heading_rad()), spot_of(at) - course().back());
  return std::abs(left_m) > kNoticed && std::abs(left_m) < kStopLineEnds ? static_cast<float>(left_m) : 0.0f;
}

std::optional<mts::Place> RoadAhead::middle(const mts::Place& at) const {
  if (!known()) return std::nullopt;
  const OnChain there = point_on(course(), static_cast<double>(progress(at).along_m));
  return mts::Place{x_m_ + static_cast<float>(there.at.x_m), y_m_ + static_cast<float>(there.at.y_m), static_cast<float>(there.heading_rad)};
}

bool RoadAhead::holds(Spot spot, double from_m, double ahead_m, double half_m) const {
  const Along there = nearest_along(course(), spot - Spot{static_cast<double>(x_m_), static_cast<double>(y_m_)});
  return there.distance_m < half_m && there.along_m > from_m - kStillBeside && there.along_m < from_m + ahead_m;
}

bool RoadAhead::has_room_to_seek(const mts::Place& at) const {
  return known() && static_cast<double>(progress(at).along_m) + 4.0 * kSeeks + kStopLineEnds < length_of(course());
}

void RoadAhead::tell(mts::Task& task, const mts::Place& at, Back back) const {
  const std::vector<Spot>& chain = course();
  const Progress now = progress(at);
  Spot here = spot_of(at);
  const double end_m = length_of(chain);
  double along_m = static_cast<double>(now.along_m);
  const bool beside = now.aside_m > 0.03f && back != Back::kNever;
  bool room = true;
  const auto add = [&](Spot to) {
    if (!room || distance(here, to) < 0.01) return;
    room = mts::append(task, {static_cast<float>(heading(to - here)), static_cast<float>(distance(here, to))});
    here = to;
  };
  if (back == Back::kToLine) {   // a zigzag: to the left of the middle, to the right of it, and back
    const OnChain begins = point_on(chain, along_m);
    const Spot along = direction(begins.heading_rad), aside = kSeeks * left_of(along);
    for (const auto& [far_m, side] : {std::pair(kSeeks, 1.0), std::pair(3.0 * kSeeks, -1.0), std::pair(4.0 * kSeeks, 0.0)}) add(begins.at + far_m * along + side * aside);
    along_m += 4.0 * kSeeks;
  } else if (beside) {
    along_m += static_cast<double>(kRejoin) + behind_end_m(here);
    const double beyond_m = std::max(along_m - end_m, 0.0);   // near or past the end it comes to the middle farther on, instead of turning back
    along_m -= beyond_m;
    add(point_on(chain, along_m).at + beyond_m * direction(end_heading_rad()));
  } else {
    const Spot first = direction(heading(chain[1] - chain[0]));
    // At the stop line the line sensors are where the road begins; the robot's centre is before that.
    const double before_m = along_m < 1e-6 ? std::min(dot(here - chain[0], first), 0.0) : 0.0;
    here = point_on(chain, along_m).at + before_m * first;
  }
  double passed = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    passed += distance(chain[i - 1], chain[i]);
    if (passed > along_m) add(chain[i]);
  }
  if (beside) add(here + static_cast<double>(kRejoin) * direction(end_heading_rad()));   // crosses the stop line at a right angle
  const auto door = [&](Spot spot, Spot along) {
    return mts::Door{static_cast<float>(spot.x_m) - (at.x_m - x_m_), static_cast<float>(spot.y_m) - (at.y_m - y_m_), static_cast<float>(heading(along))};
  };
  task.in = door(chain.front(), chain[1] - chain[0]);
  task.out = door(chain.back(), chain.back() - chain[chain.size() - 2]);
}

// Odometry does not know exactly where a bend is: a robot that faces along the piece behind it has passed it, wherever the bend was
// reckoned to be.
void RoadAhead::settle(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, float dt_s) {
  if (!known()) return;
  const Progress now = progress(at);
  if (now.turned_rad > kFacesAlong) return;
  OnChain there = point_on(course(), static_cast<double>(now.along_m));
  const bool passed_bend = std::abs(wrap(static_cast<double>(at.heading_rad) - there.heading_rad)) > kBendShows;
  if (passed_bend) there = {course()[now.piece], heading(course()[now.piece] - course()[now.piece - 1])};
  else if (now.to_bend_m < kClearOfBend) return;
  const Spot along = direction(there.heading_rad);
  float aside_m = 0.0f;
  const auto turned_rad = static_cast<float>(wrap(static_cast<double>(at.heading_rad) - there.heading_rad));
  if (!mts::see_middle(senses, body, memory_->exits[exit_].method.c_str(), turned_rad, aside_m)) return;
  const double off_m = cross(along, spot_of(at) - there.at) - static_cast<double>(aside_m);   // how far the road lies to the left of where it was reckoned
  if (std::abs(off_m) > kLargestShift + kDrift * static_cast<double>(now.along_m)) return;
  const double shift_m = off_m * static_cast<double>(dt_s / (kShiftTau + dt_s));
  x_m_ += static_cast<float>(shift_m * left_of(along).x_m);
  y_m_ += static_cast<float>(shift_m * left_of(along).y_m);
}

bool RoadAhead::cross_line(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, bool pushed) {
  if (method() != "mark" || !senses.line_known) return false;
  const mts::LineSight line = mts::look_at_line(senses, body);
  const Progress now = progress(at);
  const double along_m = static_cast<double>(now.along_m);
  const bool at_end = !pushed && (along_m < kStopLineEnds || along_m > length_of(course()) - kStopLineEnds);   // a line near an end may be a stop line
  if (line.strength < 1.0f || now.turned_rad < kFacesAlong || now.to_bend_m < kClearOfBend || at_end) return false;
  const OnChain there = point_on(course(), along_m);
  const Spot ahead = direction(static_cast<double>(at.heading_rad)), along = direction(there.heading_rad);
  const Spot paint = spot_of(at) + static_cast<double>(body.line_ahead_m) * ahead + static_cast<double>(line.left_m) * left_of(ahead);
  const double off_m = cross(along, paint - there.at);
  if (std::abs(off_m) > kLargestShift + kDrift * along_m) return false;
  x_m_ += static_cast<float>(off_m * left_of(along).x_m);
  y_m_ += static_cast<float>(off_m * left_of(along).y_m);
  return std::abs(off_m) > kStillBeside;
}

}  // namespace kb::sim
