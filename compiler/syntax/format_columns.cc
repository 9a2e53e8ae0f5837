#include <algorithm>
#include <cstddef>
#include <span>

#include "compiler/diagnostics/display.h"
#include "compiler/syntax/format_lines.h"

namespace kb::syntax {
namespace {

constexpr std::uint32_t kWidestGap = 4;      // a column that is further away is made anew
constexpr std::uint32_t kCommentGap = 2;

// A line, of which the part up to `next` has been laid out.
struct LaidOut {
  const Line* line;
  std::string text;
  std::uint32_t width = 0;
  std::size_t next = 0;   // the cell to be placed

  [[nodiscard]] const Cell* cell(std::uint32_t slot) const {
    return next < line->cells.size() && line->cells[next].slot == slot ? &line->cells[next] : nullptr;
  }
  void place(std::uint32_t column) {
    if (column > width) text.append(column - width, ' ');
    const Cell& placed = line->cells[next++];
    text += placed.text;
    width = std::max(column, width) + static_cast<std::uint32_t>(diagnostics::columns(placed.text));
  }
};

// A cell that is to stand in a common column.
struct Wish {
  std::uint32_t width;      // of the text before it
  std::uint32_t source;     // the column where it stood in the source
  std::uint32_t gap;        // blanks before it if the column is made anew
  std::uint32_t least;      // blanks before it if the column is kept
  std::uint32_t farthest;   // if the text before it is wider, it does not take part
};

// See note [columns are kept or re-made]: most of those that take part must fit. `widest_gap` is how far from the widest text a column may be kept.
std::uint32_t common_column(std::span<const Wish> wishes, std::uint32_t widest_gap) {
  std::uint32_t leftmost = UINT32_MAX, widest = 0, made = 0;
  for (const Wish& wish : wishes) leftmost = std::min(leftmost, wish.source);
  std::size_t near = 0, fitting = 0;
  bool same = true;
  for (const Wish& wish : wishes) {
    if (wish.width > wish.farthest) continue;
    ++near;
    made = std::max(made, wish.width + wish.gap);
    if (wish.width + wish.least > leftmost) continue;
    same = same && wish.source == leftmost;
    widest = std::max(widest, wish.width);
    ++fitting;
  }
  const bool keep = same && 2 * fitting > near && leftmost - widest <= widest_gap;
  return keep ? leftmost : made;
}

// A line that is too long for the column is not aligned.
std::uint32_t column_for(const Wish& wish, std::uint32_t column) {
  const bool fits = wish.width <= wish.farthest && wish.width + wish.least <= column;
  return fits ? column : wish.width + wish.gap;
}

// All cells of these rows that have `slot`.
void lay_out_column(std::span<LaidOut* const> rows, std::uint32_t slot) {
  std::vector<Wish> wishes;
  for (const LaidOut* row : rows) {
    if (const Cell* cell = row->cell(slot)) wishes.push_back({row->width, cell->source_column, cell->gap, 1, cell->farthest});
  }
  const std::uint32_t column = wishes.size() > 1 ? common_column(wishes, kWidestGap) : 0;
  std::size_t next = 0;
  for (LaidOut* row : rows) {
    if (row->cell(slot) == nullptr) continue;
    row->place(column_for(wishes[next++], column));
  }
}

void lay_out(std::span<LaidOut> block) {
  std::vector<LaidOut*> open;   // with cells to be placed: one long row must not cost as much as if all were so long
  for (LaidOut& row : block) {
    row.text.assign(row.line->indent, ' ');
    row.width = row.line->indent;
    if (row.cell(0) != nullptr) row.place(row.width);
    if (row.next < row.line->cells.size()) open.push_back(&row);
  }
  for (std::uint32_t slot = 1; !open.empty(); ++slot) {
    lay_out_column(open, slot);
    std::erase_if(open, [](const LaidOut* row) { return row->next == row->line->cells.size(); });
  }
}

// Lays out the comments at the ends of a block's lines. A comment that continues the one above stands in the same column.
void lay_out_comments(std::span<LaidOut> block) {
  std::vector<Wish> wishes;
  const auto ends_line = [](const LaidOut& row) { return !row.line->comment.empty() && !row.line->continues_comment; };
  for (const LaidOut& row : block) {
    if (ends_line(row)) wishes.push_back({row.width, row.line->comment_column, kCommentGap, kCommentGap, UINT32_MAX});
  }
  if (wishes.empty()) return;
  const std::uint32_t column = common_column(wishes, UINT32_MAX);
  std::size_t next = 0;
  std::uint32_t here = 0;
  for (LaidOut& row : block) {
    if (row.line->comment.empty()) continue;
    if (ends_line(row)) here = column_for(wishes[next++], column);
    row.text.append(here - row.width, ' ');
    row.text += row.line->comment;
  }
}

bool is_only_comment(const Line& line) { return line.cells.empty() && !line.continues_comment; }

// Calls `each` for every longest run of rows in which no row but the first `begins`.
template <class Begins, class Each>
void for_runs(std::span<LaidOut> rows, Begins begins, Each each) {
  std::size_t first = 0;
  for (std::size_t i = 1; i <= rows.size(); ++i) {
    if (i < rows.size() && !begins(rows[i - 1], rows[i])) continue;
    if (i > first) each(rows.subspan(first, i - first));
    first = i;
  }
}

}  // namespace

std::string print_lines(const std::vector<Line>& lines) {
  std::vector<LaidOut> rows;
  rows.reserve(lines.size());
  for (const Line& line : lines) rows.push_back({&line, {}, 0, 0});
  const auto new_columns = [](const LaidOut& before, const LaidOut& row) {
    return row.line->blank_before || row.line->begins_block || row.line->family == Family::kNone ||
           row.line->family != before.line->family;
  };
  const auto new_comments = [](const LaidOut& before, const LaidOut& row) {
    return row.line->blank_before || is_only_comment(*row.line) || is_only_comment(*before.line);
  };
  for_runs(rows, new_columns, lay_out);
  for_runs(rows, new_comments, [](std::span<LaidOut> block) {
    if (!is_only_comment(*block.front().line)) return lay_out_comments(block);
    block.front().text += block.front().line->comment;
  });
  std::string out;
  for (const LaidOut& row : rows) {
    if (row.line->blank_before && !out.empty()) out += '\n';
    out += row.text;
    out += '\n';
  }
  return out;
}

std::string with_line_ends_of(std::string_view written, std::string laid_out) {
  const std::size_t first = written.find('\n');
  if (first == std::string_view::npos || first == 0 || written[first - 1] != '\r') return laid_out;
  std::string out;
  out.reserve(laid_out.size() + static_cast<std::size_t>(std::count(laid_out.begin(), laid_out.end(), '\n')));
  for (const char c : laid_out) {
    if (c == '\n') out += '\r';
    out += c;
  }
  return out;
}

}  // namespace kb::syntax
