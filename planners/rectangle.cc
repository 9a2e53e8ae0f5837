#include "planners/rectangle.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace kb::planners {
namespace {

constexpr double kRecordEvery = 0.05, kTrapWindow = 2.0;   // s
constexpr std::uint64_t kMostSteps = 5'000'000;   // steps get short near obstacles
constexpr double kTrapTurn = 0.5 * kPi / 180.0;

Point direction_of(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }
Point end_of(const Rectangle& shape, const Pose& pose, double sign) {
  return pose.at + (0.5 * sign * shape.length_m) * direction_of(pose.heading_rad);
}

PotentialParameters halved(PotentialParameters parameters) {
  parameters.gain *= 0.5;
  return parameters;
}

}  // namespace

std::array<Point, 8> control_points(const Rectangle& shape, const Pose& pose) {
  const Point e = (0.5 * shape.length_m) * direction_of(pose.heading_rad);
  const Point n = (0.5 * shape.width_m) * direction_of(pose.heading_rad + kPi / 2.0);
  const auto at = [&](double along, double across) { return pose.at + along * e + across * n; };
  return {at(1, -1), at(1, 1), at(-1, 1), at(-1, -1), at(1, 0), at(0, 1), at(-1, 0), at(0, -1)};
}

RectangleField::RectangleField(const Clearance& clearance, const Rectangle& shape, Point goal,
                               std::optional<double> goal_heading_rad, double cell_m, const PotentialParameters& parameters)
    : shape_(shape), goal_{goal, goal_heading_rad.value_or(0.0)}, has_heading_(goal_heading_rad.has_value()), clearance_(&clearance),
      centre_(clearance, goal, cell_m, parameters),
      front_(clearance, end_of(shape_, goal_, 1.0), cell_m, halved(parameters)),
      rear_(clearance, end_of(shape_, goal_, -1.0), cell_m, halved(parameters)) {}

ForceAndMoment RectangleField::at(const Pose& pose) const {
  ForceAndMoment out;
  const auto act = [&](Point where, Point force) {
    out.force = out.force + force;
    out.moment += cross(where - pose.at, force);
  };
  if (has_heading_) {
    const Point front = end_of(shape_, pose, 1.0), rear = end_of(shape_, pose, -1.0);
    act(front, front_.attracting_force(front));
    act(rear, rear_.attracting_force(rear));
  } else {
    act(pose.at, centre_.attracting_force(pose.at));
  }
  for (const Point p : control_points(shape_, pose)) act(p, centre_.repelling_force(p));
  return out;
}

double RectangleField::clearance_m(const Pose& pose) const {
  const auto points = control_points(shape_, pose);
  return std::min(centre_.zone_m(), clearance_->distance_of(std::span(points).first<4>()));
}

namespace {

class RectangleRun {
 public:
  RectangleRun(const RectangleField& field, const Pose& start, const RectangleDrive& how, const RunOptions& run)
      : field_(field), how_(how), watch_(run), pose_(start), window_pose_(start),
        reach_m_(0.5 * std::hypot(field.shape().length_m, field.shape().width_m)) {}

  RectangleResult go() {
    double next_record = 0.0;
    for (std::uint64_t i = 0; i < kMostSteps && time_ <= how_.time_s && !watch_.stopped(); ++i) {
      if (time_ >= next_record) {
        result_.poses.push_back(pose_);
        next_record += kRecordEvery;
      }
      const double clearance = field_.clearance_m(pose_);
      if (clearance <= 0.0) return end(Outcome::kNumeric);
      if (arrived()) return end(Outcome::kReached);
      if (trapped()) return end(Outcome::kTrapped);
      step(clearance);
    }
    return end(Outcome::kLimit);
  }

 private:
  [[nodiscard]] bool arrived() const {
    const bool turned = !field_.has_goal_heading() ||
                        std::abs(wrap_angle(pose_.heading_rad - field_.goal().heading_rad)) <= how_.tolerance_rad;
    return turned && distance(pose_.at, field_.goal().at) <= how_.tolerance_m;
  }

  // Judges by the net motion over a window of time, so that chatter across a valley counts as rest.
  bool trapped() {
    if (time_ < window_end_) return false;
    const bool still = window_end_ > 0.0 && distance(pose_.at, window_pose_.at) < 0.01 * field_.shape().length_m &&
                       std::abs(wrap_angle(pose_.heading_rad - window_pose_.heading_rad)) < kTrapTurn;
    window_pose_ = pose_;
    window_end_ = time_ + kTrapWindow;
    if (still) result_.trap = {Trap::Kind::kRest, pose_.at, time_};
    return still;
  }

  void step(double clearance) {
    const ForceAndMoment act = field_.at(pose_);
    double dt = how_.step_s;
    if (how_.drive == Drive::kKinematic) {
      velocity_ = act.force;
      turning_ = how_.turn_gain * act.moment;
    }
    // No point of the body is faster than the robot may be, nor goes more than a tenth of its clearance in one step. In a dynamic drive this
    // holds for the speed at the beginning of the step.
    const double speed = norm(velocity_) + std::abs(turning_) * reach_m_;
    const double scale = speed > how_.top_speed ? how_.top_speed / speed : 1.0;
    velocity_ = scale * velocity_;
    turning_ *= scale;
    if (speed > 0.0) dt = std::min(dt, 0.1 * clearance / (scale * speed));
    dt = std::max(dt, 1e-6);
    if (how_.drive == Drive::kDynamic) {
      const Rectangle& shape = field_.shape();
      const double inertia = how_.mass * (shape.length_m * shape.length_m + shape.width_m * shape.width_m) / 12.0;
      velocity_ = velocity_ + (dt / how_.mass) * (act.force - how_.friction * velocity_);
      turning_ += dt / inertia * (act.moment - how_.turn_friction * turning_);
    }
    pose_.at = pose_.at + dt * velocity_;
    pose_.heading_rad = wrap_angle(pose_.heading_rad + dt * turning_);
    time_ += dt;
  }

  RectangleResult end(Outcome outcome) {
    result_.outcome = outcome;
    result_.time_s = time_;
    result_.poses.push_back(pose_);
    return std::move(result_);
  }

  const RectangleField& field_;
  const RectangleDrive& how_;
  Watch watch_;
  Pose pose_, window_pose_;
  double reach_m_, time_ = 0.0, window_end_ = 0.0, turning_ = 0.0;
  Point velocity_;
  RectangleResult result_;
};

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

}  // namespace

RectangleResult drive_rectangle(const RectangleField& field, const Pose& start, const RectangleDrive& how,
                                const RunOptions& run) {
  const bool usable = is_positive(how.turn_gain) && is_positive(how.top_speed) && is_positive(how.mass) &&
                      is_positive(how.step_s) && is_positive(how.tolerance_m) && is_positive(how.time_s) &&
                      how.friction >= 0.0 && how.turn_friction >= 0.0 && is_positive(field.shape().length_m) &&
                      is_positive(field.shape().width_m);
  RectangleResult refused;
  if (!is_finite(start.at) || !std::isfinite(start.heading_rad)) refused.fault = Fault::kNotFinite;
  if (!usable) refused.fault = Fault::kBadParameter;
  if (refused.fault != Fault::kNone) return refused;
  return RectangleRun(field, start, how, run).go();
}

}  // namespace kb::planners
