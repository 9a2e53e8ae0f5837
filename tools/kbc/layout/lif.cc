// LIF, the Layout Interchange Format of the VDMA: 1.0 (and the 0.11 of its examples), and `origins` of the draft of 2.0.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "tools/kbc/layout/curve.h"
#include "tools/kbc/layout/json.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

class LifReader {
 public:
  LifReader(const Choice& choice, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics)
      : choice_(choice), adaptations_(adaptations), diagnostics_(diagnostics) {}

  std::optional<Layout> run(const Json& root) {
    const Json* chosen = choose(layouts_of(root), root);
    if (chosen == nullptr) return std::nullopt;
    const Fields fields(*chosen, "the layout", diagnostics_);
    Layout layout;
    if (const Json* name = fields.may("layoutName", Json::Kind::kString)) layout.name = name->text;
    for (const Json* node : fields.objects("nodes")) read_node(*node, layout);
    if (layout.places.empty() && !choice_.vehicle.empty() && !diagnostics_.failed()) {
      const std::string known = types_.empty() ? "none" : fmt::format("`{}`", fmt::join(types_, "`, `"));
      diagnostics_.report(Kind::kLayoutVehicle, chosen->span, {choice_.vehicle, known});
    }
    const PlaceIndex places(layout.places);
    for (const Json* edge : fields.objects("edges")) read_edge(*edge, places, layout);
    if (fields.may("stations", Json::Kind::kList) == nullptr) return layout;
    for (const Json* station : fields.objects("stations")) read_station(*station, layout);
    return layout;
  }

 private:
  std::vector<const Json*> layouts_of(const Json& root) {
    const Fields file(root, "the file", diagnostics_);
    if (root.find("origins") == nullptr) return file.objects("layouts");
    std::vector<const Json*> all;
    for (const Json* origin : file.objects("origins")) {
      for (const Json* layout : Fields(*origin, "the origin", diagnostics_).objects("layouts")) all.push_back(layout);
    }
    return all;
  }

  const Json* choose(const std::vector<const Json*>& layouts, const Json& root) {
    std::vector<std::string> ids;
    const Json* chosen = nullptr;
    for (const Json* layout : layouts) {
      const Json* id = layout->find("layoutId");
      ids.push_back(id == nullptr ? "" : id->text);
      if (choice_.layout.empty() || ids.back() != choice_.layout) continue;
      if (chosen != nullptr) adaptations_.note("layout of the same id as the one that is taken: left out", layout->span);
      else chosen = layout;
    }
    if (chosen != nullptr) return chosen;
    const std::string names = fmt::format("`{}`", fmt::join(ids, "`, `"));
    if (layouts.empty()) {
      if (!diagnostics_.failed()) diagnostics_.report(Kind::kLayoutEmpty, root.span);
      return nullptr;
    }
    if (!choice_.layout.empty()) diagnostics_.report(Kind::kLayoutUnknown, root.span, {choice_.layout, names});
    else if (layouts.size() == 1) return layouts[0];
    else diagnostics_.report(Kind::kLayoutChoose, root.span, {names});
    return nullptr;
  }

  // The properties of an edge for each type of vehicle, in either version's list.
  static std::vector<const Json*> of_all_types(const Json& edge) {
    std::vector<const Json*> all;
    for (const std::string_view key : {"vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties"}) {
      const Json* list = edge.find(key);
      if (list == nullptr) continue;
      for (const Json& one : list->parts) all.push_back(&one);
    }
    return all;
  }

  // Reports an edge that several types of vehicles drive by different trajectories.
  void note_other_trajectories(const Json& edge, const Json& taken, source::Span at) {
    const Json* ours = taken.find("trajectory");
    for (const Json* one : of_all_types(edge)) {
      const Json* other = one->find("trajectory");
      if ((ours == nullptr) == (other == nullptr) && (ours == nullptr || *ours == *other)) continue;
      return adaptations_.note("edge that types of vehicles drive by different trajectories: as the first one does; see --vehicle", at);
    }
  }

  // How fast the edge may be driven; without a choice of a type of vehicle, by the slowest that may drive it.
  double limit_on(const Json& edge, const Json& taken, const Json& id) {
    const auto limit = [](const Json& of_type) {
      const Json* speed = of_type.find("maxSpeed");
      return speed == nullptr || speed->kind != Json::Kind::kNumber ? 0.0 : limit_of(speed->number);
    };
    double lowest = limit(taken);
    if (!choice_.vehicle.empty()) return lowest;
    bool differ = false, barred = false;
    for (const Json* one : of_all_types(edge)) {
      const Json* speed = one->find("maxSpeed");
      if (speed != nullptr && speed->kind == Json::Kind::kNumber && !layout::may_drive(speed->number)) {
        barred = true;
        continue;
      }
      differ = differ || limit(*one) != limit(taken);
      lowest = lower_limit(lowest, limit(*one));
    }
    if (barred) adaptations_.note("edge that some types of vehicles may not drive, by their maxSpeed: a road for the others; see --vehicle", id.span);
    if (differ) adaptations_.note("edge that types of vehicles may drive at different speeds: at the lowest; see --vehicle", id.span);
    return lowest;
  }

