#include "sim/world/floor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kCell = 0.25;          // m
constexpr double kSensorReach = 0.05;   // m: no sensor sees a wider spot

/// A thing on the floor, and the distance within which a sensor may notice it.
struct Reach { Spot from, to; double margin_m; };

bool is_by(Floor::Cause cause, Floor::Cause other) { return cause == Floor::kNobody || cause == other; }

void note(std::vector<Floor::Cause>& causes, bool holds, Floor::Cause cause) {
  if (holds) causes.push_back(cause);
  else std::erase_if(causes, [cause](Floor::Cause other) { return is_by(cause, other); });
}

}  // namespace

Floor::Floor(const Labyrinth& labyrinth)
    : labyrinth_(labyrinth),
      closed_by_(labyrinth.roads.size()),
      unsafe_by_(labyrinth.crossings.size()),
      unpainted_(labyrinth.crossings.size(), false),
      tags_(labyrinth.tags.size()),
      memories_(labyrinth.crossings.size()) {
  for (const Crossing& crossing : labyrinth.crossings) methods_.push_back(crossing.methods);
  paint_ = labyrinth.paint;
  paint_.insert(paint_.end(), labyrinth.stop_lines.begin(), labyrinth.stop_lines.end());
  for (std::size_t c = 0; c < labyrinth.crossings.size(); ++c) memories_[c] = memory_of(static_cast<CrossingId>(c));
  for (std::size_t t = 0; t < tags_.size(); ++t) write_tag(t);
  lay_grid();
}

void Floor::lay_grid() {
  columns_ = static_cast<int>((labyrinth_.high.x_m - labyrinth_.low.x_m) / kCell) + 1;
  rows_ = static_cast<int>((labyrinth_.high.y_m - labyrinth_.low.y_m) / kCell) + 1;
  // Sorts things into cells by counting: the first pass counts the things of each cell, the second lists them, in ascending order.
  const auto fill = [&](std::vector<Cell>& cells, std::vector<std::uint32_t>& list, std::size_t things, auto reach) {
    cells.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    const auto each = [&](auto visit) {
      for (std::size_t i = 0; i < things; ++i) {
        const Reach r = reach(i);
        const double margin_m = r.margin_m + 0.7072 * kCell;   // half of a cell's diagonal
        const auto range = [&](double from, double to, double low, int count) {
          const int first = static_cast<int>(std::floor((std::min(from, to) - margin_m - low) / kCell));
          const int last = static_cast<int>(std::floor((std::max(from, to) + margin_m - low) / kCell));
          return std::pair(std::max(first, 0), std::min(last, count - 1));
        };
        const auto [left, right] = range(r.from.x_m, r.to.x_m, labyrinth_.low.x_m, columns_);
        const auto [bottom, top] = range(r.from.y_m, r.to.y_m, labyrinth_.low.y_m, rows_);
        for (int row = bottom; row <= top; ++row) {
          for (int column = left; column <= right; ++column) {
            const Spot centre = labyrinth_.low + Spot{(column + 0.5) * kCell, (row + 0.5) * kCell};
            if (nearest_on(r.from, r.to, centre).distance_m < margin_m) visit(cells[static_cast<std::size_t>(row * columns_ + column)], i);
          }
        }
      }
    };
    each([](Cell& cell, std::size_t) { ++cell.count; });
    std::uint32_t total = 0;
    for (Cell& cell : cells) {
      cell.first = total;
      total += std::exchange(cell.count, 0);
    }
    list.resize(total);
    each([&](Cell& cell, std::size_t i) { list[cell.first + cell.count++] = static_cast<std::uint32_t>(i); });
  };
  fill(paint_cells_, paint_list_, paint_.size(), [&](std::size_t i) { return Reach{paint_[i].from, paint_[i].to, paint_[i].half_width_m + kSensorReach}; });
  fill(tag_cells_, tag_list_, tags_.size(), [&](std::size_t i) { return Reach{labyrinth_.tags[i].at, labyrinth_.tags[i].at, labyrinth_.size * kTagRange}; });
}

