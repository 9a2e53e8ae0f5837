// A warehouse: it grows aisle by aisle, each joined to the one before it by the cross aisles, until there are enough roads.
#include <algorithm>
#include <cmath>

#include "bench/maps/dice.h"
#include "bench/maps/road_map.h"

namespace kb::bench {
namespace {

constexpr double kAisleGap = 3.0;        ///< metres between aisles
constexpr double kPositionGap = 2.5;     ///< metres between positions of an aisle
constexpr float kEmptyPositions = 0.1f;  ///< so many positions are not there
constexpr float kBlindAisles = 0.15f;    ///< so many aisles do not reach the back

class WarehouseMaker {
 public:
  WarehouseMaker(std::uint32_t roads, std::uint64_t seed) : wanted_(std::max(roads, kFewestRoads)), dice_(seed) {
    // About as wide as deep: an aisle has sections_ * (positions_ + 1) roads, and sections_ + 1 to the aisle before it.
    positions_ = std::clamp(static_cast<std::uint32_t>(std::cbrt(wanted_)) / 2, 2u, 10u);
    const double depth = std::sqrt(wanted_) * kAisleGap / kPositionGap;
    sections_ = std::max(1u, static_cast<std::uint32_t>(depth) / (positions_ + 1));
  }

  RoadMap make() {
    map_.name = "Warehouse";
    for (std::uint32_t aisle = 0; !full(); ++aisle) add_aisle(aisle);
    return std::move(map_);
  }

 private:
  [[nodiscard]] bool full() const { return map_.roads.size() >= wanted_; }

  std::uint32_t landmark(char letter, double x_m, double y_m) {
    map_.landmarks.push_back({letter, {x_m, y_m}});
    return static_cast<std::uint32_t>(map_.landmarks.size() - 1);
  }

  void join(std::uint32_t from, Side side, std::uint32_t to, Method by) {
    const End a{from, side}, b{to, opposite(side)};
    for (const End& end : {a, b}) {
      map_.landmarks[end.landmark].road[static_cast<std::size_t>(end.side)] = static_cast<std::uint32_t>(map_.roads.size());
    }
    map_.roads.push_back({a, b, by, {}});
  }

  /// From the front to the back; each new landmark hangs on one that is there, so the map may end anywhere.
  void add_aisle(std::uint32_t aisle) {
    const double x = aisle * kAisleGap;
    const bool blind = aisle > 0 && dice_.chance(kBlindAisles);
    std::vector<std::uint32_t> crossings{landmark('X', x, 0.0)};
    if (aisle > 0) join(before_.front(), Side::kE, crossings.front(), Method::kMark);
    if (aisle % 2 == 0 && !full()) {
      const std::uint32_t station = landmark('S', x, -kPositionGap);
      join(crossings.front(), Side::kS, station, Method::kMark);
    }
    std::uint32_t last = crossings.front();
    for (std::uint32_t slot = 1; slot <= sections_ * (positions_ + 1) && !full(); ++slot) {
      const bool crossing = slot % (positions_ + 1) == 0;
      if (!crossing && dice_.chance(kEmptyPositions)) continue;
      if (blind && slot == sections_ * (positions_ + 1)) break;
      const std::uint32_t next = landmark(crossing ? 'X' : 'P', x, slot * kPositionGap);
      join(last, Side::kN, next, Method::kDist);
      last = next;
      if (!crossing) continue;
      crossings.push_back(next);
      if (crossings.size() <= before_.size() && !full()) join(before_[crossings.size() - 1], Side::kE, next, Method::kAzimuth);
    }
    // A cross aisle goes on past an aisle that ends before it only if an aisle stands there: it ends here.
    before_ = std::move(crossings);
  }

  std::uint32_t wanted_;
  Dice dice_;
  RoadMap map_;
  std::uint32_t positions_ = 0, sections_ = 0;   ///< positions between two cross aisles; cross aisles behind the front
  std::vector<std::uint32_t> before_;            ///< crossings of the last aisle, from the front
};

}  // namespace

RoadMap make_warehouse(std::uint32_t roads, std::uint64_t seed) { return WarehouseMaker(roads, seed).make(); }

}  // namespace kb::bench
