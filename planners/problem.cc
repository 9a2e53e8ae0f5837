#include "planners/problem.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace kb::planners {
namespace {

constexpr std::array<std::string_view, 7> kOutcomes = {"reached", "unreachable", "trapped", "limit",
                                                       "numeric", "conflict",    "invalid"};
constexpr std::array<std::string_view, 10> kFaults = {"",
                                                     "the map has no cells",
                                                     "a coordinate is no finite number",
                                                     "the start lies outside of the map",
                                                     "the goal lies outside of the map",
                                                     "the start is blocked",
                                                     "the goal is blocked",
                                                     "a parameter is out of its range",
                                                     "two robots start in the same cell",
                                                     "the method knows no moving obstacles"};
constexpr std::array<std::string_view, 4> kTraps = {"", "rest", "chatter", "cycle"};
constexpr std::array<std::string_view, 8> kStops = {"", "steps", "generations", "sweeps", "isolines", "room", "time", "cancelled"};

}  // namespace

std::string_view name(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }
std::string_view name(Fault fault) { return kFaults[static_cast<std::size_t>(fault)]; }
std::string_view name(Trap::Kind kind) { return kTraps[static_cast<std::size_t>(kind)]; }
std::string_view name(Stop stop) { return kStops[static_cast<std::size_t>(stop)]; }

Fault find_fault(const Problem& problem) {
  if (problem.grid == nullptr || problem.grid->empty()) return Fault::kEmptyMap;
  if (!is_finite(problem.start) || !is_finite(problem.goal)) return Fault::kNotFinite;
  const Grid& grid = *problem.grid;
  if (!grid.contains(problem.start)) return Fault::kStartOutside;
  if (!grid.contains(problem.goal)) return Fault::kGoalOutside;
  if (grid.blocked(problem.start_cell())) return Fault::kStartBlocked;
  if (grid.blocked(problem.goal_cell())) return Fault::kGoalBlocked;
  const double tolerance = problem.goal_tolerance_cells;
  if (!(tolerance > 0.0) || !std::isfinite(tolerance)) return Fault::kBadParameter;
  return Fault::kNone;
}

Watch::Watch(const RunOptions& run) : run_(&run) {
  if (run.budget.count() > 0) {
    end_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(run.budget);
  }
}

void Watch::look() {
  if (run_->cancel != nullptr && run_->cancel->load(std::memory_order_relaxed)) stop_ = Stop::kCancelled;
  else if (run_->budget.count() > 0 && std::chrono::steady_clock::now() >= end_) stop_ = Stop::kTime;
}

std::chrono::nanoseconds Watch::left() const {
  if (run_->budget.count() <= 0) return std::chrono::nanoseconds{0};
  return std::max(std::chrono::nanoseconds{1}, std::chrono::duration_cast<std::chrono::nanoseconds>(end_ - std::chrono::steady_clock::now()));
}

double length(const std::vector<Point>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
  return sum;
}

std::vector<Point> centres(const Grid& grid, const std::vector<Cell>& cells) {
  std::vector<Point> points;
  points.reserve(cells.size());
  for (const Cell cell : cells) points.push_back(grid.centre(cell));
  return points;
}

Result reached(const Grid& grid, const std::vector<Cell>& cells) {
  Result result;
  result.outcome = Outcome::kReached;
  result.path = centres(grid, cells);
  std::uint64_t straight = 0, diagonal = 0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const bool dx = cells[i].x != cells[i - 1].x, dy = cells[i].y != cells[i - 1].y;
    straight += dx != dy ? 1 : 0;
    diagonal += dx && dy ? 1 : 0;
  }
  result.length_m = (static_cast<double>(straight) + kSqrt2 * static_cast<double>(diagonal)) * grid.cell_m();
  return result;
}

Result ended(Outcome outcome) {
  Result result;
  result.outcome = outcome;
  return result;
}

Result ended_without_path(const Watch& watch) {
  Result result = ended(watch.why() == Stop::kNone ? Outcome::kUnreachable : Outcome::kLimit);
  result.statistics.stop = watch.why();
  return result;
}

Result rejected(Fault fault) {
  Result result;
  result.fault = fault;
  return result;
}

}  // namespace kb::planners