std::optional<std::size_t> Floor::place_of(Spot spot) const {
  const double column = (spot.x_m - labyrinth_.low.x_m) / kCell, row = (spot.y_m - labyrinth_.low.y_m) / kCell;
  if (!(column >= 0.0 && column < columns_ && row >= 0.0 && row < rows_)) return std::nullopt;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

float Floor::darkness(Spot spot, double radius_m) const {
  const auto place = place_of(spot);
  if (!place) return 0.0f;
  const Cell& cell = paint_cells_[*place];
  double darkest = 0.0;
  for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
    const Paint& paint = paint_[paint_list_[k]];
    const Spot along = paint.to - paint.from, to = spot - paint.from;
    const double square = dot(along, along), share = dot(to, along);
    if (share < 0.0 || share > square) continue;
    const double aside_m = std::abs(cross(along, to)) / std::sqrt(square);
    const double dark = std::clamp((paint.half_width_m + radius_m - aside_m) / (2.0 * radius_m), 0.0, 1.0);
    if (dark <= darkest) continue;
    if (paint.crossing != CrossingId::kNone && unpainted_[at(paint.crossing)]) continue;
    if (!worn_.empty() && is_worn(paint, spot)) continue;
    darkest = dark;
  }
  return static_cast<float>(darkest);
}

bool Floor::is_worn(const Paint& paint, Spot spot) const {
  if (paint.road == RoadId::kNone) return false;
  for (const Worn& worn : worn_) {
    if (worn.road != paint.road) continue;
    const Road& road = labyrinth_[worn.road];
    const double along_m = nearest_along(road.along, spot).along_m - road.begins_m;
    if (along_m >= worn.from_m && along_m <= worn.to_m) return true;
  }
  return false;
}

const Floor::Reading* Floor::tag_near(Spot spot) const {
  const auto place = place_of(spot);
  if (!place) return nullptr;
  const Cell& cell = tag_cells_[*place];
  const Reading* best = nullptr;
  double best_m = labyrinth_.size * kTagRange;
  for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
    const std::uint32_t tag = tag_list_[k];
    const double far_m = distance(labyrinth_.tags[tag].at, spot);
    if (far_m >= best_m || tags_[tag].state == TagState::kUnreadable) continue;
    best_m = far_m;
    best = &tags_[tag].reading;
  }
  return best;
}

std::shared_ptr<const Memory> Floor::memory_of(CrossingId id) const {
  const Crossing& crossing = labyrinth_[id];
  auto memory = std::make_shared<Memory>();
  memory->landmark = crossing.name;
  memory->safe = safe(id);
  memory->methods = methods_[at(id)];
  for (const Arm& arm : crossing.arms) memory->exits.push_back({arm.name, closed(arm.road)});
  return memory;
}

CrossingId Floor::says(std::size_t tag) const { return tags_[tag].state == TagState::kWrong ? tags_[tag].instead : labyrinth_.tags[tag].crossing; }

void Floor::write_tag(std::size_t tag) {
  const CrossingId crossing = says(tag);
  Reading& reading = tags_[tag].reading;
  reading.memory = memories_[at(crossing)];
  reading.arm = 0;
  const std::string& name = labyrinth_[labyrinth_.tags[tag].crossing].arms[labyrinth_.tags[tag].arm].name;
  const std::vector<Arm>& arms = labyrinth_[crossing].arms;
  for (std::uint32_t a = 0; a < arms.size(); ++a) {
    if (arms[a].name == name) reading.arm = a;
  }
}

void Floor::remember(CrossingId id) {
  memories_[at(id)] = memory_of(id);
  for (std::size_t t = 0; t < tags_.size(); ++t) {
    if (says(t) == id) write_tag(t);
  }
}

void Floor::set_closed(RoadId road, bool closed, Cause cause) {
  note(closed_by_[at(road)], closed, cause);
  remember(labyrinth_[road].from);
  remember(labyrinth_[road].to);
}

void Floor::set_safe(CrossingId crossing, bool safe, Cause cause) {
  note(unsafe_by_[at(crossing)], !safe, cause);
  remember(crossing);
}

void Floor::set_methods(CrossingId crossing, std::vector<std::string> methods) {
  unpainted_[at(crossing)] = std::find(methods.begin(), methods.end(), "mark") == methods.end();
  methods_[at(crossing)] = std::move(methods);
  remember(crossing);
}

void Floor::mend(RoadId road, Cause cause) {
  std::erase_if(worn_, [&](const Worn& worn) { return worn.road == road && is_by(cause, worn.cause); });
}

void Floor::set_tag(CrossingId crossing, std::uint32_t arm, TagState state, CrossingId instead) {
  for (std::size_t t = 0; t < tags_.size(); ++t) {
    if (labyrinth_.tags[t].crossing != crossing || labyrinth_.tags[t].arm != arm) continue;
    tags_[t].state = state;
    tags_[t].instead = instead;
  }
  remember(state == TagState::kWrong ? instead : crossing);
}

}  // namespace kb::sim
