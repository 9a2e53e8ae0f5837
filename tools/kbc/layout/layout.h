// Turns layouts of plants, as other programs write them, into maps: the Layout Interchange Format of the VDMA (LIF), the route
// graphs of Nav2, the plant models of openTCS.
//
//   bytes --read_lif, read_nav2, read_opentcs--> Layout --joined--> Layout --roads_of, landmark_names--> Map --write_map--> text of a `.kb`
//   stops --mission_by_stops--> Mission --write_mission--> more of that text
//   order --mission_of_order--> Mission
//   node, edge --Edges (edges.h)--> Visits
//   Layout --write_lif--> bytes
//
// A layout is places and the ways between them. Anything else in a file (loads, actions, costs) is left out; if that changes where a
// robot can drive, it is reported (KB1412, -Wlayout-adapted).
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
#include "compiler/model/speed.h"
#include "compiler/source/source.h"

namespace kb::layout {

/// In metres of the layout; x to the east, y to the north.
struct Point {
  double x_m = 0.0, y_m = 0.0;
  friend bool operator==(const Point&, const Point&) = default;
};
inline double distance(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

/// A speed limit as read, of a way that may be driven; 0, no limit, if nothing on wheels is faster.
inline double limit_of(double m_s) { return m_s < 1000.0 ? m_s : 0.0; }
/// Whether a way with this limit can be driven at all.
inline bool may_drive(double limit_m_s) { return limit_m_s >= model::kSlowest_m_per_s; }

/// The lower one of two limits, of which 0 is none.
inline double lower_limit(double a, double b) { return a == 0.0 || (b > 0.0 && b < a) ? b : a; }

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
  std::vector<Point> through;     ///< its bends, without its ends
  bool marked = false;            ///< there is a line on the floor, whatever method the user gives for all roads
  source::Span from_span, to_span;
  double limit_m_s = 0.0;         ///< the fastest that it may be driven; 0: no limit
  bool goes_on = false;           ///< the next way in Layout::ways continues it (joined)
  std::string method = {};        ///< how it is driven, if the layout comes from a map: `mark`, `dist`
};

/// Where vehicles load and unload: not a place, but another name for the places at which it is served.
struct Station {
  std::string id;
  std::vector<std::string> places;   ///< their ids; for some there may be no place
};

struct Layout {
  std::string name;               ///< of the layout or the model; may be empty
  std::vector<Place> places;
  std::vector<Way> ways;
  std::vector<Station> stations = {};  ///< LIF's stations, openTCS's locations
};

/// What to take from a file with several plants or kinds of vehicle.
struct Choice {
  std::string layout;    ///< LIF: the id of a layout; empty: the only one
  std::string vehicle;   ///< LIF: only what this type of vehicle may use; empty: all
};

/// Ways and places that could not be taken over as they are: counted by kind, and reported once for each kind.
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

/// The layout in `file`; nothing if it cannot be read as such (reported, KB14xx). Whether ways lead to places is not checked
/// here. A file that is not in UTF-8 is added to the sources again, as UTF-8, for messages. Linear in the file.
using Reader = std::optional<Layout> (*)(source::Sources& sources, source::FileId file, const Choice& choice,
                                         Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_lif(source::Sources& sources, source::FileId file, const Choice& choice,
                                             Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_nav2(source::Sources& sources, source::FileId file, const Choice& choice,
                                              Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);
[[nodiscard]] std::optional<Layout> read_opentcs(source::Sources& sources, source::FileId file, const Choice& choice,
                                                 Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// What stands in a LIF file beside the layout.
struct LifHead {
  std::string map;         ///< the id of the layout and of its map
  std::string vehicle;     ///< the type of vehicle for which nodes and edges are
  std::string timestamp;   ///< when the file was made, ISO 8601
};
/// The layout as LIF 1.0, which read_lif reads again. Ways must lead between its places. `method` becomes a description, for LIF has no
/// word for it. Linear in the layout.
[[nodiscard]] std::string write_lif(const Layout& layout, const LifHead& head);

/// Warns (KB1421) if its ways are so short or so long that its places can hardly be in metres. There is a place. O(ways).
void warn_of_units(const Layout& layout, diagnostics::Diagnostics& diagnostics);

/// The same with one place for each spot, and with ways split where they run over a place (within 15 cm). Nothing if they run over places
/// more than 300,000 times (reported). O(ways log places) if places and ways are few in any strip of the layout.
[[nodiscard]] std::optional<Layout> joined(Layout layout, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// The sides by which roads leave a landmark: clockwise from the north, by 45 degrees.
inline constexpr std::string_view kSides[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
inline constexpr std::uint32_t kSideCount = 8;

/// How many sides two directions are apart; at most half of all sides.
inline double sides_apart(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, kSideCount - d);
}

/// A road of the map. Ways there and back on the same ground are one road.
struct Road {
  std::uint32_t from = 0, to = 0;     ///< indexes of Layout::places
  bool both = false;                  ///< it can be driven both ways
  std::vector<Point> through;
  bool marked = false;
  std::uint32_t exit = 0, approach = 0;   ///< indexes of kSides: where it leaves `from`, and where it reaches `to`
  double limit_m_s = 0.0;             ///< the lowest of its ways; 0: no limit

  /// The side by which it leaves place `a` for place `b`; nothing if it does not lead there.
  [[nodiscard]] std::optional<std::uint32_t> leads(std::uint32_t a, std::uint32_t b) const {
    if (from == a && to == b) return exit;
    return both && to == a && from == b ? std::optional(approach) : std::nullopt;
  }
};

/// The roads of a layout, in the order of its ways, with their sides: each road of a place gets a side of its own, in the order of their
/// directions, so that the directions change least in sum. Nothing if a way leads to no place, two places have one id, something lies
/// out of bounds, or more than eight roads meet (reported). O(ways log ways).
[[nodiscard]] std::optional<std::vector<Road>> roads_of(const Layout& layout, Adaptations& adaptations,
                                                        diagnostics::Diagnostics& diagnostics);

/// How a knowledge base words the layout.
struct Wording {
  std::string file;             ///< the file that it was made from, for the comment at its head
  std::string format;
  std::string map = "Plant";
  std::string method = "mark";  ///< how roads are driven that have no method of their own
  std::string prefix = "LM";    ///< put before an id that cannot be a name
  std::string_view controllers;   ///< of a mission: `control` statements
  std::function<bool(std::string_view)> taken;   ///< whether a name is taken already; may be empty
};

/// A name of the language for each place, in order; no two are the same.
[[nodiscard]] std::vector<std::string> landmark_names(const Layout& layout, const Wording& wording);

/// A layout that has become a map.
struct Map {
  Layout layout;
  std::vector<Road> roads;
  std::vector<std::string> names;   ///< of landmarks, one for each of Layout::places
};

/// The map as a knowledge base that imports what it needs from the standard library; not yet in the canonical layout.
[[nodiscard]] std::string write_map(const Map& map, const Wording& wording);

/// A landmark of a mission.
struct Visit {
  std::uint32_t place = 0;   ///< index of Layout::places
  std::uint32_t exit = 0;    ///< index of kSides: the road by which the robot goes on; meaningless in the last visit
  double limit_m_s = 0.0;    ///< how fast an order lets it drive that road; 0: as fast as the road allows
};

struct Mission {
  std::vector<Visit> visits;   ///< at least one; from each a road leads to the next
  std::string order;           ///< a description of its order; empty: none
  bool alone = false;          ///< the map has only its roads, so there are no ways round
};

/// The mission from each of `stops` to the next by the shortest way in metres. Stops, at least one, are ids of places, names of landmarks,
/// or ids of stations served at one place. Nothing if a stop is none of these or cannot be reached (reported). Searches the whole map for
/// each stop.
[[nodiscard]] std::optional<Mission> mission_by_stops(const Map& map, std::span<const std::string> stops, diagnostics::Diagnostics& diagnostics);

/// The order of a fleet's master (VDA 5050, 2.x and 3.x, JSON) in `file`: its nodes in sequence, by exactly its edges, as far as they are
/// released. Nothing if it is no order, or its nodes and edges are not in the layout (reported). O((order + layout) log layout).
[[nodiscard]] std::optional<Mission> mission_of_order(const source::Sources& sources, source::FileId file, const Map& map,
                                                      Adaptations& adaptations, diagnostics::Diagnostics& diagnostics);

/// Gives roads the lower limits that an order sets for them.
void take_limits(const Mission& mission, Map& map);

/// Whether there is a way round any road of the mission: then detours can be planned for it. O(visits * roads * map) at worst.
[[nodiscard]] bool has_way_round(const Map& map, const Mission& mission);

/// The part of a map that a mission needs: its landmarks and roads and, if none of these leads to the first landmark, one that does, the
/// straightest into the mission. Visits are renumbered.
[[nodiscard]] std::pair<Map, Mission> trimmed(const Map& map, const Mission& mission);

/// The mission as a `route` on that map, and a controller for each strategy that drives. Detours are planned where there are ways
/// round, except for an order, whose master plans them.
[[nodiscard]] std::string write_mission(const Mission& mission, const Map& map, const Wording& wording);

}  // namespace kb::layout
