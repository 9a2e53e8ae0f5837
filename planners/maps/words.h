// Lines and words of small text files, each with its place.
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

/// Walks over the lines of a file; a line is given without its LF or CR LF. A byte order mark is passed over.
class Lines {
 public:
  Lines(const source::Sources& sources, source::FileId file);
  [[nodiscard]] bool more() const { return at_ < bytes_.size(); }
  [[nodiscard]] Word next();
  /// All of the file from where `word` begins.
  [[nodiscard]] Word from(const Word& word) const;
  /// The next line is what is left of the one that `rest` begins in.
  void go_on_at(const Word& rest);
  /// Number of the line given last, from 1.
  [[nodiscard]] std::uint32_t number() const { return number_; }
  /// The place after the last byte.
  [[nodiscard]] source::Span end() const;

 private:
  std::string_view bytes_;
  source::FileId file_;
  std::size_t at_ = 0;
  std::uint32_t number_ = 0;
};

/// `count` bytes of a word.
[[nodiscard]] Word part(const Word& whole, std::size_t begin, std::size_t count);
/// Cuts the first word off `rest`: up to one of `separators`, which are passed over. An empty word at the end.
[[nodiscard]] Word cut_word(Word& rest, std::string_view separators = " \t");
/// `word` without blanks at its ends.
[[nodiscard]] Word trim(Word word);

/// The whole of `text` as a number in [least, most].
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t least, std::int64_t most);
/// The whole of `text` as a finite number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

}  // namespace kb::planners
