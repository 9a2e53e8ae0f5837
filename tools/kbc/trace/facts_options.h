// Options in comments before the header of a file of facts: `# dt: 10 ms, kb: mission.kb`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/trace/stream.h"

namespace kb::trace {

/// The default length of a tick, in microseconds.
inline constexpr std::uint32_t kDefaultTickUs = 100'000;
/// The longest time between two rows, in microseconds: what a tick's clock can count.
inline constexpr std::int64_t kMaxStepUs = 0xFFFFFFFF;

/// The latest time of a row, and the earliest below 0, in seconds (some 30,000 years): what lies beyond does not fit the clock.
inline constexpr double kMaxTimeS = 1e12;

/// Microseconds in `10ms`, `0.5 s`, `200 us`, `2 min`; nothing if it is no length of time, or outside [1 us,
/// kMaxStepUs].
[[nodiscard]] std::optional<std::uint32_t> parse_duration(std::string_view text);

struct FactsOptions {
  std::optional<std::uint32_t> dt_us;  ///< `dt`: how long each tick is
  std::optional<bool> steady;  ///< `empty: as before`: an empty field of a fact repeats the row before instead of meaning "no data"
  bool again = false;          ///< `empty: measured again`: the same, and an empty field of a sensor is its last reading, measured anew on this tick
  std::optional<std::uint32_t> every_us;  ///< `every`: between two rows that lie farther apart, ticks are filled in with the facts of the first
  std::vector<std::string_view> compare;  ///< `compare`: the keys of a trace that `kbc test` compares; empty: all. Static text
  std::string program;  ///< `kb`: the knowledge base, relative to the file of facts; empty: the one beside it
};

/// One `key: value` of a comment: the bytes of the value, and whether it could be read.
struct OptionItem {
  std::uint32_t begin = 0, end = 0;
  bool names_program = false;   ///< it is `kb`
  std::string_view wanted;      ///< what the value must be: "a length of time, such as `10 ms`"
  bool good = false;
};

/// Takes the options out of a comment line. If its first word is not a key, nor similar to one, it is just a comment: empty.
std::vector<OptionItem> read_option_comment(std::string_view line, FactsOptions& options);

/// The options of a file of facts, without reading its header; mistakes in them are left to FactsReader. `each` is called with
/// every option and its line.
[[nodiscard]] FactsOptions peek_options(ByteStream& bytes, const std::function<void(const LineReader::Line&, const OptionItem&)>& each = {});

}  // namespace kb::trace
