#include "sim/world/nearby.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

namespace kb::sim {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::d2::point_xy<double>;
using Extent = bg::model::box<Corner>;
using Entry = std::pair<Extent, std::uint32_t>;

constexpr double kSlack_m = 1e-6;   // callers compute the exact distances by other formulas, which round differently

Extent extent(const Bounds& box, double margin_m) { return {{box.low.x_m - margin_m, box.low.y_m - margin_m}, {box.high.x_m + margin_m, box.high.y_m + margin_m}}; }

}  // namespace

Bounds bounds_of(Spot spot) { return {spot, spot}; }

Bounds grown(const Bounds& bounds, Spot spot) {
  return {{std::min(bounds.low.x_m, spot.x_m), std::min(bounds.low.y_m, spot.y_m)}, {std::max(bounds.high.x_m, spot.x_m), std::max(bounds.high.y_m, spot.y_m)}};
}

Bounds bounds_of(Spot from, Spot to) { return grown(bounds_of(from), to); }

Bounds bounds_of(const std::vector<Spot>& chain) {
  Bounds bounds = bounds_of(chain.front());
  for (const Spot& spot : chain) bounds = grown(bounds, spot);
  return bounds;
}

struct Nearby::Tree {
  bg::index::rtree<Entry, bg::index::rstar<16>> entries;
};

Nearby::Nearby(const std::vector<Bounds>& things) {
  std::vector<Entry> entries;
  entries.reserve(things.size());
  for (std::size_t i = 0; i < things.size(); ++i) entries.emplace_back(extent(things[i], 0.0), static_cast<std::uint32_t>(i));
  tree_ = std::make_unique<Tree>(Tree{decltype(Tree::entries)(entries.begin(), entries.end())});   // built at once from all entries: packed
}

Nearby::~Nearby() = default;

std::vector<std::uint32_t> Nearby::near(const Bounds& bounds, double within_m) const {
  std::vector<std::uint32_t> found;
  const auto take = boost::make_function_output_iterator([&found](const Entry& entry) { found.push_back(entry.second); });
  tree_->entries.query(bg::index::intersects(extent(bounds, within_m + kSlack_m)), take);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace kb::sim