  // The properties of a node or edge for the type of vehicle that was asked for. Null if it has none for that type, which then may not
  // go there. If no type was asked for, those of the first type.
  const Json* properties(const Json& thing, const std::string& what, std::string_view v1, std::string_view v2) {
    for (const std::string_view key : {v1, v2}) {
      if (thing.find(key) == nullptr) continue;
      for (const Json* one : Fields(thing, what, diagnostics_).objects(key)) {
        if (choice_.vehicle.empty() || is_for(*one)) return one;
      }
    }
    return nullptr;
  }
  bool is_for(const Json& properties) {
    const auto fits = [this](const Json& type) {
      types_.insert(type.text);
      return type.text == choice_.vehicle;
    };
    if (const Json* type = properties.find("vehicleTypeId")) return fits(*type);
    const Json* types = properties.find("mobileRobotTypes");
    if (types == nullptr) return false;
    for (const Json& type : types->parts) {
      const Json* series = type.find("seriesName");
      if (series != nullptr && fits(*series)) return true;
    }
    return false;
  }

  void read_node(const Json& node, Layout& layout) {
    const Json* id = Fields(node, "the node", diagnostics_).want("nodeId", Json::Kind::kString);
    if (id == nullptr) return;
    if (id->text.empty()) diagnostics_.report(Kind::kLayoutMissing, id->span, {"the node", "nodeId"});
    if (!choice_.vehicle.empty() && properties(node, "the node", "vehicleTypeNodeProperties", "mobileRobotTypeNodeProperties") == nullptr) {
      barred_.insert(id->text);
      return;
    }
    const Fields fields(node, fmt::format("node `{}`", id->text), diagnostics_);
    const Json* position = fields.want("nodePosition", Json::Kind::kObject);
    if (position == nullptr) return;
    const Json* name = fields.may("nodeName", Json::Kind::kString);
    const Json* map = fields.may("mapId", Json::Kind::kString);
    Place& place = layout.places.emplace_back(Place{id->text, name == nullptr ? "" : name->text, read_point(*position, "the position"), id->span});
    if (map != nullptr) place.map = map->text;
  }

  // A station without an id or nodes is passed over in silence: what names it as a stop gets a message.
  void read_station(const Json& station, Layout& layout) {
    const Fields fields(station, "the station", diagnostics_);
    const Json* id = fields.may("stationId", Json::Kind::kString);
    const Json* nodes = fields.may("interactionNodeIds", Json::Kind::kList);
    if (id == nullptr || nodes == nullptr) return;
    Station& read = layout.stations.emplace_back(Station{id->text, {}});
    for (const Json& node : nodes->parts) read.places.push_back(node.text);
  }

  Point read_point(const Json& point, std::string what) {
    const Fields fields(point, std::move(what), diagnostics_);
    return {fields.number("x"), fields.number("y")};
  }

  void read_edge(const Json& edge, const PlaceIndex& places, Layout& layout) {
    const Json* of_vehicle = properties(edge, "the edge", "vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties");
    if (!choice_.vehicle.empty() && of_vehicle == nullptr) return;
    const Json* id = Fields(edge, "the edge", diagnostics_).want("edgeId", Json::Kind::kString);
    if (id == nullptr) return;
    const Fields fields(edge, fmt::format("edge `{}`", id->text), diagnostics_);
    const Json* from = fields.want("startNodeId", Json::Kind::kString);
    const Json* to = fields.want("endNodeId", Json::Kind::kString);
    if (from == nullptr || to == nullptr) return;
    if (barred_.contains(from->text) || barred_.contains(to->text)) {
      return adaptations_.note("edge to a node that is not for this type of vehicle: left out", id->span);
    }
    if (!edges_.insert(id->text).second) adaptations_.note("edge with the `edgeId` of another one: an order that means it may be taken to mean that one", id->span);
    Way way{id->text, from->text, to->text, {}, false, from->span, to->span};
    if (of_vehicle != nullptr) {
      if (choice_.vehicle.empty()) note_other_trajectories(edge, *of_vehicle, id->span);
      if (!may_drive(*of_vehicle, *id)) return;
      note_restrictions(*of_vehicle);
      way.limit_m_s = limit_on(edge, *of_vehicle, *id);
      way.marked = is_marked(edge, *of_vehicle);
      if (const Json* trajectory = of_vehicle->find("trajectory")) {
        way.through = read_trajectory(*trajectory, places.find(way.from), places.find(way.to));
      }
    }
    layout.ways.push_back(std::move(way));
  }

