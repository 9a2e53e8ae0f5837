// Warnings that the source itself allows.
//
// note [allowed warnings]
// `# allow: conflicting-rules` says that somebody has looked at a warning and wants the text as it is; behind a comma other warnings may follow, and
// behind a name the reason. It counts for the line in which it stands, and for the statement below it; of a message that names several places, one is
// enough. A name that is none allows nothing, so the warning is still there.
//
// Where a statement begins is told by whoever parses a `.kb`. Of a scenario it is told by indentation.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::diagnostics {

/// The comments of one file that allow warnings.
class Allowances {
 public:
  /// O(bytes); the bytes must outlive it. `statements` are the places where statements begin, ascending; without it each line that is not indented
  /// begins one.
  explicit Allowances(std::string_view bytes, std::optional<std::span<const std::uint32_t>> statements = std::nullopt);
  /// Whether a comment allows the warning `flag`, or `code` (`KB1011`), at this place: in its line, in the comment lines right above it, in the line
  /// where its statement begins, or in the comment lines above that. O(log comments).
  [[nodiscard]] bool allow(std::uint32_t offset, std::string_view flag, std::string_view code) const;

 private:
  /// Names that are allowed from one place to another.
  struct Range {
    std::size_t begin = 0, end = 0;
    std::vector<std::string_view> names;
  };
  void add(std::vector<Range>& to, std::size_t begin, const std::vector<std::string_view>& names);
  [[nodiscard]] static bool allow(const std::vector<Range>& ranges, std::uint32_t offset, std::string_view flag, std::string_view code);

  std::vector<Range> lines_, statements_;   // ascending, apart from each other
};

/// Those of all files, each looked at when its statements are known, or else when it is first asked for.
class AllowancesOfFiles {
 public:
  /// Says where the statements of a file begin, ascending.
  void know(const source::Sources& sources, source::FileId file, std::span<const std::uint32_t> statements);
  /// False at an unknown place.
  [[nodiscard]] bool allow(const source::Sources& sources, source::Span at, std::string_view flag, std::string_view code);

 private:
  std::map<source::FileId, Allowances> files_;
};

/// Where a comment that allows a warning at this known place belongs: the line above which to write it. That is the line where its
/// statement begins; of a block in braces its own.
[[nodiscard]] source::Sources::Line line_to_allow(const source::Sources& sources, source::Span at, std::uint32_t statement);

}  // namespace kb::diagnostics
