// One line of CSV, field by field.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kb::trace {

/// A field and its place. White space around it (blanks, tabs) is ignored.
struct Field {
  enum class Fault : std::uint8_t { kNone, kOpenQuote, kAfterQuote };
  std::string_view text;             ///< without quotes
  bool quoted = false;
  std::uint32_t begin = 0, end = 0;  ///< bytes of the line, quotes included; for a fault: the wrong bytes
  Fault fault = Fault::kNone;
};

/// Walks over the fields of a line. `scratch` holds the text of a field with doubled quotes until the next such field.
class FieldCursor {
 public:
  /// In a header a comma between `[` and `]` belongs to the name: `Cross[right,mark]` is one field, quoted or not.
  FieldCursor(std::string_view line, std::string& scratch, bool header = false)
      : line_(line), scratch_(scratch), header_(header) {}

  /// Whether there is another field. An empty line has one.
  [[nodiscard]] bool more() const { return !ended_; }
  /// The next field; call only if `more`. After a fault there are no more.
  Field next();

 private:
  Field quoted(std::size_t begin);
  std::string_view line_;
  std::string& scratch_;
  std::size_t at_ = 0;
  bool header_;
  bool ended_ = false;
};

}  // namespace kb::trace
