// The dynamics of the neural map.
#include "planners/neural.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "planners/shortest.h"

namespace kb::planners {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDiagonal = 1.0 / kSqrt2;
// An activity below this has lost digits, and the proof that there are no false peaks does not hold for it.
constexpr double kSmallest = 1e-290;

bool is_log(NeuralForm form) { return form == NeuralForm::kLogSum || form == NeuralForm::kMax; }

// sum_j w_ij y_j without the neuron itself.
double excitation(const Grid& grid, const std::vector<double>& y, CellIndex at) {
  double straight = 0.0, diagonal = 0.0;
  for (unsigned open = grid.all_moves()[at]; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    (k % 2 == 0 ? straight : diagonal) += y[grid.neighbour(at, k)];
  }
  return straight + kDiagonal * diagonal;
}

// ln sum_j w_ij e^(l_j): the largest term is taken out, so that no term overflows and the sum is at least 1.
double log_excitation(const Grid& grid, const std::vector<double>& l, CellIndex at) {
  static const double kLogDiagonal = std::log(kDiagonal);
  std::array<double, 8> terms{};
  std::size_t count = 0;
  double most = -kInfinity;
  for (unsigned open = grid.all_moves()[at]; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    const double term = l[grid.neighbour(at, k)] + (k % 2 == 0 ? 0.0 : kLogDiagonal);
    terms[count++] = term;
    most = std::max(most, term);
  }
  if (most == -kInfinity) return most;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (terms[i] > most - 40.0) sum += std::exp(terms[i] - most);   // e^-40 is below the last bit
  }
  return most + std::log(sum);
}

// The free cells that the goal can excite, without the goal, in the order of their updates.
// Not all of them, if the watch says stop.
std::vector<CellIndex> update_order(const Grid& grid, Cell goal, UpdateOrder order, Watch& watch) {
  const std::vector<double> distance = distance_field(grid, {goal}, std::nullopt, &watch).distance;
  std::vector<CellIndex> cells;
  for (CellIndex at = 0; at < grid.size(); ++at) {
    if (distance[at] != kUnreached && distance[at] > 0.0) cells.push_back(at);
  }
  if (order != UpdateOrder::kByDistance) return cells;
  // In rings one cell wide, since a sort of all cells at once could not be stopped.
  std::vector<std::vector<CellIndex>> rings;
  for (const CellIndex at : cells) {
    const auto ring = static_cast<std::size_t>(distance[at]);
    if (ring >= rings.size()) rings.resize(ring + 1);
    rings[ring].push_back(at);
  }
  cells.clear();
  for (auto& ring : rings) {
    if (watch.stopped(ring.size())) break;
    std::sort(ring.begin(), ring.end(), [&](CellIndex a, CellIndex b) {
      return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
    });
    cells.insert(cells.end(), ring.begin(), ring.end());
  }
  return cells;
}

class Relaxation {
 public:
  Relaxation(const Grid& grid, Cell goal, const NeuralParameters& parameters, Watch& watch)
      : grid_(grid), parameters_(parameters), watch_(watch), goal_(grid.index(goal)),
        cells_(update_order(grid, goal, parameters.form == NeuralForm::kLiteral ? UpdateOrder::kJacobi : parameters.order, watch)) {
    const double w0 = 4.0 + 4.0 * kDiagonal + parameters.self_weight;
    gain_ = parameters.gamma / w0;
    log_gain_ = std::log(gain_) - std::log(1.0 - gain_ * parameters.self_weight);
    map_.form = parameters.form;
    map_.level.assign(grid.size(), map_.inactive());
    map_.level[goal_] = is_log(parameters.form) ? 0.0 : 1.0;
  }

  void start_from(const NeuralMap& old) {
    if (old.form == map_.form && old.level.size() == map_.level.size()) map_.level = old.level;
  }

  NeuralMap run(std::span<const Cell> starts) {
    const std::uint32_t limit = parameters_.max_sweeps > 0
                                    ? parameters_.max_sweeps
                                    : 6u * static_cast<std::uint32_t>(grid_.width() + grid_.height());
    while (map_.sweeps < limit) {
      if (watch_.stopped_now()) {
        map_.stop = watch_.why();
        return std::move(map_);
      }
      sweep();
      watch_.progress(static_cast<double>(map_.sweeps) / limit);
      map_.converged = map_.residual <= parameters_.tolerance;
      if (map_.converged || (parameters_.stop == StopWhen::kStartActive && all_active(starts))) return std::move(map_);
    }
    map_.stop = Stop::kSweeps;
    return std::move(map_);
  }

 private:
  bool all_active(std::span<const Cell> starts) const {
    return !starts.empty() &&
           std::all_of(starts.begin(), starts.end(), [&](Cell cell) { return map_.active(grid_.index(cell)); });
  }

