// Driving by a field, and the methods.
#include <algorithm>
#include <cmath>
#include <utility>

#include "planners/check.h"
#include "planners/methods.h"
#include "planners/potential.h"
#include "planners/trap.h"
#include "planners/well.h"

namespace kb::planners {
namespace {

// A point robot under a field, step by step.
class Mover {
 public:
  Mover(const PotentialField& field, double cell_m, const DriveParameters& how)
      : field_(field), how_(how), step_m_(how.step_cells * cell_m), dt_s_(how.step_s) {
    if (how.drive != Drive::kDynamic) return;
    // k is the stiffness of the attraction; a conic one has none of its own and takes that of the combined one.
    const PotentialParameters& p = field.parameters();
    const double k = std::max(p.attraction == Attraction::kConic ? p.gain / p.near_m : p.gain, 1e-9);
    dt_s_ = std::min(dt_s_, 0.1 / std::sqrt(k / how.mass));
    damping_ = how.damping * 2.0 * std::sqrt(k * how.mass);
  }

  // The place after one step from `at`; `dt` is how long it takes.
  Point step(Point at, double& dt) {
    const Point force = field_.force(at);
    dt = dt_s_;
    if (how_.drive == Drive::kDynamic) {
      // Semi-implicit Euler: speed first, then place with the new speed.
      const Point pull = (1.0 / how_.mass) * force;
      const double fastest = norm(velocity_) + dt * norm(pull);
      if (fastest * dt > step_m_) dt = step_m_ / fastest;
      velocity_ = (1.0 / (1.0 + dt * damping_ / how_.mass)) * (velocity_ + dt * pull);
    } else {
      const double size = norm(force);
      velocity_ = size > how_.top_speed ? (how_.top_speed / size) * force : force;
      if (norm(velocity_) * dt > step_m_) dt = step_m_ / norm(velocity_);
    }
    return at + dt * velocity_;
  }
  [[nodiscard]] double speed() const { return norm(velocity_); }
  // The speed in m/s at which the goal alone would draw the robot; of a mass, in the end, if its friction were 1 kg/s.
  [[nodiscard]] double pull(Point at) const { return std::min(norm(field_.attracting_force(at)), how_.top_speed); }
  void stop() { velocity_ = {}; }

 private:
  const PotentialField& field_;
  DriveParameters how_;
  double step_m_, dt_s_, damping_ = 0.0;
  Point velocity_;
};

// Under a strong force a step is long where only a short one is safe: it is halved until it touches nothing.
Point shorten_step(const Grid& grid, Point at, Point next) {
  for (int halvings = 0; halvings < 30 && is_finite(next) && check_path(grid, {at, next}, Touch::kApart); ++halvings) {
    next = at + 0.5 * (next - at);
  }
  return next;
}

// Finds out that a robot is caught, by its motion and by the field round it.
class Diagnosis {
 public:
  // `mass`: kg of a robot that slides; 0 for one that stops where it is not driven.
  Diagnosis(const PotentialField& field, double cell_m, double tolerance_m, double mass)
      : field_(field), motion_(cell_m), well_(field, cell_m, tolerance_m), cell_m_(cell_m), mass_(mass) {}
  bool add(Point at, double speed, double pull, double time_s) {
    const bool caught = motion_.add(at, speed, pull, time_s);
    if (well_.add(at, speed, mass_, time_s)) {
      trap_ = {Trap::Kind::kRest, at, time_s};
    } else if (caught && (runs_in_a_well() || stays_long(at, pull, time_s))) {
      trap_ = motion_.trap();
    }
    return trap_.kind != Trap::Kind::kNone;
  }
  [[nodiscard]] const Trap& trap() const { return trap_; }

