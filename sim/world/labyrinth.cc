#include "sim/world/labyrinth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim {

const Arm* Crossing::arm(std::string_view exit) const {
  for (const Arm& candidate : arms) {
    if (candidate.name == exit) return &candidate;
  }
  return nullptr;
}

double Crossing::apart_rad(const Arm& arm) const {
  double least_rad = kPi;
  const std::size_t count = arms.size(), own = static_cast<std::size_t>(&arm - arms.data());
  for (const std::size_t beside : {(own + 1) % count, (own + count - 1) % count}) {   // they are in the order of their headings
    if (beside != own) least_rad = std::min(least_rad, std::abs(wrap(arms[beside].heading_rad - arm.heading_rad)));
  }
  return least_rad;
}

std::vector<Spot> Road::between_stop_lines() const { return part_of(along, begins_m, ends_m); }

CrossingId Labyrinth::crossing(std::string_view landmark) const {
  const auto found = by_name.find(std::string(landmark));
  return found != by_name.end() ? found->second : CrossingId::kNone;
}

std::optional<Labyrinth::End> Labyrinth::end(std::string_view landmark_and_exit) const {
  const std::size_t dot = landmark_and_exit.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const CrossingId found = crossing(landmark_and_exit.substr(0, dot));
  if (found == CrossingId::kNone) return std::nullopt;
  const Arm* arm = (*this)[found].arm(landmark_and_exit.substr(dot + 1));
  if (arm == nullptr) return std::nullopt;
  return End{found, arm};
}

std::vector<Spot> Labyrinth::course(const Arm& arm) const {
  const Road& road = (*this)[arm.road];
  std::vector<Spot> chain = road.between_stop_lines();
  if (!arm.forward) std::reverse(chain.begin(), chain.end());
  return chain;
}

Pose Labyrinth::place(End end, double along_m) const {
  constexpr double kRounding = 1e-6;   // m
  const std::vector<Spot> chain = course(*end.arm);
  OnChain on = point_on(chain, along_m);
  if ((*this)[end.arm->road].kind == Picture::Kind::kMark) {
    const std::vector<Spot> line = rounded(chain, size * kBendRadius);
    const Along near = nearest_along(line, on.at);
    if (near.distance_m > kRounding) on = point_on(line, near.along_m);
  }
  return {on.at.x_m, on.at.y_m, on.heading_rad};
}

bool Labyrinth::has_room(Spot spot, double radius_m) const {
  const auto at_wall = [&](const Picture::Wall& wall) { return nearest_on(wall.from, wall.to, spot).distance_m < radius_m; };
  const auto at_pillar = [&](const Pillar& pillar) { return distance(pillar.at, spot) < pillar.radius_m + radius_m; };
  const auto in_box = [&](const std::vector<Spot>& corners) {   // convex; corners in order, clockwise or counter-clockwise
    int left = 0, right = 0;   // a box that is but a wall has no inside
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Spot& corner = corners[i];
      const double side = cross(corners[(i + 1) % corners.size()] - corner, spot - corner);
      left += side > 0.0 ? 1 : 0;
      right += side < 0.0 ? 1 : 0;
    }
    return left == static_cast<int>(corners.size()) || right == static_cast<int>(corners.size());
  };
  return std::none_of(walls.begin(), walls.end(), at_wall) && std::none_of(pillars.begin(), pillars.end(), at_pillar) &&
         std::none_of(boxes.begin(), boxes.end(), in_box);
}

namespace {

constexpr std::array<std::string_view, 16> kCompass{"E", "ENE", "NE", "NNE", "N", "NNW", "NW", "WNW", "W", "WSW", "SW", "SSW", "S", "SSE", "SE", "ESE"};

}  // namespace

std::optional<double> compass_heading(std::string_view word) {
  const auto found = std::find(kCompass.begin(), kCompass.end(), word);
  if (found == kCompass.end()) return std::nullopt;
  return wrap(static_cast<double>(found - kCompass.begin()) * kPi / 8.0);
}

std::string_view compass_word(double heading_rad) {
  const long quarters = std::lround(wrap(heading_rad) / (kPi / 2.0));
  return kCompass[static_cast<std::size_t>(quarters + 4) % 4 * 4];
}

Picture picture_of(const Labyrinth& labyrinth, double robot_radius_m) {
  Picture picture;
  for (const Crossing& crossing : labyrinth.crossings) picture.landmarks.push_back({crossing.name, crossing.at});
  for (const Road& road : labyrinth.roads) {
    const bool hall = road.kind == Picture::Kind::kOpen;
    const double width_m = hall ? labyrinth.size * kRoadWidth : road.width_m, door_m = labyrinth.size * kHallDoor;
    picture.roads.push_back({road.name, labyrinth[road.from].name, labyrinth[road.to].name, road.kind, width_m, road.along});
    if (hall) picture.halls.push_back({road.width_m, part_of(road.along, road.begins_m + door_m, road.ends_m - door_m)});
  }
  const auto stroke = [](const Paint& paint) { return Picture::Stroke{paint.from, paint.to, 2.0 * paint.half_width_m}; };
  std::transform(labyrinth.paint.begin(), labyrinth.paint.end(), std::back_inserter(picture.lines), stroke);
  std::transform(labyrinth.stop_lines.begin(), labyrinth.stop_lines.end(), std::back_inserter(picture.stop_lines), stroke);
  picture.walls = labyrinth.walls;
  picture.blocks = labyrinth.boxes;
  constexpr int kSides = 8;   // a pillar is drawn as a polygon, as players show only walls and blocks
  for (const Pillar& pillar : labyrinth.pillars) {
    for (int i = 0; i < kSides; ++i) {
      const auto corner = [&](int k) { return pillar.at + pillar.radius_m * direction(2.0 * kPi * k / kSides); };
      picture.walls.push_back({corner(i), corner(i + 1)});
      if (i == 0) picture.blocks.emplace_back();
      picture.blocks.back().push_back(corner(i));
    }
  }
  picture.low = labyrinth.low;
  picture.high = labyrinth.high;
  picture.robot_radius_m = robot_radius_m;
  return picture;
}

}  // namespace kb::sim
