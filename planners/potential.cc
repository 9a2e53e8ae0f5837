#include "planners/potential.h"

#include <algorithm>
#include <cmath>

namespace kb::planners {

bool in_range(const PotentialParameters& p) {
  return p.gain > 0.0 && p.near_m > 0.0 && p.zone_cells > 0.0 && p.balance_cells > 0.0 && p.balance_cells < p.zone_cells &&
         p.least_cells > 0.0 && std::isfinite(p.gain + p.near_m + p.zone_cells);
}

PotentialParameters parameters_for(const Problem& problem, Attraction attraction) {
  PotentialParameters parameters;
  parameters.attraction = attraction;
  // A robot nearer to the goal than the tolerance is there already, so k does not matter; the maximum only avoids a division by 0.
  const double least_m = problem.goal_tolerance_cells * problem.grid->cell_m();
  parameters.near_m *= problem.grid->cell_m();
  if (attraction == Attraction::kParabolic) parameters.gain /= std::max(distance(problem.start, problem.goal), least_m);
  if (attraction == Attraction::kCombined) parameters.gain /= parameters.near_m;
  return parameters;
}

DriveParameters drive_for(const Problem& problem, Drive drive) {
  DriveParameters how;
  how.drive = drive;
  how.step_s *= problem.grid->cell_m();
  how.mass *= problem.grid->cell_m();
  return how;
}

PotentialField::PotentialField(const Clearance& clearance, Point goal, double cell_m, const PotentialParameters& parameters)
    : clearance_(&clearance), goal_(goal), parameters_(parameters), p0_(parameters.zone_cells * cell_m),
      least_(parameters.least_cells * cell_m) {
  k_r_ = repelling_gain(parameters.balance_cells * cell_m, p0_);
}

double PotentialField::attraction(Point q) const {
  const double d = distance(q, goal_), k = parameters_.gain, d0 = parameters_.near_m;
  switch (parameters_.attraction) {
    case Attraction::kParabolic: return 0.5 * k * d * d;
    case Attraction::kConic: return k * d;
    case Attraction::kCombined: return d <= d0 ? 0.5 * k * d * d : k * d0 * d - 0.5 * k * d0 * d0;
    case Attraction::kCombinedLiteral: return d <= d0 ? 0.5 * k * d * d : 0.5 * k * d;
  }
  return 0.0;
}

Point PotentialField::attracting_force(Point q) const {
  const Point away = q - goal_;
  const double d = norm(away), k = parameters_.gain, d0 = parameters_.near_m;
  if (d == 0.0) return {};
  double modulus = 0.0;
  switch (parameters_.attraction) {
    case Attraction::kParabolic: modulus = k * d; break;
    case Attraction::kConic: modulus = k; break;
    case Attraction::kCombined: modulus = k * std::min(d, d0); break;
    case Attraction::kCombinedLiteral: modulus = d <= d0 ? k * d : 0.5 * k; break;
  }
  return (-modulus / d) * away;
}

double PotentialField::repulsion_at(double distance_m) const {
  if (distance_m > p0_) return 0.0;
  return repelling_potential(k_r_, std::max(distance_m, least_), p0_);
}

double PotentialField::repelling_stiffness(double distance_m) const {
  if (distance_m > p0_) return 0.0;
  const double p = std::max(distance_m, least_);
  return k_r_ * (3.0 / p - 2.0 / p0_) / (p * p * p);
}

double PotentialField::repelling_modulus(double distance_m) const {
  if (distance_m > p0_) return 0.0;
  const double p = std::max(distance_m, least_);
  return k_r_ * (1.0 / p - 1.0 / p0_) / (p * p);
}

double PotentialField::repulsion(Point q) const {
  const double u = repulsion_at(clearance_->nearest(q).distance_m);
  const Point away = q - goal_;
  return parameters_.goal_scaled ? u * dot(away, away) : u;
}

Point PotentialField::repelling_force(Point q) const {
  const Nearest nearest = clearance_->nearest(q);
  if (nearest.distance_m > p0_ || nearest.distance_m <= 0.0) return {};
  const Point out = (1.0 / nearest.distance_m) * (q - nearest.at);   // grad p
  Point force = repelling_modulus(nearest.distance_m) * out;
  if (parameters_.goal_scaled) {   // -grad (u d^2) = d^2 (-grad u) - 2 u (q - goal)
    const Point away = q - goal_;
    force = dot(away, away) * force - 2.0 * repulsion_at(nearest.distance_m) * away;
  }
  return force;
}

bool is_goal_repelled(const PotentialField& field, double tolerance_m) {
  const Point beside = field.goal() + Point{tolerance_m, 0.0};
  return norm(field.repelling_force(field.goal())) > norm(field.attracting_force(beside));
}

std::vector<Point> force_line(const PotentialField& field, Point from, double cell_m, double tolerance_m,
                              std::size_t max_steps) {
  std::vector<Point> line = {from};
  const double h = 0.25 * cell_m;
  const auto direction = [&](Point q) {
    const Point f = field.force(q);
    const double size = norm(f);
    return size > 1e-9 ? (1.0 / size) * f : Point{};
  };
  for (std::size_t step = 0; step < max_steps; ++step) {
    const Point q = line.back();
    if (distance(q, field.goal()) < tolerance_m) break;
    const Point a = direction(q), b = direction(q + 0.5 * h * a), c = direction(q + 0.5 * h * b), d = direction(q + h * c);
    const Point next = q + (h / 6.0) * (a + 2.0 * b + 2.0 * c + d);
    if (field.nearest(next).distance_m <= 0.0) break;
    line.push_back(next);
    // If the line goes to and fro across a valley, it has come to its end.
    if (line.size() > 8 && distance(next, line[line.size() - 8]) < h) break;
  }
  return line;
}

}  // namespace kb::planners
