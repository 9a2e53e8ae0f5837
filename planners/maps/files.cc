#include "planners/maps/maps.h"
#include "planners/maps/words.h"

namespace kb::planners {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

std::optional<Grid> read_ros_map(source::FileId file, const std::string& path, const source::FileSystem& files,
                                 source::Sources& sources, Diagnostics& diagnostics) {
  const auto map = read_ros_yaml(file, diagnostics);
  if (!map) return std::nullopt;
  std::string image = map->image;
  const std::size_t slash = path.find_last_of('/');
  if (!image.starts_with('/') && slash != std::string::npos) image = path.substr(0, slash + 1) + image;
  auto read = files.read(image);
  if (!read.bytes) {
    diagnostics.report(Kind::kCannotRead, map->image_at, {image, read.error});
    return std::nullopt;
  }
  return read_pgm(sources.add(image, std::move(*read.bytes)), *map, diagnostics);
}

}  // namespace

std::optional<MapFile> read_map(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                Diagnostics& diagnostics) {
  const bool ros = path.ends_with(".yaml") || path.ends_with(".yml");
  if (!ros && !path.ends_with(".map")) {
    diagnostics.report(Kind::kMapFormat, {}, {path});
    return std::nullopt;
  }
  const auto file = diagnostics::open_file(path, files, sources, diagnostics);
  if (!file) return std::nullopt;
  auto grid = ros ? read_ros_map(*file, path, files, sources, diagnostics) : read_movingai_map(*file, diagnostics);
  if (!grid) return std::nullopt;
  return MapFile{std::move(*grid), !ros};
}

std::optional<Point> parse_place(std::string_view text, const Grid& grid, bool in_cells) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto x = parse_number(trim(Word{text.substr(0, comma), {}}).text);
  const auto y = parse_number(trim(Word{text.substr(comma + 1), {}}).text);
  if (!x || !y) return std::nullopt;
  if (!in_cells) return Point{*x, *y};
  // The middle of cell (column, row); rows count from the top.
  const Point low = grid.origin_m();
  return Point{low.x + (*x + 0.5) * grid.cell_m(), low.y + (grid.height() - 0.5 - *y) * grid.cell_m()};
}

Point place_in_file(Point place, const Grid& grid, bool in_cells) {
  if (!in_cells) return place;
  const Point low = grid.origin_m();
  return Point{(place.x - low.x) / grid.cell_m() - 0.5, grid.height() - 0.5 - (place.y - low.y) / grid.cell_m()};
}

}  // namespace kb::planners
