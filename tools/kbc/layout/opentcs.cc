// Plant models of openTCS, versions 4 to 7: points and paths, in millimetres.
#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <type_traits>
#include <unordered_set>
#include <utility>

#include "compiler/source/numbers.h"
#include "tools/kbc/layout/curve.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

/// Bytes in UTF-16, UTF-32 or Latin-1 as UTF-8.
std::string as_utf8(std::string_view bytes, pugi::xml_encoding encoding) {
  const bool in_16 = encoding == pugi::encoding_utf16_le || encoding == pugi::encoding_utf16_be;
  const bool big = encoding == pugi::encoding_utf16_be || encoding == pugi::encoding_utf32_be;
  const std::size_t size = in_16 ? 2 : encoding == pugi::encoding_latin1 ? 1 : 4;
  const auto unit = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + (big ? i : size - 1 - i)]);
    return value;
  };
  std::wstring out;
  for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
    std::uint32_t c = unit(at);
    if (in_16 && (c & 0xFC00) == 0xD800 && at + 4 <= bytes.size()) {   // the first half of a surrogate pair
      at += size;
      c = 0x10000 + ((c & 0x3FF) << 10 | (unit(at) & 0x3FF));
    }
    if (c <= 0x10FFFF) out += static_cast<wchar_t>(c);
  }
  return pugi::as_utf8(out);
}

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Fault {
  std::uint32_t at;   ///< offset in bytes
  const char* what;
};

/// Where a file in UTF-8 stops being XML. pugixml passes over much that XML forbids: an attribute twice, text behind the root, an entity
/// that nobody has declared. So expat looks at it as well.
std::optional<Fault> find_fault(std::string_view bytes, const pugi::xml_parse_result& result) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(XML_ParserCreate("UTF-8"), &XML_ParserFree);
  if (XML_Parse(parser.get(), bytes.data(), static_cast<int>(bytes.size()), XML_TRUE) == XML_STATUS_ERROR) {
    return Fault{static_cast<std::uint32_t>(XML_GetCurrentByteIndex(parser.get())), XML_ErrorString(XML_GetErrorCode(parser.get()))};
  }
  if (!result) return Fault{static_cast<std::uint32_t>(result.offset), result.description()};
  return std::nullopt;
}

class OpentcsReader {
 public:
  OpentcsReader(source::FileId file, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics)
      : file_(file), adaptations_(adaptations), diagnostics_(diagnostics) {}

  std::optional<Layout> run(const pugi::xml_node& model) {
    Layout layout;
    layout.name = model.attribute("name").value();
    const pugi::xml_node drawing = model.child("visualLayout");
    mm_for_x_ = drawing.attribute("scaleX").as_double();
    mm_for_y_ = drawing.attribute("scaleY").as_double();
    for (const pugi::xml_node& element : drawing.children("modelLayoutElement")) note_older_curve(element);
    for (const pugi::xml_node& point : model.children("point")) read_point(point, layout);
    const PlaceIndex places(layout.places);
    for (const pugi::xml_node& path : model.children("path")) read_path(path, places, layout);
    for (const pugi::xml_node& location : model.children("location")) read_location(location, layout);
    if (diagnostics_.failed()) return std::nullopt;
    return layout;
  }

 private:
  [[nodiscard]] source::Span span_of(const pugi::xml_node& node) const {
    const auto at = static_cast<std::uint32_t>(node.offset_debug());   // where the name of the element begins, behind `<`
    return {file_, at, at + static_cast<std::uint32_t>(std::string_view(node.name()).size())};
  }

  std::string text(const pugi::xml_node& node, const char* key, std::string_view what) {
    const pugi::xml_attribute attribute = node.attribute(key);
    if (!attribute || *attribute.value() == '\0') diagnostics_.report(Kind::kLayoutMissing, span_of(node), {what, key});
    return attribute.value();
  }

  double number(const pugi::xml_node& node, const char* key, std::string_view what) {
    const std::string value = text(node, key, what);
    double number = 0.0;
    if (!value.empty() && !source::read_number(value, number)) {
      diagnostics_.report(Kind::kLayoutWrongKind, span_of(node), {key, what, "a number", fmt::format("`{}`", value)});
    }
    return number;
  }

  // How fast a path may be driven in the direction that the key is about, m/s. A speed of 0 forbids it.
  double speed(const pugi::xml_node& path, const char* key, double unsaid, std::string_view what) {
    return path.attribute(key) ? number(path, key, what) / 1000.0 : unsaid;
  }

  double metres(const pugi::xml_node& node, const char* key, const char* older, std::string_view what) {
    return number(node, !node.attribute(key) && node.attribute(older) ? older : key, what) / 1000.0;
  }

  Point place_of(const pugi::xml_node& node, std::string_view what) {
    return {metres(node, "positionX", "xPosition", what), metres(node, "positionY", "yPosition", what)};
  }

  // Reports a curved path of a model older than 0.0.4, which lists how paths are drawn apart from the paths.
  void note_older_curve(const pugi::xml_node& element) {
    for (const pugi::xml_node& property : element.children("property")) {
      const std::string_view value = property.attribute("value").value();
      const bool curve = property.attribute("name").value() == std::string_view("CONN_TYPE") && (value.starts_with("BEZIER") || value == "POLYPATH");
      if (curve) adaptations_.note(fmt::format("path drawn as `{}` in a model older than 0.0.4: straight", value), span_of(element));
    }
  }

