// One drive, written down: what the page, the pictures and the tables are made from. Nobody who reads a recording needs the
// simulator, and nobody who writes one needs to know what it is for.
//
// Units: metres, seconds, radians counter-clockwise from east; x to the east, y to the north.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "controllers/senses.h"

namespace kb::sim {

struct Spot { double x_m = 0.0, y_m = 0.0; };
struct Pose { double x_m = 0.0, y_m = 0.0, heading_rad = 0.0; };

/// What the floor looks like from above. Fixed for a drive; what changes is among the frames.
struct Picture {
  enum class Kind : std::uint8_t { kMark, kDist, kAzimuth, kOpen };
  struct Landmark { std::string name; Spot at; };
  struct Road { std::string name; std::string from, to; Kind kind{}; double width_m = 0.0; std::vector<Spot> along; };
  struct Stroke { Spot from, to; double width_m = 0.0; };   ///< paint on the floor: a line to follow, a stop line
  struct Wall { Spot from, to; };
  std::vector<Landmark> landmarks;
  std::vector<Road> roads;                ///< each road once, also when it goes both ways
  std::vector<Stroke> lines, stop_lines;
  std::vector<Wall> walls;
  Spot low, high;                         ///< the corners of all of it
  double robot_radius_m = 0.0;
};

/// The cells of the knowledge base that drives, in the order of the frames' values.
struct MindNames {
  struct Cell {
    std::string name;
    enum class Kind : std::uint8_t { kFact, kSatellite, kStrategy } kind{};
    float initial = -1.0f;
  };
  struct Rule { std::string name; std::string level; std::string at; };   ///< `at`: file:line:col
  std::vector<Cell> cells;
  std::vector<Rule> rules;
  std::vector<std::string> levels;        ///< the highest first
};

/// Something that stands on the floor at this moment and is not part of the picture.
struct Thing {
  enum class Kind : std::uint8_t { kObstacle, kClosedRoad, kLostMarking, kUnsafeCrossing } kind{};
  std::string name;
  Spot from, to;           ///< corners of its box; the ends of the stretch
};

/// One tick of the mind.
struct Frame {
  struct Change { std::uint32_t cell = 0; float value = 0.0f; };
  double t_s = 0.0;
  Pose pose;
  mts::Senses senses;
  std::vector<Change> changed;            ///< cells whose value is another than in the frame before (the first: than `initial`)
  std::vector<std::uint32_t> events, lost;    ///< facts newly seen, and no longer seen
  std::vector<std::uint32_t> fired;       ///< rules, in order
  std::int32_t strategy = -1;             ///< index into the cells, -1: none
  std::string status;                     ///< as the trace says it: `ok`, `idle_stop`, ...
  std::string leg;                        ///< the leg that is current, "" without a mission
  std::vector<std::string> notes;         ///< what the scenario did, or what went wrong: `road LM7.E closed`
};

struct Recording {
  std::string title;                      ///< the knowledge base and the scenario
  std::string outcome;                    ///< `arrived`, `stopped: Help.blocked`, ...
  Picture picture;
  MindNames names;
  std::vector<Frame> frames;
  /// Things, each with the frames [first, last) in which it stood there.
  struct Stay { Thing thing; std::uint32_t first = 0, last = 0; };
  std::vector<Stay> stays;
};

}  // namespace kb::sim
