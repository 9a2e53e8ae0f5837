#include "planners/maps/words.h"

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"

namespace kb::planners {

Word part(const Word& whole, std::size_t begin, std::size_t count) {
  Word word;
  word.text = whole.text.substr(begin, count);
  word.at.file = whole.at.file;
  word.at.begin = whole.at.begin + static_cast<std::uint32_t>(begin);
  word.at.end = word.at.begin + static_cast<std::uint32_t>(word.text.size());
  return word;
}

Lines::Lines(const source::Sources& sources, source::FileId file) : bytes_(sources.bytes(file)), file_(file) {
  if (bytes_.starts_with(source::kByteOrderMark)) at_ = source::kByteOrderMark.size();
}

Word Lines::next() {
  const std::size_t begin = at_;
  std::size_t end = bytes_.find('\n', begin);
  if (end == std::string_view::npos) end = bytes_.size();
  at_ = end + 1;
  ++number_;
  if (end > begin && bytes_[end - 1] == '\r') --end;
  Word line;
  line.text = bytes_.substr(begin, end - begin);
  line.at = {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  return line;
}

Word Lines::from(const Word& word) const { return {bytes_.substr(word.at.begin), {file_, word.at.begin, end().end}}; }

void Lines::go_on_at(const Word& rest) { at_ = rest.at.begin; }

source::Span Lines::end() const {
  const auto size = static_cast<std::uint32_t>(bytes_.size());
  return {file_, size, size};
}

Word cut_word(Word& rest, std::string_view separators) {
  const std::size_t begin = rest.text.find_first_not_of(separators);
  if (begin == std::string_view::npos) {
    rest = part(rest, rest.text.size(), 0);
    return rest;
  }
  std::size_t end = rest.text.find_first_of(separators, begin);
  if (end == std::string_view::npos) end = rest.text.size();
  const Word word = part(rest, begin, end - begin);
  rest = part(rest, end, rest.text.size() - end);
  return word;
}

Word trim(Word word) {
  const std::string_view inside = source::trimmed(word.text);
  return part(word, static_cast<std::size_t>(inside.data() - word.text.data()), inside.size());
}

std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t least, std::int64_t most) {
  std::int64_t value = 0;
  if (!source::read_number(text, value) || value < least || value > most) return std::nullopt;
  return value;
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  return source::read_number(source::without_plus(text), value) ? std::optional(value) : std::nullopt;
}

}  // namespace kb::planners
