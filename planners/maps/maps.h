// Occupancy grids and scenarios from files.
//
// What is wrong with a file is reported where it stands (KB12xx, compiler/diagnostics/kinds_plans.def); nothing is mended
// silently. Rows of files count from the top, rows of grids from the bottom: the readers turn them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "planners/grid.h"

namespace kb::planners {

/// A MovingAI map: `type octile`, `height H`, `width W`, `map`, then H rows of W cells. `.`, `G` and `S` are free; `@`, `O`,
/// `T` and `W` are blocked (Sturtevant, IEEE TCIAIG 4(2), 2012). Lines end in LF or CR LF. Cells are 1 m wide.
[[nodiscard]] std::optional<Grid> read_movingai_map(source::FileId file, diagnostics::Diagnostics& diagnostics);

/// One row of a MovingAI scenario file.
struct Scenario {
  std::uint32_t bucket = 0;   ///< of its length, as the file says
  Cell start, goal;           ///< rows from the bottom
  double optimum = 0.0;       ///< length of a shortest path in cells, as the file says, usually rounded to 8 digits
  std::uint32_t line = 0;     ///< in the file
};
/// `version 1`, then rows of nine fields: bucket, map, width, height, start column and row, goal column and row, optimum.
/// Every start and goal must be a free cell of the grid. If `map` is the path of the grid's file, the first row of another map is
/// warned of.
[[nodiscard]] std::optional<std::vector<Scenario>> read_scenarios(source::FileId file, const Grid& grid,
                                                                  diagnostics::Diagnostics& diagnostics, std::string_view map = {});

/// What a ROS map_server file says (YAML: `key: value` lines, or all in braces; lists in brackets or in lines of `- value`).
struct RosMap {
  std::string image;              ///< as written: beside the file, if it is relative
  source::Span image_at;
  double resolution_m = 0.0;      ///< m a pixel
  Point origin_m;                 ///< of the lower left corner
  double occupied_thresh = 0.65;
  double free_thresh = 0.25;      ///< map_server's own defaults where the file is silent
  bool negate = false;
  enum class Mode : std::uint8_t { kTrinary, kScale, kRaw } mode = Mode::kTrinary;
};
[[nodiscard]] std::optional<RosMap> read_ros_yaml(source::FileId file, diagnostics::Diagnostics& diagnostics);

/// The image of a ROS map, PGM (P5 or P2). A pixel whose occupancy is below `free_thresh` is free; what is occupied, and what
/// is unknown, is blocked: a robot that has not seen a place has no business there.
[[nodiscard]] std::optional<Grid> read_pgm(source::FileId file, const RosMap& map, diagnostics::Diagnostics& diagnostics);

/// Reads a map by its name: `.map` is MovingAI's, `.yaml` or `.yml` is a ROS map with its image.
struct MapFile {
  Grid grid;
  /// Places are told in the file's own way: columns and rows from the top (MovingAI), or metres (ROS).
  bool in_cells = true;
};
[[nodiscard]] std::optional<MapFile> read_map(const std::string& path, const source::FileSystem& files,
                                              source::Sources& sources, diagnostics::Diagnostics& diagnostics);

/// Reads a file into `sources`. Nothing if it cannot be read (reported).
[[nodiscard]] std::optional<source::FileId> open_file(const std::string& path, const source::FileSystem& files,
                                                      source::Sources& sources, diagnostics::Diagnostics& diagnostics);

/// The place that `a,b` names in the frame of a map file; `cells`: columns and rows from the top.
[[nodiscard]] std::optional<Point> parse_place(std::string_view text, const Grid& grid, bool in_cells);
/// The same the other way round: a place as the map file counts, in metres or in columns and rows. A whole number of these is the
/// middle of a cell.
[[nodiscard]] Point place_in_file(Point place, const Grid& grid, bool in_cells);

}  // namespace kb::planners
