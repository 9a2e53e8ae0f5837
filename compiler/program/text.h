// Numbers and strings as the printers of this folder write them: the same bytes under every locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kb::program {

/// The fewest digits that read back as the same value: "0.6", "-1", "1e-05".
void append_number(std::string& out, float value);
void append_number(std::string& out, double value);
/// Microseconds as seconds, exactly: "0.4", "12", "0.000001".
void append_seconds(std::string& out, std::int64_t time_us);
/// The same as a text of its own.
[[nodiscard]] std::string seconds_text(std::int64_t time_us);
/// A JSON string, quoted and escaped.
void append_json(std::string& out, std::string_view text);

/// Writes "," before every item but the first.
class Commas {
 public:
  explicit Commas(std::string_view separator = ",") : separator_(separator) {}
  void next(std::string& out) {
    if (!first_) out += separator_;
    first_ = false;
  }

 private:
  std::string_view separator_;
  bool first_ = true;
};

/// `,"key":`, before every value of a JSON object but the first.
void append_key(std::string& out, std::string_view key);
/// `[item,item]`; `append(item)` writes one.
template <class Items, class Append>
void append_items(std::string& out, const Items& items, Append&& append) {
  out += '[';
  Commas commas;
  for (const auto& item : items) {
    commas.next(out);
    append(item);
  }
  out += ']';
}

}  // namespace kb::program
