// Layouts of plants, as other programs write them, become maps: the Layout Interchange Format of the VDMA (LIF), the route
// graphs of Nav2, the plant models of openTCS.
//
//   bytes --read_lif, read_nav2, read_opentcs--> Layout --joined--> Layout --roads_of, landmark_names--> Map --write_map--> text of a `.kb`
//   stops --mission_by_stops--> Mission --write_mission--> more of that text
//   order --mission_of_order--> Mission
//   node, edge --Edges (edges.h)--> Visits
//
// A layout is places and the ways between them. What else a file holds (loads, actions, costs) is left out; what
// would change where a robot can drive is told when it is (KB1412, -Wlayout-adapted).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"

namespace kb::layout {

/// In metres of the layout; x to the east, y to the north.
struct Point {
  double x_m = 0.0, y_m = 0.0;
  friend bool operator==(const Point&, const Point&) = default;
};
inline double distance(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

struct Place {
  std::string id;         ///< as the file calls it
  std::string called;     ///< a name for people, if it has one
  Point at;
  source::Span span;      ///< of its id
  std::vector<std::string> also = {};   ///< ids of places at the same spot (joined)
  std::string map = {};   ///< the id of the map that its position is on; empty: the file does not say
};

/// One way: it can be driven from `from` to `to`, not back.
struct Way {
  std::string id;                 ///< for messages; may be empty
  std::string from, to;           ///< ids of places
  std::vector<Point> through;     ///< where it bends, without its ends
  bool marked = false;            ///< there is a line on the floor, whatever the user says of all roads
  source::Span from_span, to_span;
  bool goes_on = false;           ///< the way behind it in Layout::ways is the rest of it (joined)
};

/// Where vehicles load and unload: no place of its own, but another name for the places at which it is served.
struct Station {
  std::string id;
  std::vector<std::string> places;   ///< their ids; of some there may be no place
};

struct Layout {
  std::string name;               ///< of the layout or the model; may be empty
  std::vector<Place> places;
  std::vector<Way> ways;
  std::vector<Station> stations = {};  ///< LIF's stations, openTCS's locations
};

/// What is taken of a file that holds more than one plant or kind of vehicle.
struct Choice {
  std::string layout;    ///< LIF: the id of a layout; empty: the only one
  std::string vehicle;   ///< LIF: only what this type of vehicle may use; empty: all
};

/// What a road would be if it were taken as it stands, counted for each kind of thing, and told once.
class Adaptations {
 public:
  /// `what` in words: "path that is locked: left out".
  void note(std::string_view what, source::Span at);
  void report(diagnostics::Diagnostics& diagnostics) const;

 private:
  struct One {
    std::string what;
    source::Span first;
    std::uint64_t times;
  };
  std::vector<One> all_;
  std::unordered_map<std::string, std::size_t> index_;   // of what is noted
};

/// The layout in `file`; nothing if it cannot be read as such (reported, KB14xx). Whether ways lead to places is not asked here.
/// A file that is not in UTF-8 is added to the sources once more, as UTF-8, for messages. Linear in the file.
using Reader = std::optional<Layout> (*)(source::Sources& sources, source::FileId file, const Choice& choice,
                                         Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_lif(source::Sources& sources, source::FileId file, const Choice& choice,
                                             Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_nav2(source::Sources& sources, source::FileId file, const Choice& choice,
                                              Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_opentcs(source::Sources& sources, source::FileId file, const Choice& choice,
                                                 Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// The same with one place for each spot, and with ways that end where they run over a place, to 15 cm, and go on from there. Nothing
/// if they run over places more than 300,000 times (reported). Where places and ways are few in any strip of the layout
/// O(ways log places).
[[nodiscard]] std::optional<Layout> joined(Layout layout, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// The sides by which roads leave a landmark: clockwise from the north, by 45 degrees.
inline constexpr std::string_view kSides[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
inline constexpr std::uint32_t kSideCount = 8;

/// How far two directions, given in sides, are apart; at most half of them.
inline double sides_apart(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, kSideCount - d);
}

/// A road of the map. What leads there and back on the same ground is one.
struct Road {
  std::uint32_t from = 0, to = 0;     ///< indexes of Layout::places
  bool both = false;                  ///< it can be driven back as well
  std::vector<Point> through;
  bool marked = false;
  std::uint32_t exit = 0, approach = 0;   ///< indexes of kSides: where it leaves `from`, and where it reaches `to`

  /// The side by which it leaves a place for another one; nothing if it does not.
  [[nodiscard]] std::optional<std::uint32_t> leads(std::uint32_t a, std::uint32_t b) const {
    if (from == a && to == b) return exit;
    return both && to == a && from == b ? std::optional(approach) : std::nullopt;
  }
};

/// The roads of a layout, in the order of its ways, with their sides: each road of a place gets one of its own, in the order of
/// their directions, so that all together are turned least. Nothing if a way leads to no place, two places have one id, something
/// lies out of all bounds, or more than eight roads meet (reported). O(ways log ways).
[[nodiscard]] std::optional<std::vector<Road>> roads_of(const Layout& layout, Adaptations& adaptations,
                                                        diagnostics::Diagnostics& diagnostics);

/// What a knowledge base says of the layout.
struct Wording {
  std::string file;             ///< what it was made of, for the comment at its head
  std::string format;
  std::string map = "Plant";
  std::string method = "mark";  ///< how roads are driven that do not say it themselves
  std::string prefix = "LM";    ///< stands before an id that cannot be a name
  std::string_view controllers;   ///< of a mission: `control` statements
  std::function<bool(std::string_view)> taken;   ///< whether a name stands for something else already; may be empty
};

/// A name of the language for each place, in their order; no two are the same.
[[nodiscard]] std::vector<std::string> landmark_names(const Layout& layout, const Wording& wording);

/// A layout that has become a map.
struct Map {
  Layout layout;
  std::vector<Road> roads;
  std::vector<std::string> names;   ///< of landmarks, one for each of Layout::places
};

/// The map as a knowledge base that imports what it needs of the standard library; not yet in the canonical layout.
[[nodiscard]] std::string write_map(const Map& map, const Wording& wording);

/// A landmark of a mission.
struct Visit {
  std::uint32_t place = 0;   ///< index of Layout::places
  std::uint32_t exit = 0;    ///< index of kSides: by which of its roads the robot goes on; of the last one without meaning
};

struct Mission {
  std::vector<Visit> visits;   ///< one at least; from each a road leads to the next
  std::string order;           ///< which order it is, in words; empty: none
  bool alone = false;          ///< the map has its roads only: no way leads round any
};

/// From each of `stops` (ids of places, names of landmarks, or ids of stations that are served at one place; one at least) to the next by
/// the shortest way in metres. Nothing if a stop is none of these or cannot be reached (reported). A search over the whole map for each stop.
[[nodiscard]] std::optional<Mission> mission_by_stops(const Map& map, std::span<const std::string> stops, diagnostics::Diagnostics& diagnostics);

/// The order of a fleet's master (VDA 5050, 2.x and 3.x, JSON) in `file`: its nodes in their sequence, by exactly its edges, as far as they
/// are released. Nothing if that is none, or its nodes and edges are none of the layout (reported). O((order + layout) log layout).
[[nodiscard]] std::optional<Mission> mission_of_order(const source::Sources& sources, source::FileId file, const Map& map,
                                                      Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// What a mission needs of a map: its landmarks, its roads, and, where none of these leads to the first landmark, one that does, as straight
/// on into the mission as there is. Visits are numbered anew.
[[nodiscard]] std::pair<Map, Mission> trimmed(const Map& map, const Mission& mission);

/// The mission as a `route` on that map, and a controller for each strategy that drives. With planned detours, but not for an order:
/// ways round are its master's to plan.
[[nodiscard]] std::string write_mission(const Mission& mission, const Map& map, const Wording& wording);

}  // namespace kb::layout
