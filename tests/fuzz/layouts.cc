// Any bytes as a layout (XML as a plant model of openTCS, all else as LIF and as a route graph of Nav2), and as an order for a layout of
// three places. A map and a mission that are made of them must be a knowledge base that parses.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "tests/fuzz/reading.h"
#include "tools/kbc/layout/layout.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb;

struct LayoutReading : Reading {
  layout::Adaptations adaptations;
};

void require_parse(Reading& in, const layout::Map& map, const std::optional<layout::Mission>& mission, const layout::Wording& wording) {
  kb::require_parse(in, layout::write_map(map, wording) + (mission ? layout::write_mission(*mission, map, wording) : std::string()));
}

void require_both_parse(Reading& in, const layout::Map& map, const std::optional<layout::Mission>& mission, const layout::Wording& wording) {
  require_parse(in, map, mission, wording);
  if (!mission) return;
  const auto [fewer, same] = layout::trimmed(map, *mission);
  require_parse(in, fewer, same, wording);
}

layout::Wording wording() {
  layout::Wording wording;
  wording.file = wording.format = "fuzz";
  wording.taken = [](std::string_view name) { return std::ranges::find(syntax::words(), name) != syntax::words().end(); };
  return wording;
}

void try_as(layout::Reader read, const std::string& bytes) {
  LayoutReading in;
  auto layout = read(in.sources, in.sources.add("fuzz", bytes), {}, in.adaptations, in.messages);
  if (layout) layout = layout::joined(std::move(*layout), in.adaptations, in.messages);
  const auto roads = layout ? layout::roads_of(*layout, in.adaptations, in.messages) : std::nullopt;
  in.adaptations.report(in.messages);
  if (!roads) return;
  const layout::Map map{*layout, *roads, layout::landmark_names(*layout, wording())};
  std::optional<layout::Mission> mission;
  if (map.names.size() > 1) {
    const std::string stops[] = {layout->places.front().id, layout->places.back().id};
    mission = layout::mission_by_stops(map, stops, in.messages);
  }
  require_both_parse(in, map, mission, wording());
}

void try_as_order(const std::string& bytes) {
  const layout::Layout places_and_ways{"", {{"N1", "", {0, 0}, {}}, {"N2", "", {4, 0}, {}}, {"N3", "", {9, 0}, {}}},
                                       {{"E12", "N1", "N2", {}, false, {}, {}}, {"E21", "N2", "N1", {}, false, {}, {}},
                                        {"E23", "N2", "N3", {}, false, {}, {}}, {"E23b", "N2", "N3", {{6, 3}}, false, {}, {}},
                                        {"E13", "N1", "N3", {}, false, {}, {}}}};   // over N2
  LayoutReading in;
  const layout::Layout layout = layout::joined(places_and_ways, in.adaptations, in.messages).value();
  const layout::Map map{layout, layout::roads_of(layout, in.adaptations, in.messages).value(), layout::landmark_names(layout, wording())};
  const auto mission = layout::mission_of_order(in.sources, in.sources.add("fuzz", bytes), map, in.adaptations, in.messages);
  if (mission) require_both_parse(in, map, mission, wording());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('<')) {
    try_as(layout::read_opentcs, bytes);
  } else {
    try_as(layout::read_lif, bytes);
    try_as(layout::read_nav2, bytes);
    try_as_order(bytes);
  }
  return 0;
}
