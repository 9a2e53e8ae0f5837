#include "planners/genetic.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "planners/genetic_walks.h"
#include "planners/methods.h"
#include "planners/room.h"

namespace kb::planners {
namespace {

constexpr std::uint32_t kWalkCap = 60'000;
constexpr double kClearanceCells = 2.0;  // c_0
constexpr std::size_t kRepairs = 6;
constexpr double kCrossoverChance = 0.7;
constexpr std::uint32_t kStraightenings = 6;   // attempts for each child

struct Individual {
  Walk walk;
  double fitness = 0.0, length = 0.0;   // cells
  std::uint32_t conflicts = 0;
  std::size_t first_conflict = 0;       // node; meaningful if there are conflicts
};

// Feasible individuals, and then those with fewer conflicts, come before others whatever their fitness (Deb's rule): by the
// fitness S alone a short walk through a moving obstacle could win.
bool is_fitter(const Individual& a, const Individual& b) {
  if (a.conflicts != b.conflicts) return a.conflicts < b.conflicts;
  return a.fitness > b.fitness;
}

// Computes the fitness and the conflicts of a walk.
class Judge {
 public:
  Judge(const Problem& problem, const GeneticOptions& options, const WalkOperators& operators)
      : problem_(problem), options_(options), operators_(operators) {
    const Grid& grid = *problem.grid;
    const Cell a = problem.start_cell(), b = problem.goal_cell();
    least_length_ = octile_distance(a, b);
    least_steps_ = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    // If the centre of a blocked cell is at distance d, its rim is at d - 1/2.
    clearance_ = distance_to_blocked(grid);
    for (float& c : clearance_) {
      c = static_cast<float>(std::clamp((static_cast<double>(c) - 0.5) / kClearanceCells, 0.0, 1.0));
    }
    for (std::size_t i = 0; i < turn_cost_.size(); ++i) turn_cost_[i] = std::exp(static_cast<double>(i) * kPi / 4.0);
  }

  void judge(Individual& one) const {
    const Walk& walk = one.walk;
    const std::size_t steps = walk.size() - 1;
    std::size_t straight = 0, diagonal = 0;
    double turns = 0.0, clearance = clearance_[walk[0]];
    int before = 8;
    for (std::size_t i = 0; i < steps; ++i) {
      const int k = operators_.direction(walk[i], walk[i + 1]);
      straight += k != 8 && k % 2 == 0 ? 1 : 0;
      diagonal += k != 8 && k % 2 == 1 ? 1 : 0;
      if (i > 0) turns += turn(before, k);
      before = k;
      clearance += clearance_[walk[i + 1]];
    }
    one.length = static_cast<double>(straight) + kSqrt2 * static_cast<double>(diagonal);
    count_conflicts(one);
    const GeneticWeights& w = options_.weights;
    const double n = static_cast<double>(steps);
    const double s1 = one.length > 0.0 ? least_length_ / one.length : 1.0;
    const double s2 = steps > 1 ? (n - 1.0) / turns : 1.0;
    const double s3 = steps > 0 ? least_steps_ / n : 1.0;
    const double s4 = clearance / (n + 1.0);
    const double s5 = 1.0 / (1.0 + one.conflicts);
    one.fitness = w.length * s1 + w.smoothness * s2 + w.time * s3 + w.clearance * s4 + w.conflicts * s5;
  }

 private:
  [[nodiscard]] double turn(int before, int after) const {
    if (options_.course_rad) {
      return after == 8 ? 1.0 : std::exp(std::abs(wrap_angle(after * kPi / 4.0 - *options_.course_rad)));
    }
    if (before == 8 || after == 8) return turn_cost_[0];
    const int difference = std::abs(before - after);
    return turn_cost_[static_cast<std::size_t>(std::min(difference, 8 - difference))];
  }

  void count_conflicts(Individual& one) const {
    one.conflicts = 0;
    const auto note = [&one](std::size_t node) {
      if (one.conflicts++ == 0) one.first_conflict = node;
    };
    const std::size_t steps = one.walk.size() - 1;
    if (problem_.movers != nullptr) {
      Cell here = problem_.grid->cell(one.walk[0]);
      for (std::size_t i = 0; i < one.walk.size(); ++i) {
        if (problem_.movers->taken(here, i)) note(i);
        if (i == steps) break;
        const Cell next = problem_.grid->cell(one.walk[i + 1]);
        if (problem_.movers->swaps(here, next, i)) note(i + 1);
        here = next;
      }
    }
    if (steps < options_.earliest_arrival) note(steps);
    if (options_.horizon != 0 && steps > options_.horizon) note(steps);
  }

