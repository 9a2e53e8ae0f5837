// Potential fields: the goal attracts, obstacles repel, and the robot goes where the sum pushes it (Khatib 1986; Filimonov and Filimonov
// 2019, whose equation numbers are used below).
//
//   U(q) = U_att(q) + U_rep(q)                                                                  (1)
//   F(q) = -grad U(q)                                                                           (2)
//   U_rep = 1/2 k_r (1/p - 1/p0)^2 for p <= p0, else 0; p = distance to the nearest obstacle
//
// with d = ||q - goal||, q in metres.
#pragma once

#include <optional>

#include "planners/clearance.h"
#include "planners/problem.h"

namespace kb::planners {

enum class Attraction : std::uint8_t {
  kParabolic,        ///< (4): 1/2 k d^2; force k d: strong far away, slow at the end
  kConic,            ///< (5): k d; force k everywhere. (Printed with a factor 1/2, which would have to be in the force too.)
  kCombined,         ///< parabolic up to d0, conic beyond; the force does not jump
  kCombinedLiteral,  ///< (6) as printed: U jumps at d0 unless d0 = 1, and the force unless d0 = 1/2
};

struct PotentialParameters {
  Attraction attraction = Attraction::kConic;
  double gain = 1.0;              ///< k: 1/s^2 or 1/s parabolic, m/s conic
  double near_m = 1.0;            ///< d0 of the combined forms
  double zone_cells = 3.0;        ///< p0, width of the zone of repulsion
  double balance_cells = 0.5;     ///< sets k_r so that a force of 1 m/s is balanced this far from a wall
  bool goal_scaled = false;       ///< multiplies the repulsion by d^2 (Ge and Cui 2000), so that a goal near an obstacle stays a minimum
  double least_cells = 0.05;      ///< p is not taken smaller than this
};
/// k_r with which a force of 1 m/s is balanced at `balance` from an obstacle, if the zone has the width `zone`.
template <class Real>
[[nodiscard]] constexpr Real repelling_gain(Real balance, Real zone) {
  return balance * balance / (Real{1} / balance - Real{1} / zone);
}
/// U_rep within the zone, at a distance that is more than 0.
template <class Real>
[[nodiscard]] constexpr Real repelling_potential(Real gain, Real distance, Real zone) {
  const Real x = Real{1} / distance - Real{1} / zone;
  return Real(0.5) * gain * x * x;
}
/// Whether all parameters are in their ranges.
[[nodiscard]] bool in_range(const PotentialParameters& parameters);
/// What the methods use: the defaults above, except that a parabolic field has k = (1 m/s) / D, where D is the distance from start to goal.
/// The robot then sets out as fast as in the conic field; with k = 1 a robot 30 m away would be pressed against obstacles with 30 times the
/// force that k_r is made for. The combined field is parabolic within a cell of the goal, and pulls with 1 m/s beyond.
/// See note [a cell is the unit of a drive].
[[nodiscard]] PotentialParameters parameters_for(const Problem& problem, Attraction attraction);

class PotentialField {
 public:
  /// `cell_m` is the unit of the parameters that are given in cells. The clearance must outlive the field.
  PotentialField(const Clearance& clearance, Point goal, double cell_m, const PotentialParameters& parameters);

  [[nodiscard]] double attraction(Point q) const;
  [[nodiscard]] double repulsion(Point q) const;
  [[nodiscard]] double potential(Point q) const { return attraction(q) + repulsion(q); }
  [[nodiscard]] Point attracting_force(Point q) const;
  /// -grad U_rep. It is discontinuous where two obstacles are equally near.
  [[nodiscard]] Point repelling_force(Point q) const;
  /// F(q), the input of a robot under force control.
  [[nodiscard]] Point force(Point q) const { return attracting_force(q) + repelling_force(q); }
  [[nodiscard]] Nearest nearest(Point q) const { return clearance_->nearest(q); }

  [[nodiscard]] Point goal() const { return goal_; }
  [[nodiscard]] double zone_m() const { return p0_; }
  /// U_rep at a distance from one obstacle, and its second derivative there.
  [[nodiscard]] double repulsion_at(double distance_m) const;
  [[nodiscard]] double repelling_stiffness(double distance_m) const;
  [[nodiscard]] const PotentialParameters& parameters() const { return parameters_; }

 private:
  [[nodiscard]] double repelling_modulus(double distance_m) const;
  const Clearance* clearance_;
  Point goal_;
  PotentialParameters parameters_;
  double p0_, least_, k_r_;
};

/// Whether the goal is not the lowest place round it (Ge and Cui 2000: goals not reachable with obstacles near by): the repulsion at the
/// goal is stronger than the attraction at the tolerance, so the robot comes to rest before it gets there.
[[nodiscard]] bool is_goal_repelled(const PotentialField& field, double tolerance_m);

/// How force becomes motion.
enum class Drive : std::uint8_t {
  kKinematic,  ///< (3): q' = F, at most `top_speed`
  kDynamic,    ///< q'' = F/m - (c/m) q': a sliding mass; without friction (the paper's form) it never rests at the goal
};

struct DriveParameters {
  Drive drive = Drive::kKinematic;
  double top_speed = std::numeric_limits<double>::infinity();   ///< m/s, kinematic
  double mass = 1.0;                ///< kg
  double damping = 1.0;             ///< c as a share of the critical 2 sqrt(k m); the paper has 0
  double step_cells = 0.25;         ///< the longest step
  double step_s = 0.1;              ///< the longest time of a step; dynamic: also at most 0.1 / sqrt(stiffness)
  bool diagnose = true;             ///< end when trapped (trap.h)
  std::uint64_t max_steps = 200000;
};

// note [a cell is the unit of a drive]: the methods drive over cells of 5 cm as over cells of a metre, at the same speeds, so times scale
// with the cells. Forces are right at any scale, since the zone and the balance are in cells. Durations (time steps, the patience of the
// diagnosis) are given in seconds for cells of a metre and multiplied by the side of a cell in metres. So is the mass, which therefore gets
// up to speed within the same number of cells.

/// What the methods use: the defaults above, scaled to the problem's cells.
[[nodiscard]] DriveParameters drive_for(const Problem& problem, Drive drive);

/// `kNumeric` if the start is on the rim of a blocked cell or of the map: a path that begins there touches something.
[[nodiscard]] std::optional<Result> refuse_start_on_rim(const Problem& problem);

/// Drives a point by the field until it is at the goal, is trapped, gets into an obstacle (`kNumeric`), or has no steps left.
[[nodiscard]] Result drive_by_potential(const PotentialField& field, const Problem& problem, const DriveParameters& how,
                                        const RunOptions& run);

/// A line of force from `from`: dr/ds = F/||F||, by Runge-Kutta in steps of a quarter cell, until it reaches the goal, comes to rest, or
/// has no steps left.
[[nodiscard]] std::vector<Point> force_line(const PotentialField& field, Point from, double cell_m, double tolerance_m,
                                            std::size_t max_steps);

}  // namespace kb::planners
