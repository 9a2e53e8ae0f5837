// What a planner is asked and what it answers: all planners take a `Problem` and a `RunOptions` and return a `Result`.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "planners/geometry.h"
#include "planners/grid.h"
#include "planners/movers.h"

namespace kb::planners {

/// The question: from where to where, on which map. Start and goal are points in free cells. A planner on the grid goes from the centre
/// of the start's cell to the centre of the goal's, wherever in them the points lie.
struct Problem {
  const Grid* grid = nullptr;        ///< not owned; must outlive the planner
  Point start, goal;                 ///< m
  const Movers* movers = nullptr;    ///< moving obstacles, if any; most planners take none (`Method::moving`)
  double goal_tolerance_cells = 0.5; ///< how near to the goal a continuous planner must come

  [[nodiscard]] Cell start_cell() const { return grid->cell_at(start); }
  [[nodiscard]] Cell goal_cell() const { return grid->cell_at(goal); }
};

/// How a computation ended. There is no plain "failed", because what to do next depends on which of these it was.
enum class Outcome : std::uint8_t {
  kReached,      ///< the path ends at the goal and has passed the checker (check.h)
  kUnreachable,  ///< proved: there is no path
  kTrapped,      ///< diagnosed: the robot would stay where `Trap` says
  kLimit,        ///< something was used up, and `Statistics::stop` says what; the path is the best so far
  kNumeric,      ///< the computation ran out of range, or its path did not pass the checker
  kConflict,     ///< in a group of robots: no plan for this one avoids the others
  kInvalid,      ///< the question cannot be asked: see `Fault`
};
/// "reached", "unreachable", ...
[[nodiscard]] std::string_view name(Outcome outcome);

/// What is wrong with a problem.
enum class Fault : std::uint8_t {
  kNone,
  kEmptyMap,        ///< the grid has no cells
  kNotFinite,       ///< a coordinate is not a number
  kStartOutside, kGoalOutside,
  kStartBlocked,
  kGoalBlocked,     ///< also, of a group: two robots have one goal
  kBadParameter,    ///< a parameter of the method, or the tolerance, is out of its range
  kSharedStart,     ///< of a group: two robots start in the same cell
  kMoversUnknown,   ///< there are moving obstacles, and the method takes none
};
[[nodiscard]] std::string_view name(Fault fault);
/// The first fault of a problem. O(1).
[[nodiscard]] Fault find_fault(const Problem& problem);

/// How a robot is trapped (Filimonov and Filimonov, section on traps).
struct Trap {
  enum class Kind : std::uint8_t {
    kNone,
    kRest,     ///< stands still away from the goal
    kChatter,  ///< moves to and fro across a valley, not along it
    kCycle,    ///< goes round and round
  };
  Kind kind = Kind::kNone;
  Point at;              ///< m
  double time_s = 0.0;   ///< when it was diagnosed; 0 if the method has no time
};
[[nodiscard]] std::string_view name(Trap::Kind kind);

/// What was used up when the outcome is `kLimit`.
enum class Stop : std::uint8_t {
  kNone,
  kSteps,        ///< of the robot; the method's own bound
  kGenerations,  ///< none of them had a walk without conflicts
  kSweeps,       ///< the field of a neural map had not reached the start
  kIsolines,     ///< `two-maps`: closed at every clearance, though there is a path
  kRoom,         ///< `two-maps`: none beside an obstacle, at any clearance
  kTime,         ///< `RunOptions::budget`
  kCancelled,    ///< nothing was used up: `RunOptions::cancel` was set
};
/// "steps", "generations", "sweeps", "isolines", "room", "time", "cancelled"; empty for kNone.
[[nodiscard]] std::string_view name(Stop stop);

struct Statistics {
  std::uint64_t steps = 0;      ///< what the method counts: sweeps, generations, moves of the robot
  std::uint64_t cells = 0;      ///< settled, updated or visited
  Stop stop = Stop::kNone;      ///< what was used up, if `plan` answers kLimit
  /// Figures that only this method has, in a fixed order, such as {"approach share", 0.2}. Names are literals.
  std::vector<std::pair<std::string_view, double>> more;
  std::vector<std::pair<std::string_view, Point>> places;   ///< likewise places, m
};

struct Result {
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;          ///< when kInvalid
  Trap trap;                           ///< when kTrapped
  std::vector<Point> path;             ///< m; a polyline from the start to where the method ended
  std::vector<double> times_s;         ///< of each point of the path; empty if the method has no time
  double length_m = 0.0;               ///< of the path
  double repelled_from_m = 0.0;        ///< fields of forces: distance from the goal to an obstacle that outweighs its pull; else 0
  std::string_view refused;            ///< when kNumeric: why the checker refused the path, or what ran out of range; else empty
  Statistics statistics;
};

/// How to run: seed, and a budget and a flag that end a long computation. Copies share the flag.
struct RunOptions {
  std::uint64_t seed = 1;                         ///< the same seed gives the same bytes
  const std::atomic<bool>* cancel = nullptr;      ///< another thread sets it to end the computation; not owned
  std::chrono::nanoseconds budget{0};             ///< 0: no limit. With a budget the answer depends on the machine
  std::function<void(double share)> progress;     ///< called now and then, on the planning thread; share in [0, 1]
};

/// Tells a computation when to end. Make one when the computation begins.
class Watch {
 public:
  explicit Watch(const RunOptions& run);
  /// Cheap: looks at flag and clock once in 256 turns of a loop only. `turns`: made since the last call. Once true, it stays true.
  [[nodiscard]] bool stopped(std::size_t turns = 1) {
    if (stop_ == Stop::kNone && (turns_ += turns) >= 256) {
      turns_ = 0;
      look();
    }
    return stop_ != Stop::kNone;
  }
  /// The same, but looks on every call. For loops with long turns.
  [[nodiscard]] bool stopped_now() {
    if (stop_ == Stop::kNone) look();
    return stop_ != Stop::kNone;
  }
  [[nodiscard]] Stop why() const { return stop_; }
  /// The rest of the budget, for use as the budget of a part of the computation: at least 1 ns; 0 if there is no limit.
  [[nodiscard]] std::chrono::nanoseconds left() const;
  void progress(double share) const {
    if (run_->progress) run_->progress(share);
  }

 private:
  void look();
  const RunOptions* run_;
  std::chrono::steady_clock::time_point end_;
  std::size_t turns_ = 0;
  Stop stop_ = Stop::kNone;
};

/// For computations that may be watched: what `watch` says, and false without one.
[[nodiscard]] inline bool is_stopped(Watch* watch, std::size_t turns = 1) { return watch != nullptr && watch->stopped(turns); }

// ---- paths
/// Length of a polyline, in the unit of its points.
[[nodiscard]] double length(const std::vector<Point>& path);
/// The centres of the cells, in their order.
[[nodiscard]] std::vector<Point> centres(const Grid& grid, const std::vector<Cell>& cells);
/// kReached with a path of cells and its length. The length is computed from the counts of straight and diagonal moves, so that equally
/// long paths have the same length to the last bit.
[[nodiscard]] Result reached(const Grid& grid, const std::vector<Cell>& cells);
[[nodiscard]] Result ended(Outcome outcome);
/// Of a search that found no path: kLimit if the watch stopped it, else kUnreachable.
[[nodiscard]] Result ended_without_path(const Watch& watch);
[[nodiscard]] Result rejected(Fault fault);

}  // namespace kb::planners