 private:
  // A robot that runs to and fro, or round, would follow the field from the middle of its places, if its steps were short enough.
  [[nodiscard]] bool runs_in_a_well() const {
    if (motion_.trap().kind == Trap::Kind::kRest) return false;
    const Point middle = motion_.middle();
    return field_.nearest(middle).distance_m > 0.0 && well_.is_closed(middle, field_.potential(middle));
  }
  // A robot slows down at a saddle as in a well, but creeps over the saddle, for longer where the pull is weak; and between two walls it
  // runs to and fro while a weak pull leads it along them. Only one that stays is caught.
  bool stays_long(Point at, double pull, double time_s) {
    if (stays_since_s_ < 0.0 || distance(at, stays_at_) > kStays_cells * cell_m_) {
      stays_since_s_ = time_s;
      stays_at_ = at;
    }
    const bool rests = motion_.trap().kind == Trap::Kind::kRest;
    return (time_s - stays_since_s_) * pull >= (rests ? kRestPatience_s : kRunPatience_s) * cell_m_;
  }

  static constexpr double kStays_cells = 0.5, kRestPatience_s = 120.0, kRunPatience_s = 30.0;   // see note [a cell is the unit of a drive]
  const PotentialField& field_;
  TrapDetector motion_;
  WellProbe well_;
  double cell_m_, mass_;
  Point stays_at_;
  double stays_since_s_ = -1.0;
  Trap trap_;
};

// One drive, from the start to whatever ends it.
class PotentialDrive {
 public:
  PotentialDrive(const PotentialField& field, const Problem& problem, const DriveParameters& how, const RunOptions& run)
      : field_(field), problem_(problem), how_(how), watch_(run), cell_m_(problem.grid->cell_m()),
        tolerance_m_(problem.goal_tolerance_cells * cell_m_), mover_(field, cell_m_, how),
        diagnosis_(field, cell_m_, tolerance_m_, slides() ? how.mass : 0.0), at_(problem.start) {}

  Result go() {
    record();
    std::optional<Outcome> outcome;
    while (!outcome) outcome = advance();
    result_.outcome = *outcome;
    if (is_goal_repelled(field_, tolerance_m_)) result_.repelled_from_m = field_.nearest(problem_.goal).distance_m;
    result_.length_m = length(result_.path);
    result_.statistics.more.emplace_back("time s", time_s_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool slides() const { return how_.drive == Drive::kDynamic; }
  [[nodiscard]] bool is_near() const { return distance(at_, problem_.goal) < tolerance_m_; }
  // A mass with friction is at the goal when it is slow there; one without never rests.
  [[nodiscard]] bool arrived() const { return is_near() && (!slides() || how_.damping <= 0.0 || mover_.speed() < 0.1); }

  void record() {
    result_.path.push_back(at_);
    result_.times_s.push_back(time_s_);
  }

  // One step. How the drive ends, if it does.
  std::optional<Outcome> advance() {
    // Only a mass can be too fast to have arrived, and it is not caught there.
    const bool near = is_near();
    if (arrived()) return Outcome::kReached;
    if (result_.statistics.steps++ >= how_.max_steps) return limit(Stop::kSteps);
    if (watch_.stopped()) return limit(watch_.why());
    double dt = 0.0;
    Point next = mover_.step(at_, dt);
    if (!slides()) {
      const Point shorter = shorten_step(*problem_.grid, at_, next);
      if (shorter != next) dt *= distance(at_, shorter) / distance(at_, next);
      next = shorter;
    }
    if (!is_finite(next) || field_.nearest(next).distance_m <= 0.0 || check_path(*problem_.grid, {at_, next}, Touch::kApart)) {
      return collide(is_finite(next), dt);
    }
    time_s_ += dt;
    at_ = next;
    record();
    return near ? std::nullopt : diagnose(mover_.speed());
  }

  // A mass loses its speed, and the field pushes it off.
  std::optional<Outcome> collide(bool finite, double dt) {
    if (!slides() || !finite) {
      result_.refused = "a step led into an obstacle";
      return Outcome::kNumeric;
    }
    mover_.stop();
    time_s_ += dt;
    return diagnose(0.0);
  }

  std::optional<Outcome> diagnose(double speed) {
    if (!how_.diagnose || !diagnosis_.add(at_, speed, mover_.pull(at_), time_s_)) return std::nullopt;
    result_.trap = diagnosis_.trap();
    return Outcome::kTrapped;
  }

  Outcome limit(Stop stop) {
    result_.statistics.stop = stop;
    return Outcome::kLimit;
  }

  const PotentialField& field_;
  const Problem& problem_;
  const DriveParameters& how_;
  Watch watch_;
  double cell_m_, tolerance_m_;
  Mover mover_;
  Diagnosis diagnosis_;
  Point at_;
  double time_s_ = 0.0;
  Result result_;
};

// Everything that a method with a field owns.
struct World {
  GridClearance clearance;
  PotentialField field;
  World(const Problem& problem, const PotentialParameters& parameters)
      : clearance(*problem.grid, parameters.zone_cells * problem.grid->cell_m()),
        field(clearance, problem.goal, problem.grid->cell_m(), parameters) {}
};

Result run_potential_as(const Problem& problem, const RunOptions& run, Attraction attraction, Drive drive) {
  const World world(problem, parameters_for(problem, attraction));
  return drive_by_potential(world.field, problem, drive_for(problem, drive), run);
}

Picture draw_field(const Problem& problem, const PotentialParameters& parameters, const Result& result) {
  const Grid& grid = *problem.grid;
  const World world(problem, parameters);
  Picture picture;
  picture.field.assign(grid.size(), std::numeric_limits<double>::quiet_NaN());
  for (CellIndex at = 0; at < grid.size(); ++at) {
    if (grid.all_blocked()[at] == 0) picture.field[at] = world.field.potential(grid.centre(grid.cell(at)));
  }
  // Lines of force from a lattice of some 400 cells; where they end without the goal is a trap.
  const int every = std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(grid.free_cells()) / 400.0))));
  for (std::int32_t y = every / 2; y < grid.height(); y += every) {
    for (std::int32_t x = every / 2; x < grid.width(); x += every) {
      if (grid.blocked({x, y})) continue;
      picture.lines.push_back(force_line(world.field, grid.centre({x, y}), grid.cell_m(),
                                         problem.goal_tolerance_cells * grid.cell_m(), 4000));
      const Point end = picture.lines.back().back();
      const bool caught = distance(end, problem.goal) > 2.0 * grid.cell_m();
      const bool known = std::any_of(picture.traps.begin(), picture.traps.end(),
                                     [&](const Trap& trap) { return distance(trap.at, end) < grid.cell_m(); });
      if (caught && !known) picture.traps.push_back({Trap::Kind::kRest, end, 0.0});
    }
  }
  picture.remarks.push_back("shade: potential; thin: lines of force; crosses: where they end without the goal");
  if (result.outcome == Outcome::kTrapped) picture.remarks.push_back("trapped: " + std::string(name(result.trap.kind)));
  return picture;
}

}  // namespace

