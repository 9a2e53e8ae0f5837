// What a planner is asked, and what it answers. All planners take a `Problem` and a `RunOptions` and give a `Result`.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "planners/geometry.h"
#include "planners/grid.h"
#include "planners/movers.h"

namespace kb::planners {

/// From where to where. Start and goal are points of free cells; a planner on the grid goes from centre to centre of their
/// cells, whatever the place within.
struct Problem {
  const Grid* grid = nullptr;        ///< not owned; must outlive the planner
  Point start, goal;                 ///< m
  const Movers* movers = nullptr;    ///< obstacles that move, if any; most planners know none (`Method::moving`)
  double goal_tolerance_cells = 0.5; ///< how near to the goal a continuous planner must come

  [[nodiscard]] Cell start_cell() const { return grid->cell_at(start); }
  [[nodiscard]] Cell goal_cell() const { return grid->cell_at(goal); }
};

/// How it ended. There is no plain "failed": which of these it was decides what to do next.
enum class Outcome : std::uint8_t {
  kReached,      ///< the path ends at the goal and has passed the checker (check.h)
  kUnreachable,  ///< proved: there is no way
  kTrapped,      ///< diagnosed: the robot would stay where `Trap` says
  kLimit,        ///< something was used up, `Statistics::stop` says what; the path is the best so far
  kNumeric,      ///< the computation ran out of range, or its path did not pass the checker
  kConflict,     ///< of several robots: no plan for this one that spares the others
  kInvalid,      ///< the question cannot be asked: see `Fault`
};
/// "reached", "unreachable", ...
[[nodiscard]] std::string_view name(Outcome outcome);

/// What is wrong with a problem.
enum class Fault : std::uint8_t {
  kNone,
  kEmptyMap,        ///< the grid has no cells
  kNotFinite,       ///< a coordinate is no number
  kStartOutside, kGoalOutside,
  kStartBlocked, kGoalBlocked,
  kBadParameter,    ///< a parameter of the method, or the tolerance, is out of its range
  kMoversUnknown,   ///< there are moving obstacles, and the method knows none
};
[[nodiscard]] std::string_view name(Fault fault);
/// The first fault of a problem. O(1).
[[nodiscard]] Fault find_fault(const Problem& problem);

/// How a robot is caught (Filimonov and Filimonov, section on traps).
struct Trap {
  enum class Kind : std::uint8_t {
    kNone,
    kRest,     ///< stands still away from the goal
    kChatter,  ///< moves to and fro across a valley, and not along it
    kCycle,    ///< goes round
  };
  Kind kind = Kind::kNone;
  Point at;              ///< m
  double time_s = 0.0;   ///< when it was diagnosed
};
[[nodiscard]] std::string_view name(Trap::Kind kind);

/// What was used up, of `kLimit`.
enum class Stop : std::uint8_t {
  kNone,
  kSteps,        ///< of the robot, by the method's own bound
  kGenerations,  ///< none of them had a walk free of conflicts
  kSweeps,       ///< the field of a neural map had not come to the start
  kIsolines,     ///< of `two-maps`: closed at every clearance, though there is a way
  kRoom,         ///< of `two-maps`: beside an obstacle, at every clearance
  kTime,         ///< `RunOptions::budget`
  kCancelled,    ///< nothing: `RunOptions::cancel`
};
/// "steps", "generations", "sweeps", "isolines", "room", "time", "cancelled"; empty for kNone.
[[nodiscard]] std::string_view name(Stop stop);

struct Statistics {
  std::uint64_t steps = 0;      ///< of the method's own kind: sweeps, generations, moves of the robot
  std::uint64_t cells = 0;      ///< cells settled, updated or visited
  Stop stop = Stop::kNone;      ///< what was used up, if `plan` answers kLimit
  /// What only this method knows, in a fixed order: {"approach share", 0.2}. Names are literals.
  std::vector<std::pair<std::string_view, double>> more;
  std::vector<std::pair<std::string_view, Point>> places;   ///< the same of places, m
};

struct Result {
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;          ///< when kInvalid
  Trap trap;                           ///< when kTrapped
  std::vector<Point> path;             ///< m; a polyline from the start to where it ended
  std::vector<double> times_s;         ///< of each point of the path; empty where the method has no time
  double length_m = 0.0;               ///< of the path
  double repelled_from_m = 0.0;        ///< of fields of forces: what is so near to the goal repels harder than it attracts; 0: nothing does
  std::string_view refused;            ///< when kNumeric: why the checker refused the path, or what ran out of range; empty otherwise
  Statistics statistics;
};

/// A clock and a flag that end a long computation. Copies share the flag.
struct RunOptions {
  std::uint64_t seed = 1;                         ///< the same seed gives the same bytes, whatever `threads` is
  unsigned threads = 1;                           ///< at least 1
  const std::atomic<bool>* cancel = nullptr;      ///< set by another thread to end the computation; not owned
  std::chrono::nanoseconds budget{0};             ///< 0: no limit. What a run with a budget gives depends on the machine
  std::function<void(double share)> progress;     ///< called now and then from the thread that plans; share in [0, 1]
};

/// Asks whether a run is to end. Make one at the beginning of the computation.
class Watch {
 public:
  explicit Watch(const RunOptions& run);
  /// Cheap: looks at the clock every 256th time. Once it has said to stop it keeps saying so.
  [[nodiscard]] bool stopped() {
    if (stop_ == Stop::kNone && (++calls_ & 255u) == 0) look();
    return stop_ != Stop::kNone;
  }
  /// The same, but always looks. For loops whose turns are long.
  [[nodiscard]] bool stopped_now() {
    if (stop_ == Stop::kNone) look();
    return stop_ != Stop::kNone;
  }
  [[nodiscard]] Stop why() const { return stop_; }
  /// What is left of the budget, at least 1 ns, so that it can be the budget of a part of the computation; 0: there is no limit.
  [[nodiscard]] std::chrono::nanoseconds left() const;
  void progress(double share) const {
    if (run_->progress) run_->progress(share);
  }

 private:
  void look();
  const RunOptions* run_;
  std::chrono::steady_clock::time_point end_;
  std::uint32_t calls_ = 0;
  Stop stop_ = Stop::kNone;
};

// ---- paths
/// Length of a polyline, in its unit.
[[nodiscard]] double length(const std::vector<Point>& path);
/// The centres of cells that follow each other.
[[nodiscard]] std::vector<Point> centres(const Grid& grid, const std::vector<Cell>& cells);
/// kReached with a path of cells and its length. Counts straight and diagonal moves, so that equal paths are equally long
/// to the last bit.
[[nodiscard]] Result reached(const Grid& grid, const std::vector<Cell>& cells);
[[nodiscard]] Result ended(Outcome outcome);
[[nodiscard]] Result rejected(Fault fault);

}  // namespace kb::planners
