// Two traces side by side: where they differ, in words.
//
// The first is what is expected, the second what happened. Lines are compared as JSON, so layout and the order of keys
// do not matter; the order of events and of fired rules does.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::trace {

/// What a tick of a trace has besides `tick` and `t`; the most important first: what ran, then why.
inline constexpr std::array<std::string_view, 8> kTraceKeys{"strategy", "status", "events", "lost", "fired", "set", "conflicts", "cf"};

/// How two ticks (lines of JSON) differ, one sentence each; empty if they say the same. Both must be JSON objects.
[[nodiscard]] std::vector<std::string> compare_ticks(std::string_view expected, std::string_view actual);

/// Why a line is not a tick of a trace (not JSON, no object); empty if it is one.
[[nodiscard]] std::string tick_fault(std::string_view line);

/// The line with `tick`, `t` and these keys only; no keys: all of it. A line that is no tick stays as it is.
[[nodiscard]] std::string with_keys(std::string_view line, const std::vector<std::string_view>& keys);

/// Compares traces line by line, in constant memory.
class TraceDiffer {
 public:
  static constexpr std::size_t kContext = 2;  ///< ticks shown before the first difference
  static constexpr std::size_t kShown = 3;    ///< ticks that differ and are shown in full

  /// Compares the next line of both traces; nothing if a trace has ended.
  void compare(std::optional<std::string_view> expected, std::optional<std::string_view> actual);
  [[nodiscard]] bool same() const { return differing_ == 0; }
  /// The differences for people, indented by two blanks; empty if there are none.
  [[nodiscard]] std::string report() const;

 private:
  std::uint64_t ticks_ = 0, differing_ = 0, missing_ = 0, surplus_ = 0;
  std::deque<std::string> before_;  // the last ticks that agreed
  std::string text_;
};

}  // namespace kb::trace
