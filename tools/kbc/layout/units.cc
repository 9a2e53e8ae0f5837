// Whether the places of a layout can be in metres.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"

namespace kb::layout {
namespace {

constexpr double kTooShort_m = 0.1;    // if no way is longer, no robot fits on any
constexpr double kTooLong_m = 100.0;   // if no way is shorter, this is no plant: 10 cm in millimetres
constexpr double kTooFar_m = 1e8;      // out of bounds, which is reported elsewhere

}  // namespace

void warn_of_units(const Layout& layout, diagnostics::Diagnostics& diagnostics) {
  std::unordered_map<std::string_view, const Place*> places;
  for (const Place& place : layout.places) places.emplace(place.id, &place);
  double shortest_m = std::numeric_limits<double>::infinity(), longest_m = 0.0;
  for (const Way& way : layout.ways) {
    const auto from = places.find(way.from), to = places.find(way.to);
    if (from == places.end() || to == places.end() || from == to) continue;   // reported elsewhere
    const std::vector<Point> course = chain_of(from->second->at, way.through, to->second->at);
    double length_m = 0.0;
    for (std::size_t i = 1; i < course.size(); ++i) length_m += distance(course[i - 1], course[i]);
    shortest_m = std::min(shortest_m, length_m);
    longest_m = std::max(longest_m, length_m);
  }
  if (longest_m == 0.0 || longest_m > kTooFar_m || (longest_m >= kTooShort_m && shortest_m <= kTooLong_m)) return;
  const std::string_view looks = longest_m < kTooShort_m ? "they look like degrees" : "they look like millimetres";
  diagnostics.report(diagnostics::Kind::kLayoutUnits, layout.places.front().span, {fmt::format("{:.4g}", shortest_m), fmt::format("{:.4g}", longest_m), looks});
}

}  // namespace kb::layout