  void read_point(const pugi::xml_node& point, Layout& layout) {
    const std::string id = text(point, "name", "the point"), what = fmt::format("point `{}`", id);
    layout.places.push_back({id, "", place_of(point, what), span_of(point)});
    const pugi::xml_node drawn = point.child("pointLayout");   // has no place of its own in version 7
    const bool placed = drawn.attribute("positionX") || drawn.attribute("xPosition");
    if (placed && !ends_at(place_of(drawn, "the layout of the point"), &layout.places.back())) drawn_elsewhere_.insert(id);
  }

  void read_path(const pugi::xml_node& path, const PlaceIndex& places, Layout& layout) {
    const std::string id = path.attribute("name").value(), what = fmt::format("path `{}`", id);
    const source::Span span = span_of(path);
    Way way{id, text(path, "sourcePoint", what), text(path, "destinationPoint", what), {}, false, span, span};
    const double ahead_m_s = speed(path, "maxVelocity", kNoLimit, what), back_m_s = speed(path, "maxReverseVelocity", 0.0, what);
    const bool ahead = may_drive(ahead_m_s), back = may_drive(back_m_s);
    if (path.attribute("locked").as_bool()) return adaptations_.note("path that is locked: left out", span);
    if (!ahead && !back) return adaptations_.note("path that may be driven in neither direction, by its speeds: left out", span);
    way.through = read_bends(path.child("pathLayout"), places.find(way.from), places.find(way.to));
    if (!way.through.empty() && (drawn_elsewhere_.contains(way.from) || drawn_elsewhere_.contains(way.to))) {
      adaptations_.note("path whose ends are drawn elsewhere than they lie: straight", span);
      way.through.clear();
    }
    way.limit_m_s = limit_of(ahead_m_s);
    if (ahead) layout.ways.push_back(way);
    if (!back) return;
    adaptations_.note(ahead ? "path that is driven back in reverse: a road both ways" : "path that is driven in reverse only: a road against its direction", span);
    std::swap(way.from, way.to);
    std::reverse(way.through.begin(), way.through.end());
    way.limit_m_s = limit_of(back_m_s);
    layout.ways.push_back(std::move(way));
  }

  static void read_location(const pugi::xml_node& location, Layout& layout) {
    Station& read = layout.stations.emplace_back(Station{location.attribute("name").value(), {}});
    for (const pugi::xml_node& link : location.children("link")) read.places.emplace_back(link.attribute("point").value());
  }

  // The bends of a path. Its control points are in units of the drawing, whose y axis points down.
  std::vector<Point> read_bends(const pugi::xml_node& drawn, const Place* from, const Place* to) {
    std::vector<Point> points;
    for (const pugi::xml_node& point : drawn.children("controlPoint")) {
      points.push_back({number(point, "x", "the control point") * mm_for_x_ / 1000.0, -number(point, "y", "the control point") * mm_for_y_ / 1000.0});
    }
    if (points.empty()) return {};
    const std::string_view type = drawn.attribute("connectionType").value();
    const bool scaled = mm_for_x_ > 0.0 && mm_for_y_ > 0.0;
    if (scaled && type == "POLYPATH") return points;
    const bool bezier_curve = type.starts_with("BEZIER"), full = points.size() % 3 == 2;   // two between each end and the next
    if (!scaled || !bezier_curve || !full || from == nullptr || to == nullptr) {
      const std::string why = !scaled ? ", and the drawing has no scale" : bezier_curve && !full ? fmt::format(", with {} control points", points.size()) : "";
      adaptations_.note(fmt::format("path drawn as `{}`{}: straight", type, why), span_of(drawn));
      return {};
    }
    points.insert(points.begin(), from->at);
    points.push_back(to->at);
    return points_within(bezier(std::move(points)));
  }

  source::FileId file_;
  Adaptations& adaptations_;
  diagnostics::Diagnostics& diagnostics_;
  double mm_for_x_ = 0.0, mm_for_y_ = 0.0;
  std::unordered_set<std::string> drawn_elsewhere_;   // points that the drawing shows elsewhere, so that bends of paths there are of no use
};

}  // namespace

std::optional<Layout> read_opentcs(source::Sources& sources, source::FileId file, const Choice&, Adaptations& adaptations,
                                   diagnostics::Diagnostics& diagnostics) {
  pugi::xml_document document;
  const auto load = [&](pugi::xml_encoding encoding) {
    const std::string_view bytes = sources.bytes(file);
    return document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, encoding);
  };
  pugi::xml_parse_result result = load(pugi::encoding_auto);
  if (result.encoding != pugi::encoding_utf8) {   // the library counts offsets in its own UTF-8 form of the file
    file = sources.add(std::string(sources.path(file)), as_utf8(sources.bytes(file), result.encoding));
    result = load(pugi::encoding_utf8);
  }
  if (const std::optional<Fault> fault = find_fault(sources.bytes(file), result)) {
    diagnostics.report(Kind::kLayoutSyntax, {file, fault->at, fault->at + 1}, {"XML", fault->what});
    return std::nullopt;
  }
  const pugi::xml_node model = document.child("model");
  if (!model) {
    diagnostics.report(Kind::kLayoutMissing, {file, 0, 0}, {"the file", "model"});
    return std::nullopt;
  }
  return OpentcsReader(file, adaptations, diagnostics).run(model);
}

}  // namespace kb::layout
