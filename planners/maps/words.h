// Lines and words of small text files, with their places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::planners {

struct Word {
  std::string_view text;
  source::Span at;
};

/// Walks over the lines of a file, without their LF or CR LF. A byte order mark is skipped.
class Lines {
 public:
  Lines(const source::Sources& sources, source::FileId file);
  [[nodiscard]] bool more() const { return at_ < bytes_.size(); }
  [[nodiscard]] Word next();
  /// The rest of the file from the beginning of `word`.
  [[nodiscard]] Word from(const Word& word) const;
  /// Makes `next` continue at the beginning of `rest`, with what is left of its line.
  void go_on_at(const Word& rest);
  /// Number of the line that `next` returned last, from 1.
  [[nodiscard]] std::uint32_t number() const { return number_; }
  /// The place after the last byte.
  [[nodiscard]] source::Span end() const;

 private:
  std::string_view bytes_;
  source::FileId file_;
  std::size_t at_ = 0;
  std::uint32_t number_ = 0;
};

/// `count` bytes of a word, from `begin` on.
[[nodiscard]] Word part(const Word& whole, std::size_t begin, std::size_t count);
/// Cuts the first word off `rest`, up to one of `separators`, and skips separators before it. At the end the word is empty.
[[nodiscard]] Word cut_word(Word& rest, std::string_view separators = " \t");
/// `word` without blanks at its ends.
[[nodiscard]] Word trim(Word word);

/// The whole of `text` as a number in [least, most].
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t least, std::int64_t most);
/// The whole of `text` as a finite number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

}  // namespace kb::planners