  const Problem& problem_;
  const GeneticOptions& options_;
  const WalkOperators& operators_;
  double least_length_ = 0.0, least_steps_ = 0.0;
  std::vector<float> clearance_;
  std::array<double, 5> turn_cost_{};
};

class Evolution {
 public:
  Evolution(const Problem& problem, const RunOptions& run, const GeneticOptions& options)
      : problem_(problem), run_(run), options_(options), watch_(run),
        operators_(*problem.grid, problem.movers != nullptr), judge_(problem, options, operators_),
        from_(problem.grid->index(problem.start_cell())), to_(problem.grid->index(problem.goal_cell())) {}

  GeneticReport go() {
    if (!found()) return finish();
    std::uint32_t idle = 0;
    while (generation_ < options_.max_generations && idle < options_.stagnation && !is_good_enough(best()) &&
           !watch_.stopped_now()) {
      ++generation_;
      const Individual before = best();
      breed();
      idle = is_fitter(best(), before) ? 0 : idle + 1;
      // The paper's main requirement, S_max(i) >= S_max(i - 1): the elite survives, so a fall would be a bug in this code.
      if (is_fitter(before, best())) {
        report_.result.refused = "the best fitness fell";
        break;
      }
      report_.best_fitness.push_back(best().fitness);
      watch_.progress(static_cast<double>(generation_) / options_.max_generations);
    }
    return finish();
  }

 private:
  [[nodiscard]] const Individual& best() const { return population_.front(); }
  // A walk through somebody may be short and smooth enough for any target.
  [[nodiscard]] bool is_good_enough(const Individual& one) const { return one.conflicts == 0 && one.fitness >= options_.target; }
  [[nodiscard]] bool waits() const { return problem_.movers != nullptr; }

  // The first generation. False if it was stopped, or no walk was found within the cap.
  bool found() {
    while (population_.size() < options_.population && !watch_.stopped_now()) {
      Dice dice(run_.seed, 0, population_.size());
      const double greed = 0.1 * static_cast<double>(1 + population_.size() % 5);
      Individual one;
      if (!operators_.walk(from_, to_, greed, std::max(kWalkCap, 4 * static_cast<std::uint32_t>(problem_.grid->free_cells())),
                           dice, one.walk)) {
        break;
      }
      // Again and again: each cut can bring other nodes of the walk next to each other.
      while (operators_.erase_loops(one.walk)) {}
      admit(std::move(one), population_);
    }
    rank();
    if (!population_.empty()) report_.best_fitness.push_back(best().fitness);
    return !population_.empty();
  }

  void admit(Individual one, std::vector<Individual>& into) {
    judge_.judge(one);
    ++made_;
    if (one.conflicts == 0 && (shortest_ < 0.0 || one.length < shortest_ - 1e-9)) {
      shortest_ = one.length;
      report_.shortest = one.walk;
    }
    into.push_back(std::move(one));
  }

  void rank() { std::stable_sort(population_.begin(), population_.end(), is_fitter); }

  void breed() {
    const std::size_t n = population_.size(), elite = (n + 9) / 10;
    next_.clear();
    for (std::size_t child = elite; child < n; ++child) {
      Dice dice(run_.seed, generation_, child);
      admit(make_child(dice), next_);
    }
    for (std::size_t i = elite; i < n; ++i) population_[i] = std::move(next_[i - elite]);
    rank();
  }

  // Binary tournament; the population is ranked, so the smaller place wins.
  [[nodiscard]] const Individual& select(Dice& dice) const {
    const std::uint32_t a = dice.below(population_.size()), b = dice.below(population_.size());
    return population_[std::min(a, b)];
  }

