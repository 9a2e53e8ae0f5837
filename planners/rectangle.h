// A rectangular robot: forces at control points, their sum and their moment (Filimonov and Filimonov 2019 name the
// extension in their conclusion; control points and sums are ours).
//
//   F = sum F_i,   M = sum (r_i - r_c) x F_i      over the four corners and the middles of the four sides
//
// Attraction acts at the centre. For a goal with a heading it acts at the middles of the two short sides instead, each drawn to its own
// place in the goal pose with half the gain. Knowledge: local range (the zone of repulsion).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "planners/potential.h"

namespace kb::planners {

struct Rectangle {
  double length_m = 1.0;   ///< along the heading
  double width_m = 0.5;
};
struct Pose {
  Point at;                 ///< the centre, m
  double heading_rad = 0.0;
};
/// The corners counter-clockwise from the front right, then the middles of the front, left, rear and right sides.
[[nodiscard]] std::array<Point, 8> control_points(const Rectangle& shape, const Pose& pose);

struct ForceAndMoment {
  Point force;
  double moment = 0.0;   ///< counter-clockwise positive
};

class RectangleField {
 public:
  /// `cell_m` is the unit of the parameters that are given in cells. The clearance must outlive the field.
  RectangleField(const Clearance& clearance, const Rectangle& shape, Point goal, std::optional<double> goal_heading_rad,
                 double cell_m, const PotentialParameters& parameters);
  [[nodiscard]] ForceAndMoment at(const Pose& pose) const;
  /// Distance of the body to an obstacle, at most `PotentialField::zone_m()`; 0 if they touch. The body is more than the control points,
  /// which do not feel a thing that lies between two of them and is smaller than they are apart.
  [[nodiscard]] double clearance_m(const Pose& pose) const;
  [[nodiscard]] const Rectangle& shape() const { return shape_; }
  [[nodiscard]] const Pose& goal() const { return goal_; }
  [[nodiscard]] bool has_goal_heading() const { return has_heading_; }

 private:
  Rectangle shape_;
  Pose goal_;
  bool has_heading_;
  const Clearance* clearance_;
  PotentialField centre_, front_, rear_;
};

struct RectangleDrive {
  Drive drive = Drive::kKinematic;
  double turn_gain = 10.0;         ///< k_phi, kinematic: heading' = k_phi M, 1 / (m s) for force in m/s
  double top_speed = 1.0;          ///< m/s, of any control point
  double mass = 1.0;               ///< m, dynamic; J = m (a^2 + b^2) / 12
  double friction = 2.0;           ///< c, 1/s times m: a force of -c v
  double turn_friction = 0.5;      ///< c_phi: a moment of -c_phi heading'
  double step_s = 0.02;            ///< shorter near obstacles
  double time_s = 300.0;           ///< after which the drive gives up
  double tolerance_m = 0.05;
  double tolerance_rad = 0.0349;   ///< 2 degrees, if the goal has a heading
};

struct RectangleResult {
  Outcome outcome = Outcome::kInvalid;   ///< kReached, kTrapped, kLimit, kNumeric (touched an obstacle), kInvalid
  Fault fault = Fault::kNone;            ///< kInvalid: a parameter or side is not positive (kBadParameter), or the start is not finite (kNotFinite)
  std::vector<Pose> poses;               ///< one every twentieth of a second
  Trap trap;
  double time_s = 0.0;
};
/// Drives until the goal is reached. kTrapped if within two seconds the robot has moved less than a hundredth of its length and turned less
/// than half a degree.
[[nodiscard]] RectangleResult drive_rectangle(const RectangleField& field, const Pose& start, const RectangleDrive& how,
                                              const RunOptions& run);

}  // namespace kb::planners