std::optional<Result> refuse_start_on_rim(const Problem& problem) {
  if (!check_path(*problem.grid, {problem.start}, Touch::kApart)) return std::nullopt;
  Result result = ended(Outcome::kNumeric);
  result.path.push_back(problem.start);
  result.refused = "the start touches an obstacle";
  return result;
}

Result drive_by_potential(const PotentialField& field, const Problem& problem, const DriveParameters& how,
                          const RunOptions& run) {
  if (auto refused = refuse_start_on_rim(problem)) return *std::move(refused);
  return PotentialDrive(field, problem, how, run).go();
}

// ---- the methods
Result run_potential(const Problem& problem, const RunOptions& run) {
  return run_potential_as(problem, run, Attraction::kConic, Drive::kKinematic);
}
Result run_potential_parabolic(const Problem& problem, const RunOptions& run) {
  return run_potential_as(problem, run, Attraction::kParabolic, Drive::kKinematic);
}
Result run_potential_combined(const Problem& problem, const RunOptions& run) {
  return run_potential_as(problem, run, Attraction::kCombined, Drive::kKinematic);
}
Result run_potential_dynamic(const Problem& problem, const RunOptions& run) {
  return run_potential_as(problem, run, Attraction::kConic, Drive::kDynamic);
}
Picture draw_potential(const Problem& problem, const Result& result) {
  return draw_field(problem, parameters_for(problem, Attraction::kConic), result);
}
Picture draw_potential_parabolic(const Problem& problem, const Result& result) {
  return draw_field(problem, parameters_for(problem, Attraction::kParabolic), result);
}

}  // namespace kb::planners