  Individual make_child(Dice& dice) {
    Individual child;
    const Individual& parent = select(dice);
    if (dice.chance(kCrossoverChance)) operators_.cross(parent.walk, select(dice).walk, dice, child.walk);
    else child.walk = parent.walk;
    if (dice.chance(options_.mutation_chance)) operators_.mutate(child.walk, dice);
    for (std::uint32_t i = 0; i < kStraightenings; ++i) operators_.straighten(child.walk, dice);
    // Among moving obstacles, waits and detours that look like loops may be what keeps a walk free of conflicts.
    if (!waits() || dice.below(4) == 0) operators_.erase_loops(child.walk);
    if (waits()) repair(child, dice);
    return child;
  }

  // Tries to remove the first conflict: waits before it, steps aside, or goes round it.
  void repair(Individual& child, Dice& dice) {
    judge_.judge(child);
    Individual trial;
    for (std::size_t tries = 0; tries < kRepairs && child.conflicts != 0; ++tries) {
      trial.walk = child.walk;
      const std::size_t at = child.first_conflict, last = trial.walk.size() - 1;
      const std::size_t i = at - std::min<std::size_t>(at, 1 + dice.below(8));
      switch (dice.below(3)) {
        case 0: trial.walk.insert(trial.walk.begin() + static_cast<std::ptrdiff_t>(i), 1 + dice.below(3), trial.walk[i]); break;
        case 1: operators_.step_aside(trial.walk, i, 1 + dice.below(3), dice); break;
        default: {
          const std::size_t j = std::min(last, at + 2 + dice.below(6));
          if (j < i + 2 || !operators_.reroute(trial.walk, i, j, dice)) continue;
        }
      }
      judge_.judge(trial);
      if (trial.conflicts > child.conflicts) continue;
      if (trial.conflicts == child.conflicts && trial.first_conflict <= child.first_conflict) continue;
      std::swap(child, trial);
    }
  }

  GeneticReport finish() {
    Result& result = report_.result;
    const std::string_view refused = result.refused;
    const bool feasible = !population_.empty() && best().conflicts == 0;
    if (!population_.empty()) {
      std::vector<Cell> cells;
      for (const CellIndex at : best().walk) cells.push_back(problem_.grid->cell(at));
      result = reached(*problem_.grid, cells);
    }
    result.refused = refused;
    const bool stopped = watch_.why() != Stop::kNone;
    result.outcome = !refused.empty() ? Outcome::kNumeric : feasible && !stopped ? Outcome::kReached : Outcome::kLimit;
    result.statistics.steps = generation_;
    result.statistics.cells = made_;
    result.statistics.stop = stopped ? watch_.why() : feasible ? Stop::kNone : Stop::kGenerations;
    result.statistics.more = {{"fitness", population_.empty() ? 0.0 : best().fitness},
                              {"shortest", std::max(shortest_, 0.0) * problem_.grid->cell_m()},
                              {"conflicts", population_.empty() ? 0.0 : best().conflicts}};
    return std::move(report_);
  }

  const Problem& problem_;
  const RunOptions& run_;
  const GeneticOptions& options_;
  Watch watch_;
  WalkOperators operators_;
  Judge judge_;
  CellIndex from_, to_;
  std::vector<Individual> population_, next_;
  std::uint32_t generation_ = 0;
  std::uint64_t made_ = 0;
  double shortest_ = -1.0;
  GeneticReport report_;
};

bool is_usable(const GeneticOptions& options) {
  const GeneticWeights& w = options.weights;
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  const bool weights = is_share(w.length) && is_share(w.smoothness) && is_share(w.time) && is_share(w.clearance) &&
                       is_share(w.conflicts) &&
                       std::abs(w.length + w.smoothness + w.time + w.clearance + w.conflicts - 1.0) < 1e-9;
  const bool course = !options.course_rad || std::isfinite(*options.course_rad);
  return weights && course && options.population >= 2 && is_share(options.mutation_chance);
}

}  // namespace

GeneticReport evolve(const Problem& problem, const RunOptions& run, const GeneticOptions& options) {
  GeneticReport report;
  if (!is_usable(options)) {
    report.result = rejected(Fault::kBadParameter);
    return report;
  }
  const Grid& grid = *problem.grid;
  if (!is_connected(grid, problem.start_cell(), problem.goal_cell())) {
    report.result = ended(Outcome::kUnreachable);
    return report;
  }
  return Evolution(problem, run, options).go();
}

Result run_genetic(const Problem& problem, const RunOptions& run) { return evolve(problem, run).result; }

}  // namespace kb::planners