  /// False with an error if nobody may drive the edge: it cannot become a road, and its author should say what was meant.
  bool may_drive(const Json& of_vehicle, const Json& id) {
    const Fields fields(of_vehicle, fmt::format("edge `{}`", id.text), diagnostics_);
    const Json* speed = fields.may("maxSpeed", Json::Kind::kNumber);
    if (speed != nullptr && !layout::may_drive(speed->number)) {
      diagnostics_.report(Kind::kLayoutBarred, speed->span, {id.text, fmt::format("its `maxSpeed` is {}", speed->text)});
      return false;
    }
    const Json* load = fields.may("loadRestriction", Json::Kind::kObject);
    if (load == nullptr) return true;
    const Fields loads(*load, fmt::format("the `loadRestriction` of edge `{}`", id.text), diagnostics_);
    std::ignore = loads.may("loaded", Json::Kind::kBool);
    std::ignore = loads.may("unloaded", Json::Kind::kBool);
    if (!is_false(*load, "loaded") || !is_false(*load, "unloaded")) return true;
    diagnostics_.report(Kind::kLayoutBarred, load->span, {id.text, "neither loaded nor unloaded"});
    return false;
  }

  static bool is_false(const Json& object, std::string_view key) {
    const Json* part = object.find(key);
    return part != nullptr && part->kind == Json::Kind::kBool && part->text == "false";
  }

  // Reports restrictions on who may drive there, and how, that a map cannot express.
  void note_restrictions(const Json& of_vehicle) {
    for (const std::string_view key : {"maxRotationSpeed", "minHeight", "maxHeight", "mobileRobotOrientations"}) {
      if (const Json* part = of_vehicle.find(key)) note_left_out(key, *part);
    }
    for (const std::string_view key : {"rotationAllowed", "reentryAllowed"}) {
      if (is_false(of_vehicle, key)) note_left_out(key, *of_vehicle.find(key));
    }
    for (const std::string_view key : {"rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed"}) {
      if (const Json* part = of_vehicle.find(key); part != nullptr && part->text != "BOTH") note_left_out(key, *part);
    }
    const Json* orientation = of_vehicle.find("vehicleOrientation");
    const Json* type = of_vehicle.find("orientationType");
    const bool forwards = (orientation == nullptr || orientation->number == 0.0) && (type == nullptr || type->text != "GLOBAL");
    if (orientation != nullptr && !forwards) note_left_out("vehicleOrientation", *orientation);
    const Json* load = of_vehicle.find("loadRestriction");
    if (load == nullptr) return;
    const bool restricts = is_false(*load, "loaded") || is_false(*load, "unloaded") || load->find("loadSetNames") != nullptr;
    if (restricts) note_left_out("loadRestriction", *load);
  }
  void note_left_out(std::string_view key, const Json& part) { adaptations_.note(fmt::format("{} of an edge: left out", key), part.span); }

  // If one type of vehicle has a line on the floor, the line is there for all types.
  bool is_marked(const Json& edge, const Json& of_vehicle) const {
    constexpr std::string_view kLine = "physicalLineGuidedProperty";
    const Json* all = edge.find("mobileRobotTypeEdgeProperties");
    if (!choice_.vehicle.empty() || all == nullptr) return of_vehicle.find(kLine) != nullptr;
    return std::any_of(all->parts.begin(), all->parts.end(), [&](const Json& one) { return one.find(kLine) != nullptr; });
  }

  std::vector<Point> read_trajectory(const Json& trajectory, const Place* from, const Place* to) {
    const Fields fields(trajectory, "the trajectory", diagnostics_);
    Spline spline;
    const Json* degree = fields.may("degree", Json::Kind::kNumber);   // the default is 3
    const double asked = degree == nullptr ? 3.0 : fields.count("degree");
    spline.degree = asked >= 1.0 && asked <= 16.0 ? static_cast<std::size_t>(asked) : 0;
    for (const Json* point : fields.objects("controlPoints")) {
      spline.points.push_back(read_point(*point, "the control point"));
      const Json* weight = Fields(*point, "the control point", diagnostics_).may("weight", Json::Kind::kNumber);
      spline.weights.push_back(weight == nullptr ? 1.0 : weight->number);
    }
    if (const Json* knots = fields.want("knotVector", Json::Kind::kList)) {
      for (const Json& knot : knots->parts) spline.knots.push_back(knot.number);
    }
    if (!is_sound(spline)) {
      adaptations_.note("trajectory that is no spline: the road is straight", trajectory.span);
      return {};
    }
    const auto [begin, end] = ends_of(spline);
    if (ends_at(begin, from) && ends_at(end, to)) return points_within(spline);
    adaptations_.note("trajectory that does not lead from its one node to the other: the road is straight", trajectory.span);
    return {};
  }

  const Choice& choice_;
  std::set<std::string> types_, barred_;   // types of vehicles that occur; nodes where the type asked for may not go
  std::set<std::string> edges_;            // the ids read
  Adaptations& adaptations_;
  diagnostics::Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Layout> read_lif(source::Sources& sources, source::FileId file, const Choice& choice, Adaptations& adaptations,
                               diagnostics::Diagnostics& diagnostics) {
  const auto root = read_json(sources, file, diagnostics);
  if (!root) return std::nullopt;
  auto layout = LifReader(choice, adaptations, diagnostics).run(*root);
  return diagnostics.failed() ? std::nullopt : layout;
}

}  // namespace kb::layout
