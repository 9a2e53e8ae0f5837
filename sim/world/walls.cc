// Builds walls: on both sides of `dist` roads, round the crossings that these reach, round halls, and at the borders of the background.
#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

// m, times the size
constexpr double kPillarEvery = 1.1, kPillarRadius = 0.15, kPillarAside = 0.3;

void add_wall(Labyrinth& out, Spot from, Spot to) {
  if (distance(from, to) > 1e-6) out.walls.push_back({from, to});
}

void add_walls(Labyrinth& out, const std::vector<Spot>& chain) {
  for (std::size_t i = 1; i < chain.size(); ++i) add_wall(out, chain[i - 1], chain[i]);
}

/// The chain that runs `aside_m` to the left of a chain, with mitred corners.
std::vector<Spot> beside(const std::vector<Spot>& chain, double aside_m) {
  std::vector<Spot> out;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const double in = heading(i > 0 ? chain[i] - chain[i - 1] : chain[i + 1] - chain[i]);
    const double next = heading(i + 1 < chain.size() ? chain[i + 1] - chain[i] : chain[i] - chain[i - 1]);
    const double half = 0.5 * wrap(next - in);
    out.push_back(chain[i] + (aside_m / std::max(std::cos(half), 0.2)) * left_of(direction(in + half)));
  }
  return out;
}

/// The wall of a crossing from the left end of an arm's stop line to the right end of the next arm's.
void wall_corner(Labyrinth& out, const Crossing& crossing, const Arm& arm, const Arm& next) {
  const double half_m = 0.5 * out.size * kRoadWidth;
  const Spot ahead = direction(arm.heading_rad), ahead_next = direction(next.heading_rad);
  const Spot begin = crossing.at + arm.stop_m * ahead + half_m * left_of(ahead);
  const Spot end = crossing.at + next.stop_m * ahead_next - half_m * left_of(ahead_next);
  double gap = wrap(next.heading_rad - arm.heading_rad);
  if (gap <= 1e-9) gap += 2.0 * kPi;
  std::vector<Spot> chain{begin};
  if (gap > 2.0 * kPi - 0.5) {          // a dead end
    chain.push_back(crossing.at - half_m * ahead + half_m * left_of(ahead));
    chain.push_back(crossing.at - half_m * ahead_next - half_m * left_of(ahead_next));
  } else if (std::abs(gap - kPi) > 0.02) {
    const double along_m = std::max(half_m / std::tan(0.5 * gap), -2.0 * half_m);
    chain.push_back(crossing.at + along_m * ahead + half_m * left_of(ahead));
  }
  chain.push_back(end);
  add_walls(out, chain);
}

/// A place in a hall, given by the distance along its road from the stop line where it begins, and to the left of the road's middle.
Spot in_hall(const Road& road, double along_m, double aside_m) {
  const OnChain on = point_on(road.along, road.begins_m + along_m);
  return on.at + aside_m * left_of(direction(on.heading_rad));
}

void furnish_hall(Labyrinth& out, const Road& road, const std::vector<Spot>& chain) {
  for (const HallBuild::Box& box : road.boxes) {
    std::vector<Spot> corners{in_hall(road, box.from_along_m, box.from_aside_m), in_hall(road, box.to_along_m, box.from_aside_m),
                              in_hall(road, box.to_along_m, box.to_aside_m), in_hall(road, box.from_along_m, box.to_aside_m)};
    out.boxes.push_back(corners);
    corners.push_back(corners.front());
    add_walls(out, corners);
  }
  const double long_m = length_of(chain);
  const int count = road.pillars ? static_cast<int>(long_m / (out.size * kPillarEvery)) : 0;
  for (int i = 1; i <= count; ++i) {
    const OnChain on = point_on(chain, long_m * i / (count + 1));
    const double aside_m = i % 3 == 0 ? 0.0 : (i % 3 == 1 ? 1.0 : -1.0) * out.size * kPillarAside;
    out.pillars.push_back({on.at + aside_m * left_of(direction(on.heading_rad)), out.size * kPillarRadius});
  }
}

/// Builds the walls of a hall from door to door, and of the short passages from the stop lines to the doors.
void wall_hall(Labyrinth& out, const Road& road) {
  const double half_m = 0.5 * out.size * kRoadWidth, door_m = out.size * kHallDoor;
  const auto chain = part_of(road.along, road.begins_m + door_m, road.ends_m - door_m);
  const auto way_in = part_of(road.along, road.begins_m, road.begins_m + door_m);
  const auto way_out = part_of(road.along, road.ends_m - door_m, road.ends_m);
  for (const double side : {1.0, -1.0}) {
    const auto wall = beside(chain, side * 0.5 * road.width_m);
    const auto first = beside(way_in, side * half_m), last = beside(way_out, side * half_m);
    add_walls(out, first);
    add_wall(out, first.back(), wall.front());
    add_walls(out, wall);
    add_wall(out, wall.back(), last.front());
    add_walls(out, last);
  }
  furnish_hall(out, road, chain);
}

/// The borders between free and blocked cells, joined to long walls.
void wall_background(Labyrinth& out, const planners::Grid& grid) {
  const auto corner = [&](int x, int y) {
    return Spot{grid.origin_m().x + x * grid.cell_m(), grid.origin_m().y + y * grid.cell_m()};
  };
  for (const bool upright : {false, true}) {
    const int rows = upright ? grid.width() : grid.height(), columns = upright ? grid.height() : grid.width();
    for (int row = 1; row < rows; ++row) {
      int begin = -1;
      for (int column = 0; column <= columns; ++column) {
        const auto cell = [&](int r) { return upright ? planners::Cell{r, column} : planners::Cell{column, r}; };
        const bool border = column < columns && grid.blocked(cell(row)) != grid.blocked(cell(row - 1));
        if (border && begin < 0) begin = column;
        if (border || begin < 0) continue;
        if (upright) add_wall(out, corner(row, begin), corner(row, column));
        else add_wall(out, corner(begin, row), corner(column, row));
        begin = -1;
      }
    }
  }
}

}  // namespace

void build_walls(Labyrinth& labyrinth, const planners::Grid* background) {
  for (const Road& road : labyrinth.roads) {
    if (road.kind == Picture::Kind::kOpen) wall_hall(labyrinth, road);
    if (road.kind != Picture::Kind::kDist) continue;
    const auto chain = road.between_stop_lines();
    add_walls(labyrinth, beside(chain, 0.5 * road.width_m));
    add_walls(labyrinth, beside(chain, -0.5 * road.width_m));
  }
  for (const Crossing& crossing : labyrinth.crossings) {
    for (std::size_t i = 0; crossing.walled && i < crossing.arms.size(); ++i) {
      wall_corner(labyrinth, crossing, crossing.arms[i], crossing.arms[(i + 1) % crossing.arms.size()]);
    }
  }
  if (background != nullptr) wall_background(labyrinth, *background);
}

}  // namespace kb::sim
