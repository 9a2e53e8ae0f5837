#include "sim/mind/hall_planner.h"

#include <algorithm>
#include <cmath>

#include "planners/genetic.h"
#include "planners/method.h"
#include "sim/robot/sensors.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kTrusted = 0.8;         // m: see note [what the map does not show]
constexpr double kNotOnMap = 0.18;       // m: what is nearer than the map says by this is not on the map
constexpr double kConeBroad = kConeHalf + 0.1;
constexpr double kSeenApart = 0.05;      // m
constexpr double kSeenRadius = 0.03;     // m
constexpr double kStartAside = 0.4;      // m: how far from a blocked place it looks for a free one
constexpr double kAtRobot = 0.15;        // m
constexpr double kNearEnd = 0.4;         // m: this near to the end of the corners told, the next ones are told
constexpr int kLeastLooks = 25;          // between two plans: 25 control periods are half a second

Spot spot(planners::Point point) { return {point.x, point.y}; }
planners::Point point(Spot at) { return {at.x_m, at.y_m}; }

/// The middle of the free cell nearest to a place; nothing if that is `most_m` away or more.
std::optional<planners::Point> free_near(const planners::Grid& grid, Spot at, double most_m) {
  const planners::Cell here = grid.cell_at(point(at));
  const auto reach = static_cast<std::int32_t>(most_m / grid.cell_m()) + 1;
  std::optional<planners::Point> best;
  double best_m = most_m;
  for (std::int32_t y = here.y - reach; y <= here.y + reach; ++y) {
    for (std::int32_t x = here.x - reach; x <= here.x + reach; ++x) {
      if (grid.blocked({x, y}) || distance(spot(grid.centre({x, y})), at) >= best_m) continue;
      best = grid.centre({x, y});
      best_m = distance(spot(*best), at);
    }
  }
  return best;
}

}  // namespace

void HallPlanner::enter(std::shared_ptr<const HallMap> map, Spot begins) {
  if (map != map_) seen_.clear();
  map_ = std::move(map);
  begins_ = begins;
  forgot_ = false;
}

bool HallPlanner::notice(const mts::WayQuestion& question, Spot at) {
  bool news = false;
  for (std::size_t i = 0; i < mts::kRangeFinders && question.senses->range_known; ++i) {
    const double range_m = static_cast<double>(question.senses->range_m[i]);
    if (range_m > kTrusted) continue;
    const double axis_rad = static_cast<double>(question.at.heading_rad + mts::range_finder_rad(i));
    double expected_m = kTrusted + 1.0;
    for (const double off_rad : {-1.0, -0.5, 0.0, 0.5, 1.0}) expected_m = std::min(expected_m, map_->ray(at, direction(axis_rad + off_rad * kConeBroad), expected_m));
    if (range_m > expected_m - kNotOnMap) continue;
    const Spot there = at + range_m * direction(axis_rad);
    if (map_->clearance(there) < kNotOnMap) continue;
    const bool known = std::any_of(seen_.begin(), seen_.end(), [&](Spot s) { return distance(s, there) < kSeenApart; });
    if (known) continue;
    seen_.push_back(there);
    news = true;
  }
  return news;
}

void HallPlanner::make_grid(const mts::PlanGains& gains) {
  const double clearance_m = static_cast<double>(gains.clearance_m);
  grid_ = map_->grid(static_cast<double>(gains.cell_m), clearance_m);
  const auto reach = static_cast<std::int32_t>((clearance_m + kSeenRadius) / grid_.cell_m()) + 1;
  for (const Spot& seen : seen_) {
    const planners::Cell middle = grid_.cell_at(point(seen));
    for (std::int32_t y = middle.y - reach; y <= middle.y + reach; ++y) {
      for (std::int32_t x = middle.x - reach; x <= middle.x + reach; ++x) {
        if (grid_.contains(planners::Cell{x, y}) && distance(spot(grid_.centre({x, y})), seen) < clearance_m + kSeenRadius) grid_.set_blocked({x, y}, true);
      }
    }
  }
}

/// Whether the straight line between two places leads over free cells only.
bool HallPlanner::sees(Spot from, Spot to) const {
  const int steps = static_cast<int>(std::ceil(distance(from, to) / (0.25 * grid_.cell_m())));
  for (int i = 0; i <= steps; ++i) {
    if (grid_.blocked(grid_.cell_at(point(from + (static_cast<double>(i) / std::max(steps, 1)) * (to - from))))) return false;
  }
  return true;
}

