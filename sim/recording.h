// The record of one drive, from which the page, the pictures and the tables are made. Readers of a recording do not need the
// simulator, and writers need not know its uses.
//
// Units: metres, seconds, radians counter-clockwise from east; x to the east, y to the north.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <waymark/controllers/senses.h>

namespace kb::sim {

struct Spot { double x_m = 0.0, y_m = 0.0; };
struct Pose { double x_m = 0.0, y_m = 0.0, heading_rad = 0.0; };

/// What the floor looks like from above. Fixed for a drive; changes are in the frames.
struct Picture {
  enum class Kind : std::uint8_t { kMark, kDist, kAzimuth, kOpen };
  struct Landmark { std::string name; Spot at; };
  struct Road { std::string name; std::string from, to; Kind kind{}; double width_m = 0.0; std::vector<Spot> along; };
  struct Stroke { Spot from, to; double width_m = 0.0; };   ///< paint on the floor: a line to follow, a stop line
  struct Wall { Spot from, to; };
  struct Hall { double width_m = 0.0; std::vector<Spot> along; };   ///< from door to door
  std::vector<Landmark> landmarks;
  std::vector<Road> roads;                ///< each road once, also when it goes both ways
  std::vector<Hall> halls;                ///< those that roads of the kind kOpen cross
  std::vector<std::vector<Spot>> blocks;  ///< things built into halls: their corners in order
  std::vector<Stroke> lines, stop_lines;
  std::vector<Wall> walls;
  Spot low, high;                         ///< the corners of all of it
  double robot_radius_m = 0.0;
};

/// The cells of the knowledge base that drives, in the order of the frames' values.
///
/// Conditions, writes and groups are those of `program::Program`, copied: with them a page can tell for any tick why a rule
/// fired and which of its conditions did not hold. If they are empty, pages show only what happened.
struct MindNames {
  struct Cell {
    std::string name;
    enum class Kind : std::uint8_t { kFact, kSatellite, kStrategy } kind{};
    float initial = -1.0f;
    bool command = false;                 ///< facts: an operator's button
    bool keep = false;                    ///< satellites: `reset` leaves it alone
    std::string control{};                  ///< strategies: the controller, `follow_line(speed: 0.4 m/s)`
    std::vector<std::uint32_t> satellites{};  ///< facts and strategies: those that draw attention to it
    float plain = 0.75f, attended = 0.5f;   ///< facts: the thresholds, see `program::Thresholds`
  };
  /// `and` of none is true, `or` of none is false. Children stand before their parent.
  struct Condition {
    enum class Op : std::uint8_t { kAnd, kOr, kNot, kFor, kEvent, kLost, kSeen, kIs } op{};
    enum class Term : std::uint8_t { kLow, kZero, kHigh } term = Term::kHigh;   ///< of kIs
    std::uint32_t cell = 0;               ///< of kEvent, kLost, kSeen, kIs
    double duration_s = 0.0;              ///< of kFor
    std::vector<std::uint32_t> children{};  ///< of kAnd, kOr; one for kNot and kFor
  };
  struct Write { std::uint32_t cell = 0; float value = 0.0f; };
  struct Rule {
    std::string name;
    std::string level;
    std::string at;                       ///< file:line:col
    std::int32_t condition = -1;          ///< index into `conditions`, -1: not given
    std::vector<Write> writes{};            ///< each cell once, ascending; overrides `clears`, which overrides `reset`
    std::vector<std::uint32_t> clears{};    ///< indexes into `exclusive`: all members become -1
    bool reset = false;                   ///< every satellite not declared `keep` takes its initial value
    bool each_tick = false;               ///< `while`: fires at every tick at which its condition holds
  };
  std::vector<Cell> cells;
  std::vector<Rule> rules;
  std::vector<std::string> levels;        ///< the highest first
  std::vector<Condition> conditions;
  std::vector<std::vector<std::uint32_t>> exclusive;   ///< groups of which at most one member is high
  float firing = 0.5f;                    ///< the certainty from which a term holds
};

/// Something that stands on the floor at this moment and is not part of the picture.
struct Thing {
  enum class Kind : std::uint8_t { kObstacle, kClosedRoad, kLostMarking, kUnsafeCrossing } kind{};
  std::string name;
  Spot from, to;           ///< corners of its box, which it fills as an ellipse; the ends of the stretch
};

/// One tick of the mind.
struct Frame {
  struct Change { std::uint32_t cell = 0; float value = 0.0f; };
  double t_s = 0.0;
  Pose pose;
  mts::Senses senses;
  std::vector<Change> changed;            ///< cells whose value differs from the frame before (in the first frame: from `initial`)
  std::vector<std::uint32_t> events, lost;    ///< facts newly seen, and no longer seen
  std::vector<std::uint32_t> fired;       ///< rules, in order
  std::int32_t strategy = -1;             ///< index into the cells, -1: none
  std::string status;                     ///< as the trace says it: `ok`, `no_strategy`, ...
  std::string leg;                        ///< the current leg, "" without a mission
  std::vector<std::string> notes;         ///< what the scenario did, or what went wrong: `road LM7.E closed`
};

struct Recording {
  std::string title;                      ///< of the scenario; if it has none, the file of the knowledge base
  std::string outcome;                    ///< `arrived`, `stopped: Help.blocked`, ...
  Picture picture;
  MindNames names;
  std::vector<Frame> frames;
  /// The legs of the route and of its detours, by the names that the frames give them.
  struct Leg {
    std::string name, from, to;           ///< from landmark to landmark
    std::int32_t road = -1;               ///< index into the picture's roads, -1: the straight line
    bool detour = false;
  };
  std::vector<Leg> legs;
  /// Things, each with the frames [first, last) in which it stood there.
  struct Stay { Thing thing; std::uint32_t first = 0, last = 0; };
  std::vector<Stay> stays;
};

}  // namespace kb::sim
