// Ascent, false peaks, mending of F4 fields, and the planner.
#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <queue>
#include <utility>

#include "planners/methods.h"
#include "planners/neural.h"
#include "planners/shortest.h"

namespace kb::planners {
namespace {

// The steepest neighbour, or the cell itself if none is higher.
CellIndex steepest(const Grid& grid, const NeuralMap& map, CellIndex at) {
  // Distances that are mathematically equal differ in their last bits; with F4 a slope counts only beyond that.
  const double grain = map.form == NeuralForm::kMax ? 1e-9 : 0.0;
  double best = grain;
  CellIndex to = at;
  for (unsigned open = grid.all_moves()[at]; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    const CellIndex next = grid.neighbour(at, k);
    if (!map.active(next)) continue;
    const double slope = (map.level[next] - map.level[at]) / kMoveLengths[k];
    if (slope > best) {
      best = slope + grain;
      to = next;
    }
  }
  return to;
}

// Adds the best distance that the neighbours of a cell offer it, if that is better than its own.
void offer(const Grid& grid, const NeuralMap& map, CellIndex at, std::vector<Offer>& offers) {
  double best = -map.level[at];
  for (unsigned open = grid.all_moves()[at]; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    best = std::min(best, -map.level[grid.neighbour(at, k)] + kMoveLengths[k]);
  }
  if (best < -map.level[at] - 1e-9) offers.push_back({best, at});
}

// Makes cells inactive, from the goal outwards, whose distance no neighbour holds any longer: a neighbour holds the distance
// of a cell if it is nearer by just the length of the move.
void forget_unheld(const Grid& grid, NeuralMap& map, CellIndex goal, std::vector<CellIndex> suspects,
                   std::vector<CellIndex>& forgotten) {
  using Entry = std::pair<double, CellIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const CellIndex at : suspects) {
    if (map.active(at)) queue.emplace(-map.level[at], at);
  }
  while (!queue.empty()) {
    const auto [d, at] = queue.top();
    queue.pop();
    if (!map.active(at) || at == goal) continue;
    bool held = false;
    for (unsigned open = grid.all_moves()[at]; open != 0 && !held; open &= open - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(open));
      held = -map.level[grid.neighbour(at, k)] + kMoveLengths[k] <= d + 1e-9;
    }
    if (held) continue;
    map.level[at] = map.inactive();
    forgotten.push_back(at);
    for (std::size_t k = 0; k < 8; ++k) {
      const CellIndex next = grid.neighbour(at, k);
      if (map.active(next) && -map.level[next] > d) queue.emplace(-map.level[next], next);
    }
  }
}

void add_neural_statistics(const NeuralMap& map, Result& result) {
  result.statistics.steps = map.sweeps;
  result.statistics.cells = map.updates;
  result.statistics.stop = map.stop;
  result.statistics.more.emplace_back("residual", map.residual);
}

Result answer(const Problem& problem, const NeuralMap& map) {
  const Grid& grid = *problem.grid;
  const Cell start = problem.start_cell(), goal = problem.goal_cell();
  Result result;
  if (map.active(grid.index(start))) {
    const std::vector<Cell> path = ascend(grid, map, start);
    result = reached(grid, path);
    if (path.back() != goal) {   // never with F2 to F4, unless digits were lost
      result.outcome = Outcome::kNumeric;
      result.refused = "the ascent ends before the goal";
    }
  } else if (map.stop == Stop::kTime || map.stop == Stop::kCancelled) {
    result = ended(Outcome::kLimit);
  } else {
    result = ended(!is_connected(grid, start, goal) ? Outcome::kUnreachable : map.stop == Stop::kNone ? Outcome::kNumeric : Outcome::kLimit);
    if (result.outcome == Outcome::kNumeric) result.refused = "so far from the goal activities are too small for a number";
  }
  add_neural_statistics(map, result);
  return result;
}

}  // namespace

std::vector<Cell> ascend(const Grid& grid, const NeuralMap& map, Cell from) {
  std::vector<Cell> path = {from};
  for (CellIndex at = grid.index(from);;) {
    const CellIndex to = steepest(grid, map, at);
    if (to == at) return path;
    at = to;
    path.push_back(grid.cell(at));
  }
}

NeuralQuery::NeuralQuery(const Grid& grid) : grid_(&grid), wave_(grid) {
  map_.form = NeuralForm::kMax;
  map_.level.assign(grid.size(), map_.inactive());
}

std::vector<Cell> NeuralQuery::path(Cell start, Cell goal, Watch* watch) {
  const bool found = !wave_.search(goal, start, watch).empty();
  if (!found) return {};
  for (const CellIndex at : wave_.touched()) map_.level[at] = -wave_.distance(at);
  std::vector<Cell> path = ascend(*grid_, map_, start);
  for (const CellIndex at : wave_.touched()) map_.level[at] = map_.inactive();
  return path;
}

