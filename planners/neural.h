// The neural map: each cell has a neuron, which its neighbours excite. The goal is held at 1 and blocked cells at 0. In equilibrium the
// activity falls off from the goal, and a robot finds the goal by going uphill (Darintsev and Migranov 2012; Glasius, Komoda and Gielen,
// Neural Networks 8(1), 1995).
//
// Links follow legal moves only, so the ascent cuts no corner. A link of length rho has the weight f(rho) = 1/rho: 1 if straight,
// 1/sqrt(2) if diagonal. The link of a neuron to itself has the weight `self_weight`, which is 1 in the paper although its f(0) is 0.
// W0 = 4 + 4/sqrt(2) + self_weight is the sum of the weights in open space.
//
// note [an ascent that cannot be trapped]
// Let the dynamics be y_i <- g((gamma/W0) sum_j w_ij y_j) with 0 <= g(x) <= x and gamma < 1, and let F(y) be the right side. In equilibrium
// a free cell other than the goal has y_i <= gamma * max_j y_j, so if y_i > 0 some neighbour is strictly higher. The goal is the only
// maximum, the ascent never returns to a cell, and it ends at the goal in fewer steps than there are cells. The same holds for every state
// with y_i <= F(y)_i. Zero is such a state; Jacobi and Gauss-Seidel steps keep the property, and so does freeing a cell. So a computation
// may stop as soon as the start is active, and may go on from an old field when an obstacle is gone.
// The argument does not cover form F1, whose gain 1/S depends on the whole map: see `find_false_peak`.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planners/problem.h"
#include "planners/shortest.h"

namespace kb::planners {

enum class NeuralForm : std::uint8_t {
  kLiteral,    ///< F1: y <- W y / sum(y), as the paper has it; can have false peaks
  kFixedGain,  ///< F2: y_i <- g((gamma/W0) sum_j w_ij y_j)
  kLogSum,     ///< F3: the same equilibrium in logarithms; does not underflow
  kMax,        ///< F4: y_i = max_j gamma* w_ij y_j, gamma* = 2^(-1/(2(sqrt(2)-1))): then y = gamma*^d, d the octile distance
};

enum class UpdateOrder : std::uint8_t {
  kJacobi,      ///< all neurons at once
  kSweeps,      ///< Gauss-Seidel, row by row from alternating corners
  kByDistance,  ///< Gauss-Seidel, outwards from the goal
};
enum class Squash : std::uint8_t { kLinear, kTanh };
enum class StopWhen : std::uint8_t {
  kConverged,
  kStartActive,  ///< as soon as all starts are active: F2 and F3 give valid but longer paths; F4 stays exact
};

struct NeuralParameters {
  NeuralForm form = NeuralForm::kMax;
  double gamma = 0.5;              ///< in (0, 1); F2, F3. Small: shortest paths; near 1: paths away from walls
  double self_weight = 1.0;        ///< 0 or 1; F1 to F3
  Squash squash = Squash::kLinear; ///< F2
  UpdateOrder order = UpdateOrder::kByDistance;   ///< F2, F3. F1 is always Jacobi
  StopWhen stop = StopWhen::kConverged;
  double tolerance = 1e-6;         ///< largest relative change of an activity in the last sweep
  std::uint32_t max_sweeps = 0;    ///< 0: 6 (W + H)
};
/// Whether all parameters are in their ranges.
[[nodiscard]] bool in_range(const NeuralParameters& parameters);

struct NeuralMap {
  NeuralForm form = NeuralForm::kMax;   ///< the form to which the levels belong
  /// By index: y (F1, F2), ln y (F3), or -d (F4); `inactive()` for blocked and inactive cells.
  std::vector<double> level;
  std::uint32_t sweeps = 0;
  std::uint64_t updates = 0;            ///< of single neurons
  double residual = 0.0;                ///< relative change in the last sweep
  bool converged = false;
  Stop stop = Stop::kNone;
  double total = 0.0;                   ///< F1: S* = sum of all activities

  [[nodiscard]] double inactive() const {
    return form == NeuralForm::kLogSum || form == NeuralForm::kMax ? -std::numeric_limits<double>::infinity() : 0.0;
  }
  [[nodiscard]] bool active(CellIndex at) const { return level[at] > inactive(); }
};

/// The field of a goal. `starts` are needed for `kStartActive` only. `old` is a field of the same goal and form to go on from; its grid may
/// differ only in cells that were blocked then (see note [an ascent that cannot be trapped]). O(cells * sweeps).
[[nodiscard]] NeuralMap relax(const Grid& grid, Cell goal, const NeuralParameters& parameters, Watch& watch,
                              std::span<const Cell> starts = {}, const NeuralMap* old = nullptr);

/// Goes uphill from a cell by (y_j - y_i) / rho_ij, ties to the lowest direction, until no neighbour is higher.
[[nodiscard]] std::vector<Cell> ascend(const Grid& grid, const NeuralMap& map, Cell from);

/// Form F4 for one start and one goal, stopped when the start is settled. Neurons are updated in the order of d plus the octile distance to
/// the start, which leads the wave towards it. A neuron that was not settled may have too large a d, never too small a one, so a link of
/// slope 1 is still optimal and the ascent is exact. Keep one for many questions.
class NeuralQuery {
 public:
  explicit NeuralQuery(const Grid& grid);
  /// The cells from start to goal; empty if there is no path, or the watch said stop.
  [[nodiscard]] std::vector<Cell> path(Cell start, Cell goal, Watch* watch = nullptr);
  [[nodiscard]] std::uint64_t updates() const { return wave_.expanded(); }

 private:
  const Grid* grid_;
  Astar wave_;
  NeuralMap map_;
};

/// An active free cell other than the goal that has no higher neighbour. F1 has such peaks when the goal lies in a corridor and there is a
/// room elsewhere, which outshines the corridor. O(cells).
[[nodiscard]] std::optional<Cell> find_false_peak(const Grid& grid, const NeuralMap& map, Cell goal);

/// The largest sum of weights into one free cell. F1 has no false peaks if its S* exceeds this.
[[nodiscard]] double largest_row_sum(const Grid& grid, double self_weight);

/// Updates an F4 field after `cell` was freed or blocked; `grid` must already have the change. Recomputes only what changes, and returns
/// how many cells changed.
std::uint64_t mend(const Grid& grid, NeuralMap& map, Cell goal, Cell cell);

/// The planner: relaxes the field and ascends from the start. A literal map that may have false peaks is replaced by F2.
[[nodiscard]] Result plan_neural(const Problem& problem, const NeuralParameters& parameters, const RunOptions& run);

}  // namespace kb::planners
