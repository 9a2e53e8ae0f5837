#include "tools/kbc/trace/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/numbers.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/grid.h"

namespace kb::trace {
namespace {

using program::CellId;
using program::CellKind;

/// Three digits are enough to read a table; the trace has all of them.
std::string number(float value) { return value == 0.0f ? "0" : fmt::format("{:.3g}", value); }

// Whether the cells do not show which strategy runs: it is idle, held, or the first of several.
bool runs_unsaid(const program::Tick& tick) {
  return tick.active.size() > 1 || (tick.active.empty() && tick.strategy != CellId::kNone);
}

std::string_view heading(CellKind kind) {
  return kind == CellKind::kFact ? "facts" : kind == CellKind::kSatellite ? "satellites" : "strategies";
}

}  // namespace

std::optional<TickRange> parse_ticks(std::string_view text) {
  TickRange range;
  const std::size_t dash = text.find('-');
  const std::string_view first = text.substr(0, dash),
                         last = dash == std::string_view::npos ? first : text.substr(dash + 1);
  if (text.empty() || text == "-") return std::nullopt;
  if (!first.empty() && !source::read_number(first, range.first)) return std::nullopt;
  if (!last.empty() && !source::read_number(last, range.last)) return std::nullopt;
  if (range.first == 0 || range.last < range.first) return std::nullopt;
  return range;
}

Table::Table(const program::Program& program, TableOptions options) : program_(program), options_(std::move(options)) {
  for (std::size_t i = 0; i < program.cells.size(); ++i) {
    if (options_.cells.empty() || matches(options_.cells, program.cells[i].name))
      cells_.push_back(static_cast<CellId>(i));
  }
  has_strategies_ = std::any_of(cells_.begin(), cells_.end(), [&](CellId cell) { return program[cell].kind == CellKind::kStrategy; });
}

bool Table::add(const program::Tick& tick, const std::function<float(CellId)>& value) {
  if (options_.ticks && (tick.number < options_.ticks->first || tick.number > options_.ticks->last)) return true;
  if (values_.size() + cells_.size() > kMaxValues) return false;
  const std::size_t before = values_.size();
  for (const CellId cell : cells_) values_.push_back(value(cell));
  const Column column{tick.number, tick.time_us, tick.strategy, has_strategies_ && runs_unsaid(tick)};
  if (options_.all || options_.ticks || changed(column, before)) {
    columns_.push_back(column);
  } else {
    values_.resize(before);
  }
  return true;
}

// Whether the values from `before` on, and what runs, differ from the last column.
bool Table::changed(const Column& now, std::size_t before) const {
  if (columns_.empty()) return true;
  const auto values = values_.begin() + static_cast<std::ptrdiff_t>(before);
  if (!std::equal(values, values_.end(), values - static_cast<std::ptrdiff_t>(cells_.size()))) return true;
  const Column& last = columns_.back();
  return now.runs != last.runs && (now.unsaid || last.unsaid);
}

// Whether the first tick has changed the cell. Recordings say of most facts on every tick that they are false: these are left out.
bool Table::changed_at_once(std::size_t cell) const {
  if (columns_.empty() || columns_.front().tick != 1) return false;
  const program::Cell& known = program_[cells_[cell]];
  return known.kind == CellKind::kFact ? at(0, cell) > 0.0f : at(0, cell) != known.initial;
}

std::vector<std::size_t> Table::shown_cells() const {
  std::vector<std::size_t> shown;
  const bool alone = !options_.cells.empty() && columns_.size() < 2;   // what was asked for, as no other tick can show a change of it
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    bool show = options_.all || alone || changed_at_once(cell) || is_named(options_.cells, program_[cells_[cell]].name);
    for (std::size_t column = 1; column < columns_.size() && !show; ++column) show = at(column, cell) != at(0, cell);
    if (show) shown.push_back(cell);
  }
  return shown;
}

// The entries of a column; `cell_of_line` has SIZE_MAX for lines without values.
std::vector<std::string> Table::entries(std::size_t column, const std::vector<std::size_t>& cell_of_line) const {
  const Column& about = columns_[column];
  std::vector<std::string> out{fmt::format("{}", about.tick), fmt::format("{}", static_cast<double>(about.time_us) / 1e6)};
  for (std::size_t line = out.size(); line < cell_of_line.size(); ++line)
    out.push_back(cell_of_line[line] == SIZE_MAX ? "" : number(at(column, cell_of_line[line])));
  return out;
}

std::string Table::print() const {
  const std::vector<std::size_t> shown = shown_cells();
  std::vector<std::string> names{"tick", "t"};
  std::vector<std::size_t> cell_of_line{SIZE_MAX, SIZE_MAX};  // SIZE_MAX: a line without values
  CellKind kind{};
  for (const std::size_t cell : shown) {
    if (cell == shown.front() || program_[cells_[cell]].kind != kind) {
      kind = program_[cells_[cell]].kind;
      names.insert(names.end(), {"", std::string(heading(kind))});
      cell_of_line.insert(cell_of_line.end(), 2, SIZE_MAX);
    }
    names.push_back(fmt::format("  {}", program_[cells_[cell]].name));
    cell_of_line.push_back(cell);
  }
  const bool runs = std::any_of(columns_.begin(), columns_.end(), [](const Column& column) { return column.unsaid; });
  if (runs) names.insert(names.end(), {"", "runs"});
  Grid grid(names.size());
  grid.add_column(names, true);
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    std::vector<std::string> lines = entries(column, cell_of_line);
    const CellId strategy = columns_[column].runs;
    if (runs) lines.insert(lines.end(), {"", strategy == CellId::kNone ? "-" : std::string(program_[strategy].name)});
    grid.add_column(lines, false);
  }
  return grid.text();
}

}  // namespace kb::trace
