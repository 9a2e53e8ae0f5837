// Reads MovingAI's maps and scenarios.
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "compiler/diagnostics/display.h"
#include "planners/maps/maps.h"
#include "planners/maps/words.h"

namespace kb::planners {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;
using diagnostics::visible;

std::string shown(std::string_view text) {
  return visible(text.substr(0, 40)) + (text.size() > 40 ? "..." : "");
}

// Reads a line of the header: the word `key`, then its value, which is returned.
std::optional<Word> read_header_line(Lines& lines, std::string_view key, Diagnostics& diagnostics) {
  Word rest = lines.more() ? lines.next() : Word{{}, lines.end()};
  const source::Span line = rest.at;
  const Word word = cut_word(rest);
  if (word.text == key) return trim(rest);
  diagnostics.report(Kind::kMapHeader, line, {key});
  return std::nullopt;
}

std::optional<std::int32_t> read_side(Lines& lines, std::string_view key, Diagnostics& diagnostics) {
  const auto value = read_header_line(lines, key, diagnostics);
  if (!value) return std::nullopt;
  const auto side = parse_integer(value->text, 1, Grid::kMaxSide);
  if (!side) {
    diagnostics.report(Kind::kMapSide, value->at, {shown(value->text), fmt::format("{}", Grid::kMaxSide)});
    return std::nullopt;
  }
  return static_cast<std::int32_t>(*side);
}

bool read_row(const Word& line, std::int32_t row, Grid& grid, Diagnostics& diagnostics) {
  constexpr std::string_view kFree = ".GS", kBlocked = "@OTW";
  if (line.text.size() != static_cast<std::size_t>(grid.width())) {
    diagnostics.report(Kind::kMapRowLength, line.at,
                       {fmt::format("{}", line.text.size()), fmt::format("{}", grid.width())});
    return false;
  }
  for (std::size_t column = 0; column < line.text.size(); ++column) {
    const char c = line.text[column];
    if (kFree.find(c) != std::string_view::npos) continue;
    if (kBlocked.find(c) == std::string_view::npos) {
      source::Span at = line.at;
      at.begin += static_cast<std::uint32_t>(column);
      at.end = at.begin + 1;
      diagnostics.report(Kind::kMapCell, at, {visible(line.text.substr(column, 1))});
      return false;
    }
    grid.set_blocked({static_cast<std::int32_t>(column), grid.height() - 1 - row}, true);
  }
  return true;
}

/// `den312d` of `maps/dao/den312d.map`.
std::string_view stem(std::string_view path) {
  if (const std::size_t slash = path.find_last_of("/\\"); slash != std::string_view::npos) path.remove_prefix(slash + 1);
  return path.substr(0, path.find_last_of('.'));
}

struct Size {
  std::int32_t width = 0, height = 0;
};

std::optional<Size> read_header(Lines& lines, Diagnostics& diagnostics) {
  const auto type = read_header_line(lines, "type", diagnostics);
  if (!type) return std::nullopt;
  if (type->text != "octile") {
    diagnostics.report(Kind::kMapType, type->at, {shown(type->text)});
    return std::nullopt;
  }
  const auto height = read_side(lines, "height", diagnostics);
  if (!height) return std::nullopt;
  const auto width = read_side(lines, "width", diagnostics);
  if (!width || !read_header_line(lines, "map", diagnostics)) return std::nullopt;
  return Size{*width, *height};
}

constexpr std::array<std::string_view, 9> kFields = {"bucket",   "map",       "width",       "height", "start column",
                                                     "start row", "goal column", "goal row", "length"};

// One row of a scenario file, cut into its fields.
struct Row {
  std::array<Word, 9> fields;
  Word line;
};

std::optional<Row> cut_row(const Word& line, Diagnostics& diagnostics) {
  Row row;
  row.line = line;
  Word rest = line;
  std::size_t count = 0;
  for (Word word = cut_word(rest); !word.text.empty(); word = cut_word(rest)) {
    if (count < row.fields.size()) row.fields[count] = word;
    ++count;
  }
  if (count == row.fields.size()) return row;
  diagnostics.report(Kind::kScenarioFields, line.at, {fmt::format("{}", count)});
  return std::nullopt;
}

std::optional<std::int64_t> whole(const Row& row, std::size_t field, Diagnostics& diagnostics) {
  const Word& word = row.fields[field];
  const auto value = parse_integer(word.text, 0, 1'000'000'000);
  if (!value) diagnostics.report(Kind::kScenarioNumber, word.at, {shown(word.text), kFields[field]});
  return value;
}

// A start or a goal: two fields, column and row; rows count from the top.
std::optional<Cell> place(const Row& row, std::size_t first, std::string_view what, const Grid& grid,
                          Diagnostics& diagnostics) {
  const auto x = whole(row, first, diagnostics), y = whole(row, first + 1, diagnostics);
  if (!x || !y) return std::nullopt;
  const bool outside = *x >= grid.width() || *y >= grid.height();
  const Cell cell{static_cast<std::int32_t>(*x), static_cast<std::int32_t>(grid.height() - 1 - *y)};
  if (!outside && grid.free(cell)) return cell;
  diagnostics.report(Kind::kScenarioPlace, source::join(row.fields[first].at, row.fields[first + 1].at),
                     {what, fmt::format("{}", *x), fmt::format("{}", *y), outside ? "outside of the map" : "blocked"});
  return std::nullopt;
}

/// `told`: the other map size that was last reported of a row; the same one is not reported for each row.
std::optional<Scenario> read_scenario(const Row& row, const Grid& grid, std::string& told, Diagnostics& diagnostics) {
  const auto bucket = whole(row, 0, diagnostics), width = whole(row, 2, diagnostics), height = whole(row, 3, diagnostics);
  if (!bucket || !width || !height) return std::nullopt;
  if (*width != grid.width() || *height != grid.height()) {
    const std::string size = fmt::format("{} x {}", *width, *height);
    if (std::exchange(told, size) == size) return std::nullopt;
    diagnostics.report(Kind::kScenarioSize, source::join(row.fields[2].at, row.fields[3].at), {size, fmt::format("{} x {}", grid.width(), grid.height())});
    return std::nullopt;
  }
  const auto start = place(row, 4, "start", grid, diagnostics), goal = place(row, 6, "goal", grid, diagnostics);
  if (!start || !goal) return std::nullopt;
  const auto optimum = parse_number(row.fields[8].text);
  if (!optimum || *optimum < 0.0) {
    diagnostics.report(Kind::kScenarioNumber, row.fields[8].at, {shown(row.fields[8].text), kFields[8]});
    return std::nullopt;
  }
  return Scenario{static_cast<std::uint32_t>(*bucket), *start, *goal, *optimum, 0};
}

}  // namespace

std::optional<Grid> read_movingai_map(source::FileId file, Diagnostics& diagnostics) {
  Lines lines(diagnostics.sources(), file);
  const auto size = read_header(lines, diagnostics);
  if (!size) return std::nullopt;
  // If the header promises more than the file holds, no memory is taken for it.
  if (static_cast<std::size_t>(size->width) * static_cast<std::size_t>(size->height) >
      diagnostics.sources().bytes(file).size()) {
    diagnostics.report(Kind::kMapRowCount, lines.end(), {fmt::format("{} x {}", size->width, size->height)});
    return std::nullopt;
  }
  Grid grid(size->width, size->height);
  for (std::int32_t row = 0; row < size->height; ++row) {
    if (!lines.more()) {
      diagnostics.report(Kind::kMapRowCount, lines.end(), {fmt::format("{} x {}", size->width, size->height)});
      return std::nullopt;
    }
    if (!read_row(lines.next(), row, grid, diagnostics)) return std::nullopt;
  }
  while (lines.more()) {
    const Word line = lines.next();
    if (trim(line).text.empty()) continue;
    diagnostics.report(Kind::kMapTooLong, line.at, {fmt::format("{}", size->height)});
    return std::nullopt;
  }
  return grid;
}

std::optional<std::vector<Scenario>> read_scenarios(source::FileId file, const Grid& grid, Diagnostics& diagnostics, std::string_view map) {
  Lines lines(diagnostics.sources(), file);
  Word first = lines.more() ? lines.next() : Word{{}, lines.end()};
  const source::Span line = first.at;
  const Word word = cut_word(first), version = trim(first);
  if (word.text != "version" || (version.text != "1" && version.text != "1.0")) {
    diagnostics.report(Kind::kScenarioVersion, line);
    return std::nullopt;
  }
  std::vector<Scenario> scenarios;
  std::string told;
  bool good = true, other = false;
  while (lines.more()) {
    const Word text = lines.next();
    if (trim(text).text.empty()) continue;
    const auto row = cut_row(text, diagnostics);
    if (row && !other && !map.empty() && stem(row->fields[1].text) != stem(map)) {
      diagnostics.report(Kind::kScenarioMap, row->fields[1].at, {shown(row->fields[1].text), shown(map)});
      other = true;
    }
    auto scenario = row ? read_scenario(*row, grid, told, diagnostics) : std::nullopt;
    if (!scenario) {
      if (other) return std::nullopt;   // the rows may fit another map
      good = false;
      continue;
    }
    scenario->line = lines.number();
    scenarios.push_back(*scenario);
  }
  if (!good) return std::nullopt;
  if (scenarios.empty()) {
    diagnostics.report(Kind::kScenarioNone, lines.end());
    return std::nullopt;
  }
  return scenarios;
}

}  // namespace kb::planners