std::optional<Cell> find_false_peak(const Grid& grid, const NeuralMap& map, Cell goal) {
  const CellIndex end = grid.index(goal);
  for (CellIndex at = 0; at < grid.size(); ++at) {
    if (at != end && map.active(at) && grid.all_moves()[at] != 0 && steepest(grid, map, at) == at) return grid.cell(at);
  }
  return std::nullopt;
}

std::uint64_t mend(const Grid& grid, NeuralMap& map, Cell goal, Cell cell) {
  std::vector<CellIndex> round;
  round.reserve(9);
  for (const Cell step : kDirections) {
    if (grid.free(cell + step)) round.push_back(grid.index(cell + step));
  }
  std::vector<CellIndex> forgotten;
  if (grid.blocked(cell)) {
    map.level[grid.index(cell)] = map.inactive();
    forget_unheld(grid, map, grid.index(goal), round, forgotten);
  } else {
    round.push_back(grid.index(cell));
  }
  round.insert(round.end(), forgotten.begin(), forgotten.end());
  // Each cell is offered its neighbours' distances; then better distances spread on from it.
  std::vector<Offer> offers;
  offers.reserve(round.size());
  for (const CellIndex at : round) offer(grid, map, at, offers);
  return spread(grid, map.level, std::move(offers)) + forgotten.size();
}

Result plan_neural(const Problem& problem, const NeuralParameters& parameters, const RunOptions& run) {
  if (!in_range(parameters)) return rejected(Fault::kBadParameter);
  const Grid& grid = *problem.grid;
  const Cell start = problem.start_cell(), goal = problem.goal_cell();
  Watch watch(run);
  if (parameters.form == NeuralForm::kMax && parameters.stop == StopWhen::kStartActive) {
    NeuralQuery query(grid);
    const std::vector<Cell> path = query.path(start, goal, &watch);
    Result result = path.empty() ? ended_without_path(watch) : reached(grid, path);
    result.statistics.steps = 1;
    result.statistics.cells = query.updates();
    return result;
  }
  const std::array<Cell, 1> starts = {start};
  NeuralMap map = relax(grid, goal, parameters, watch, starts);
  if (parameters.form != NeuralForm::kLiteral) return answer(problem, map);
  if (watch.why() != Stop::kNone) {   // the time was up before either form could finish
    Result result = ended(Outcome::kLimit);
    add_neural_statistics(map, result);
    return result;
  }
  const double bound = largest_row_sum(grid, parameters.self_weight);
  if (map.total > bound) return answer(problem, map);   // at equality a field may be flat
  // The proof does not hold here. F2 answers instead, and the statistics tell what the literal form would have done.
  const auto peak = find_false_peak(grid, map, goal);
  const std::vector<Cell> literal = map.active(grid.index(start)) ? ascend(grid, map, start) : std::vector<Cell>{start};
  NeuralParameters fixed = parameters;
  fixed.form = NeuralForm::kFixedGain;
  Result result = answer(problem, relax(grid, goal, fixed, watch, starts));
  result.statistics.more.emplace_back("switched to fixed gain", 1.0);
  result.statistics.more.emplace_back("literal sum", map.total);
  result.statistics.more.emplace_back("sum needed", bound);
  result.statistics.more.emplace_back("false peak", peak ? 1.0 : 0.0);
  result.statistics.more.emplace_back("literal form trapped", literal.back() == goal ? 0.0 : 1.0);
  if (literal.back() != goal) result.statistics.places.emplace_back("trapped at", grid.centre(literal.back()));
  return result;
}

// ---- the methods
Result run_neural(const Problem& problem, const RunOptions& run) {
  NeuralParameters parameters;
  parameters.stop = StopWhen::kStartActive;
  return plan_neural(problem, parameters, run);
}
Result run_neural_literal(const Problem& problem, const RunOptions& run) {
  NeuralParameters parameters;
  parameters.form = NeuralForm::kLiteral;
  return plan_neural(problem, parameters, run);
}
Result run_neural_fixed(const Problem& problem, const RunOptions& run) {
  NeuralParameters parameters;
  parameters.form = NeuralForm::kFixedGain;
  return plan_neural(problem, parameters, run);
}
Result run_neural_log(const Problem& problem, const RunOptions& run) {
  NeuralParameters parameters;
  parameters.form = NeuralForm::kLogSum;
  parameters.gamma = 0.05;
  return plan_neural(problem, parameters, run);
}

Picture draw_neural(const Problem& problem, const Result&) {
  RunOptions run;
  Watch watch(run);
  const NeuralMap map = relax(*problem.grid, problem.goal_cell(), {}, watch);
  Picture picture;
  picture.field.assign(map.level.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < map.level.size(); ++i) {
    if (map.active(static_cast<CellIndex>(i))) picture.field[i] = -map.level[i];
  }
  return picture;
}

}  // namespace kb::planners
