// The intermediate form of the formatter: lines of cells. `format.cc` makes them, `format_columns.cc` aligns them in columns and
// prints them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kb::syntax {

/// Neighbouring lines of one family share columns.
enum class Family : std::uint8_t {
  kNone, kDeclaration, kNames, kControl, kPlan, kLandmark, kRoad, kTable, kSensor, kRow, kRule, kFuzzyRule
};

/// What stands in one column of a line.
struct Cell {
  std::string text;
  std::uint32_t source_column = 0;   ///< where it began in the source, in characters
  std::uint32_t slot = 0;            ///< which column of its family; the first cell has slot 0
  std::uint16_t gap = 1;             ///< blanks before it unless something else decides
  std::uint16_t farthest = 0xFFFF;   ///< a line that is longer than this before the cell is not aligned
};

struct Line {
  std::uint32_t indent = 0;
  Family family = Family::kNone;
  bool blank_before = false;
  bool begins_block = false;         ///< no common columns with the line before
  bool continues_comment = false;    ///< only a comment, right below the comment of the line before
  std::vector<Cell> cells;           ///< none if the line is only a comment
  std::string_view comment;
  std::uint32_t comment_column = 0;  ///< in the source
};

/// note [columns are kept or re-made]
///   A column stays as it is if all cells that have room there (most do) already begin at one place, not too far from the widest
///   text before them: then it was made with care. Otherwise it is re-made as tight as its gap allows. The same holds for comments
///   at the ends of lines, at any distance. A line that is too long for a column is not aligned. A kept column is kept again, and
///   so is a re-made one, so formatting twice gives the same as formatting once.
[[nodiscard]] std::string print_lines(const std::vector<Line>& lines);

/// Gives every line the kind of end that the first one has. Which kind that is, is left to version control.
[[nodiscard]] std::string with_line_ends_of(std::string_view written, std::string laid_out);

}  // namespace kb::syntax
