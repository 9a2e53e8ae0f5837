// Route graphs of Nav2: GeoJSON whose points are nodes and whose lines are directed edges, in metres of the frame `map`.
#include <fmt/format.h>

#include <cmath>

#include "tools/kbc/layout/json.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

// Programs that edit graphs as tables sometimes write 1 as 1.0; Nav2 reads both as 1.
std::string id_of(const Json& number) {
  const bool whole = std::trunc(number.number) == number.number && std::abs(number.number) < 1e15;
  return whole ? fmt::format("{}", static_cast<std::int64_t>(number.number)) : number.text;
}

class Nav2Reader {
 public:
  Nav2Reader(Adaptations& adaptations, diagnostics::Diagnostics& diagnostics) : adaptations_(adaptations), diagnostics_(diagnostics) {}

  Layout run(const Json& root) {
    const Fields file(root, "the file", diagnostics_);
    Layout layout;
    if (const Json* name = file.may("name", Json::Kind::kString)) layout.name = name->text;
    const auto features = file.objects("features");
    for (const Json* feature : features) read_feature(*feature, layout);
    check_lines(layout);
    return layout;
  }

 private:
  void read_feature(const Json& feature, Layout& layout) {
    const Fields fields(feature, "the feature", diagnostics_);
    const Json* geometry = fields.want("geometry", Json::Kind::kObject);
    if (geometry == nullptr) return;
    const Fields shape(*geometry, "the geometry", diagnostics_);
    const Json* type = shape.want("type", Json::Kind::kString);
    if (type == nullptr) return;
    const bool point = type->text == "Point", line = type->text == "LineString" || type->text == "MultiLineString";
    if (!point && !line) {
      return adaptations_.note(fmt::format("`{}`, which is neither a node nor an edge: left out", type->text), type->span);
    }
    const Json* properties = fields.want("properties", Json::Kind::kObject);
    const Json* coordinates = point ? shape.want("coordinates", Json::Kind::kList) : shape.may("coordinates", Json::Kind::kList);
    if (properties == nullptr || (point && coordinates == nullptr)) return;
    if (point) return read_node(*properties, *coordinates, layout);
    // Files hold the points of a line directly, or in one more list, or have none: Nav2 itself reads only the ids of an edge.
    const bool deeper = coordinates != nullptr && coordinates->parts.size() == 1 && coordinates->parts[0].kind == Json::Kind::kList;
    read_edge(*properties, coordinates == nullptr ? Json{} : deeper ? coordinates->parts[0] : *coordinates, layout);
  }

  void read_node(const Json& properties, const Json& coordinates, Layout& layout) {
    const Json* id = Fields(properties, "the node", diagnostics_).want("id", Json::Kind::kNumber);
    if (id == nullptr) return;
    if (const auto at = read_point(coordinates)) layout.places.push_back({id_of(*id), "", *at, id->span});
  }

  void read_edge(const Json& properties, const Json& line, Layout& layout) {
    const Fields fields(properties, "the edge", diagnostics_);
    const Json* from = fields.want("startid", Json::Kind::kNumber);
    const Json* to = fields.want("endid", Json::Kind::kNumber);
    if (from == nullptr || to == nullptr) return;
    const Json* id = fields.may("id", Json::Kind::kNumber);
    Way way{id == nullptr ? "" : id_of(*id), id_of(*from), id_of(*to), {}, false, from->span, to->span};
    const bool pieces = !line.parts.empty() && !line.parts[0].parts.empty() && line.parts[0].parts[0].kind == Json::Kind::kList;
    if (pieces) adaptations_.note("edge of several lines: straight", from->span);
    for (std::size_t i = 0; !pieces && i < line.parts.size(); ++i) {
      if (const auto point = read_point(line.parts[i])) way.through.push_back(*point);
    }
    layout.ways.push_back(std::move(way));
  }

  // Reduces each line to its bends, if it leads from its first node to its last. Only now, since an edge may stand before its nodes.
  void check_lines(Layout& layout) {
    const PlaceIndex places(layout.places);
    for (Way& way : layout.ways) {
      std::vector<Point> line = std::move(way.through);
      way.through.clear();
      if (line.size() < 3) continue;
      if (ends_at(line.front(), places.find(way.from)) && ends_at(line.back(), places.find(way.to))) {
        way.through.assign(line.begin() + 1, line.end() - 1);
      } else {
        adaptations_.note("line that does not lead from its one node to the other: the road is straight", way.from_span);
      }
    }
  }

  std::optional<Point> read_point(const Json& point) {
    using K = Json::Kind;
    if (point.kind == K::kList && point.parts.size() >= 2 && point.parts[0].kind == K::kNumber && point.parts[1].kind == K::kNumber) {
      return Point{point.parts[0].number, point.parts[1].number};
    }
    diagnostics_.report(Kind::kLayoutWrongKind, point.span, {"coordinates", "the geometry", "two numbers", "something else"});
    return std::nullopt;
  }

  Adaptations& adaptations_;
  diagnostics::Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Layout> read_nav2(source::Sources& sources, source::FileId file, const Choice&, Adaptations& adaptations,
                                diagnostics::Diagnostics& diagnostics) {
  const auto root = read_json(sources, file, diagnostics);
  if (!root) return std::nullopt;
  Layout layout = Nav2Reader(adaptations, diagnostics).run(*root);
  if (diagnostics.failed()) return std::nullopt;
  return layout;
}

}  // namespace kb::layout