/// Whether something stands on the rest of the way. Blocked cells close to the robot do not count: it is just driving out of them.
bool HallPlanner::blocked(Spot at) const {
  const double from_m = nearest_along(way_, at).along_m + kAtRobot;
  const double end_m = length_of(way_), step_m = 0.5 * grid_.cell_m();
  for (double along_m = from_m; along_m < end_m; along_m += step_m) {
    if (grid_.blocked(grid_.cell_at(point(point_on(way_, along_m).at)))) return true;
  }
  return false;
}

planners::Result HallPlanner::ask(const planners::Problem& problem, const mts::PlanGains& gains) const {
  planners::RunOptions run;
  run.seed = static_cast<std::uint64_t>(gains.seed);
  if (method_ == Method::kNeuralMap) return planners::plan(*planners::find_method("neural"), problem, run);
  planners::GeneticOptions options;
  options.population = static_cast<std::uint32_t>(gains.population);
  options.max_generations = static_cast<std::uint32_t>(gains.generations);
  return planners::evolve(problem, run, options).result;
}

mts::WayNews HallPlanner::plan(const mts::WayQuestion& question, Spot at, Spot goal) {
  looks_ = 0;
  make_grid(*question.gains);
  const auto from = free_near(grid_, at, kStartAside), to = free_near(grid_, goal, kStartAside);
  planners::Result result = planners::ended(planners::Outcome::kUnreachable);
  if (from && to) result = ask({&grid_, *from, *to}, *question.gains);
  if (result.outcome == planners::Outcome::kUnreachable && !seen_.empty() && !forgot_) {
    forgot_ = true;   // see note [what the map does not show]
    seen_.clear();
    return plan(question, at, goal);
  }
  if (result.outcome == planners::Outcome::kUnreachable) return mts::WayNews::kNoWay;
  if (result.outcome != planners::Outcome::kReached) return mts::WayNews::kFailed;
  // The way leads from corner to corner, each the farthest place of the path that can be seen from the corner before.
  way_ = {at};
  std::size_t corner = 0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    if (i + 1 < result.path.size() && sees(spot(result.path[corner]), spot(result.path[i + 1]))) continue;
    if (corner == 0 && !sees(at, spot(result.path[i]))) way_.push_back(spot(result.path[0]));
    way_.push_back(spot(result.path[i]));
    corner = i;
  }
  way_.push_back(goal);
  return mts::WayNews::kNew;
}

/// Tells the controller the next corners, as pieces that begin at `at`.
void HallPlanner::tell(Spot at, mts::Way& way) {
  way.count = 0;
  Spot from = at;
  while (told_ < way_.size() && way.count < mts::kLongestCourse) {
    const Spot piece = way_[told_] - from;
    if (length(piece) > 0.01) way.pieces[way.count++] = {static_cast<float>(heading(piece)), static_cast<float>(length(piece))};
    from = way_[told_++];
  }
  way.whole = told_ == way_.size();
}

mts::WayNews HallPlanner::look(const mts::WayQuestion& question, mts::Way& way) {
  if (map_ == nullptr) return mts::WayNews::kNoWay;
  const auto on_map = [&](const mts::Place& place) {
    return begins_ + Spot{static_cast<double>(place.x_m - question.in.x_m), static_cast<double>(place.y_m - question.in.y_m)};
  };
  const Spot at = on_map(question.at);
  ++looks_;
  bool again = question.first;
  if (notice(question, at)) {
    make_grid(*question.gains);
    again = again || (blocked(at) && looks_ > kLeastLooks);
  } else if (looks_ == kLeastLooks) {
    again = again || blocked(at);
  }
  if (again) {
    const mts::WayNews news = plan(question, at, on_map(question.gate));
    if (news != mts::WayNews::kNew) return news;
    told_ = 1;
  } else if (told_ == way_.size() || distance(at, way_[told_ - 1]) > kNearEnd) {
    return mts::WayNews::kSame;
  }
  tell(at, way);
  return mts::WayNews::kNew;
}

}  // namespace kb::sim
