// One line of CSV, field by field.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kb::trace {

/// A field where it stands. White space around it (blanks, tabs) does not count.
struct Field {
  enum class Fault : std::uint8_t { kNone, kOpenQuote, kAfterQuote };
  std::string_view text;             ///< without quotes
  bool quoted = false;
  std::uint32_t begin = 0, end = 0;  ///< bytes of the line, quotes included; at a fault: the bytes that are wrong
  Fault fault = Fault::kNone;
};

/// Walks over the fields of a line. `scratch` holds the text of a field with doubled quotes until the next such field.
class FieldCursor {
 public:
  /// In a header a comma between `[` and `]` belongs to the name: `Cross[right,mark]` is one field, quoted or not.
  FieldCursor(std::string_view line, std::string& scratch, bool header = false)
      : line_(line), scratch_(scratch), header_(header) {}

  /// True if there is a further field. An empty line has one.
  [[nodiscard]] bool more() const { return !ended_; }
  /// The next field; call only if `more`. After a fault there is no further one.
  Field next();

 private:
  Field quoted(std::size_t begin);
  std::string_view line_;
  std::string& scratch_;
  std::size_t at_ = 0;
  bool header_;
  bool ended_ = false;
};

/// True if `text` is well-formed UTF-8 (no overlong forms, no surrogates). Otherwise `fault` is where it first is not.
[[nodiscard]] bool is_utf8(std::string_view text, std::size_t& fault);

/// `text` for a message: at most 40 bytes, cut between characters; control characters and bytes that are no UTF-8 as
/// \xNN.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace kb::trace
