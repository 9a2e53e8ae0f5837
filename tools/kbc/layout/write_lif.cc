// A layout as LIF 1.0: what read_lif reads.
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {
namespace {

using nlohmann::ordered_json;

/// Names from a command line may be any bytes; what is no UTF-8 becomes U+FFFD.
std::string text(const ordered_json& json) { return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace); }

ordered_json point(Point at) { return {{"x", as_written(at.x_m)}, {"y", as_written(at.y_m)}}; }

/// Straight pieces are a spline of degree 1, whose first and last knots stand twice.
ordered_json trajectory(const std::vector<Point>& chain) {
  ordered_json knots = {0.0}, points = ordered_json::array();
  for (std::size_t i = 0; i < chain.size(); ++i) {
    knots.push_back(static_cast<double>(i) / static_cast<double>(chain.size() - 1));
    points.push_back(point(chain[i]));
  }
  knots.push_back(1.0);
  return {{"degree", 1}, {"knotVector", std::move(knots)}, {"controlPoints", std::move(points)}};
}

ordered_json node(const Place& place, const LifHead& head) {
  return {{"nodeId", place.id}, {"mapId", head.map}, {"nodePosition", point(place.at)}, {"vehicleTypeNodeProperties", {{{"vehicleTypeId", head.vehicle}}}}};
}

ordered_json edge(const Way& way, const PlaceIndex& places, const LifHead& head) {
  ordered_json of_vehicle = {{"vehicleTypeId", head.vehicle}, {"vehicleOrientation", 0.0}, {"orientationType", "TANGENTIAL"}, {"rotationAllowed", true}};
  if (way.limit_m_s > 0.0) of_vehicle["maxSpeed"] = as_written(way.limit_m_s);
  if (!way.through.empty()) of_vehicle["trajectory"] = trajectory(chain_of(places.find(way.from)->at, way.through, places.find(way.to)->at));
  ordered_json made = {{"edgeId", way.id}, {"startNodeId", way.from}, {"endNodeId", way.to}};
  if (!way.method.empty()) made["edgeDescription"] = "by " + way.method;
  made["vehicleTypeEdgeProperties"] = ordered_json::array({std::move(of_vehicle)});
  return made;
}

/// A list with an element on each line: a layout of a million ways is never held as JSON as a whole.
template <class Items, class Make>
void add_list(std::string& out, std::string_view key, const Items& items, Make make) {
  out.append("      \"").append(key).append("\": [");
  std::string_view before = "\n";
  for (const auto& item : items) {
    out.append(before).append("        ").append(text(make(item)));
    before = ",\n";
  }
  out += items.empty() ? "]" : "\n      ]";
}

}  // namespace

std::string write_lif(const Layout& layout, const LifHead& head) {
  const PlaceIndex places(layout.places);
  const ordered_json about = {{"projectIdentification", layout.name}, {"creator", "kbc export lif"}, {"exportTimestamp", head.timestamp}, {"lifVersion", "1.0.0"}};
  std::string out = "{\n  \"metaInformation\": " + text(about) + ",\n  \"layouts\": [\n    {\n      \"layoutId\": " + text(head.map) + ",\n      \"layoutVersion\": \"1\",\n";
  add_list(out, "nodes", layout.places, [&](const Place& place) { return node(place, head); });
  out += ",\n";
  add_list(out, "edges", layout.ways, [&](const Way& way) { return edge(way, places, head); });
  return out + ",\n      \"stations\": []\n    }\n  ]\n}\n";
}

}  // namespace kb::layout
