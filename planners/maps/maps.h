// Reads occupancy grids and scenarios from files.
//
// Faults in a file are reported at their place (KB12xx, compiler/diagnostics/kinds_plans.def); nothing is corrected silently. Rows of files
// count from the top and rows of grids from the bottom; the readers turn them.
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
/// `T` and `W` are blocked (Sturtevant, IEEE TCIAIG 4(2), 2012). Lines end in LF or CR LF. A cell is 1 m wide.
[[nodiscard]] std::optional<Grid> read_movingai_map(source::FileId file, diagnostics::Diagnostics& diagnostics);

/// One row of a MovingAI scenario file.
struct Scenario {
  std::uint32_t bucket = 0;   ///< by length, as the file says
  Cell start, goal;           ///< rows from the bottom
  double optimum = 0.0;       ///< length of a shortest path, in cells, as the file says; usually rounded to 8 digits
  std::uint32_t line = 0;     ///< in the file
};
/// `version 1`, then rows of nine fields: bucket, map, width, height, start column and row, goal column and row, optimum.
/// Every start and goal must be a free cell of the grid. If `map` is the path of the grid's file, a warning names the first row that is of
/// another map.
[[nodiscard]] std::optional<std::vector<Scenario>> read_scenarios(source::FileId file, const Grid& grid,
                                                                  diagnostics::Diagnostics& diagnostics, std::string_view map = {});

/// The contents of a ROS map_server file (YAML: `key: value` lines, or all in braces; lists in brackets or in lines of `- value`).
struct RosMap {
  std::string image;              ///< as written; if relative, to the folder of the file
  source::Span image_at;
  double resolution_m = 0.0;      ///< side of a pixel, m
  Point origin_m;                 ///< of the lower left corner
  double occupied_thresh = 0.65;
  double free_thresh = 0.25;      ///< if the file is silent, map_server's own defaults
  bool negate = false;
  bool raw = false;               ///< mode `raw`; `trinary` and `scale` are the same to whoever wants to know what is free
};
[[nodiscard]] std::optional<RosMap> read_ros_yaml(source::FileId file, diagnostics::Diagnostics& diagnostics);

/// The image of a ROS map, PGM (P5 or P2). A pixel whose occupancy is below `free_thresh` is free. Occupied and unknown pixels are
/// blocked: a robot has no business in a place that nobody has mapped.
[[nodiscard]] std::optional<Grid> read_pgm(source::FileId file, const RosMap& map, diagnostics::Diagnostics& diagnostics);

/// A map as `read_map` returns it.
struct MapFile {
  Grid grid;
  /// How the file counts places: true for columns and rows from the top (MovingAI), false for metres (ROS).
  bool in_cells = true;
};
/// Reads a map by the ending of its name: `.map` is MovingAI's, `.yaml` or `.yml` a ROS map with its image.
[[nodiscard]] std::optional<MapFile> read_map(const std::string& path, const source::FileSystem& files,
                                              source::Sources& sources, diagnostics::Diagnostics& diagnostics);

/// The place that `a,b` names in the frame of a map file. With `in_cells` it is a column and a row, counted from the top.
[[nodiscard]] std::optional<Point> parse_place(std::string_view text, const Grid& grid, bool in_cells);
/// The reverse: a place as the map file counts it, in metres or in columns and rows. Whole columns and rows are the middles of cells.
[[nodiscard]] Point place_in_file(Point place, const Grid& grid, bool in_cells);

}  // namespace kb::planners
