#include "tools/kbc/trace/csv_fields.h"

#include <cstddef>

namespace kb::trace {
namespace {

bool blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

Field FieldCursor::next() {
  while (at_ < line_.size() && blank(line_[at_])) ++at_;
  const std::size_t begin = at_;
  if (begin < line_.size() && line_[begin] == '"') return quoted(begin);
  std::size_t depth = 0;
  while (at_ < line_.size() && (line_[at_] != ',' || depth > 0)) {
    if (header_ && line_[at_] == '[') ++depth;
    if (header_ && line_[at_] == ']' && depth > 0) --depth;
    ++at_;
  }
  std::size_t end = at_;
  while (end > begin && blank(line_[end - 1])) --end;
  ended_ = at_ == line_.size();
  ++at_;
  return {.text = line_.substr(begin, end - begin),
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(end)};
}

Field FieldCursor::quoted(std::size_t begin) {
  const auto place = [](std::size_t at) { return static_cast<std::uint32_t>(at); };
  bool doubled = false;
  std::size_t close = begin + 1;
  for (;;) {
    close = line_.find('"', close);
    if (close == std::string_view::npos) {
      ended_ = true;
      return {.text = {}, .begin = place(begin), .end = place(line_.size()), .fault = Field::Fault::kOpenQuote};
    }
    if (close + 1 == line_.size() || line_[close + 1] != '"') break;
    doubled = true;
    close += 2;
  }
  Field field{.text = line_.substr(begin + 1, close - begin - 1), .quoted = true, .begin = place(begin), .end = place(close + 1)};
  at_ = close + 1;
  while (at_ < line_.size() && blank(line_[at_])) ++at_;
  ended_ = at_ >= line_.size();
  if (!ended_ && line_[at_] != ',') {
    ended_ = true;
    const std::size_t comma = line_.find(',', at_);
    field = {.text = line_.substr(at_, comma - at_),
             .begin = place(at_),
             .end = place(comma == std::string_view::npos ? line_.size() : comma),
             .fault = Field::Fault::kAfterQuote};
    return field;
  }
  ++at_;
  if (doubled) {
    scratch_.clear();
    for (std::size_t i = 0; i < field.text.size(); ++i) {
      scratch_ += field.text[i];
      if (field.text[i] == '"') ++i;
    }
    field.text = scratch_;
  }
  return field;
}

}  // namespace kb::trace