  double update(const std::vector<double>& y, CellIndex at, double scale) const {
    if (map_.form == NeuralForm::kLogSum) return log_gain_ + log_excitation(grid_, y, at);
    const double x = scale * (excitation(grid_, y, at) + parameters_.self_weight * y[at]);
    const bool tanh = parameters_.squash == Squash::kTanh && map_.form == NeuralForm::kFixedGain;
    const double value = tanh ? std::tanh(x) : std::min(x, 1.0);
    return value < kSmallest ? 0.0 : value;
  }

  void note_change(double before, double after) {
    double change = 0.0;
    if (before != after) {
      change = is_log(map_.form) ? std::abs(after - before) : std::abs(after - before) / std::max(after, before);
    }
    map_.residual = std::max(map_.residual, change);   // a cell that becomes active changes by infinity, or by 1
  }

  void sweep() {
    map_.residual = 0.0;
    double scale = gain_;
    if (map_.form == NeuralForm::kLiteral) scale = 1.0 / total();
    if (map_.form == NeuralForm::kLiteral || parameters_.order == UpdateOrder::kJacobi) {
      next_ = map_.level;
      for (const CellIndex at : cells_) {
        next_[at] = update(map_.level, at, scale);
        note_change(map_.level[at], next_[at]);
      }
      map_.level.swap(next_);
    } else if (parameters_.order == UpdateOrder::kByDistance) {
      const bool back = map_.sweeps % 2 == 1;
      for (std::size_t i = 0; i < cells_.size(); ++i) settle(cells_[back ? cells_.size() - 1 - i : i], scale);
    } else {
      sweep_from_corner(map_.sweeps % 4, scale);
    }
    ++map_.sweeps;
    map_.updates += cells_.size();
    if (map_.form == NeuralForm::kLiteral) map_.total = total();
  }

  void settle(CellIndex at, double scale) {
    const double before = map_.level[at];
    map_.level[at] = update(map_.level, at, scale);
    note_change(before, map_.level[at]);
  }

  void sweep_from_corner(std::uint32_t corner, double scale) {
    for (std::int32_t row = 0; row < grid_.height(); ++row) {
      for (std::int32_t column = 0; column < grid_.width(); ++column) {
        const Cell cell{(corner & 1u) != 0 ? grid_.width() - 1 - column : column,
                        (corner & 2u) != 0 ? grid_.height() - 1 - row : row};
        const CellIndex at = grid_.index(cell);
        if (grid_.all_moves()[at] != 0 && at != goal_) settle(at, scale);
      }
    }
  }

  double total() const {
    double sum = 0.0;
    for (const double y : map_.level) sum += y;
    return sum;
  }

  const Grid& grid_;
  NeuralParameters parameters_;
  Watch& watch_;
  CellIndex goal_;
  std::vector<CellIndex> cells_;
  double gain_ = 0.0, log_gain_ = 0.0;
  NeuralMap map_;
  std::vector<double> next_;
};

}  // namespace

bool in_range(const NeuralParameters& parameters) {
  return parameters.gamma > 0.0 && parameters.gamma < 1.0 && parameters.tolerance > 0.0 &&
         (parameters.self_weight == 0.0 || parameters.self_weight == 1.0);
}

NeuralMap relax(const Grid& grid, Cell goal, const NeuralParameters& parameters, Watch& watch, std::span<const Cell> starts,
                const NeuralMap* old) {
  if (parameters.form == NeuralForm::kMax) {
    const bool one = parameters.stop == StopWhen::kStartActive && starts.size() == 1;
    NeuralMap map;
    map.form = NeuralForm::kMax;
    map.sweeps = 1;
    map.updates = level_field(grid, goal, map.level, one ? std::optional(starts[0]) : std::nullopt, &watch);
    map.stop = watch.why();
    map.converged = map.stop == Stop::kNone;
    if (!map.converged) map.level.assign(grid.size(), map.inactive());   // a distance that is not settled may be too large
    return map;
  }
  Relaxation relaxation(grid, goal, parameters, watch);
  if (old != nullptr) relaxation.start_from(*old);
  return relaxation.run(starts);
}

double largest_row_sum(const Grid& grid, double self_weight) {
  double most = 0.0;
  for (CellIndex at = 0; at < grid.size(); ++at) {
    const unsigned moves = grid.all_moves()[at];
    if (grid.all_blocked()[at] != 0) continue;
    most = std::max(most, std::popcount(moves & 0x55u) + kDiagonal * std::popcount(moves & 0xAAu) + self_weight);
  }
  return most;
}

}  // namespace kb::planners
