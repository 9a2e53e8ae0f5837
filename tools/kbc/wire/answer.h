// The driver's answers to a robot: one line of JSON for each line from the robot. docs/driving.md explains each field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <waymark/controllers/senses.h>

#include "tools/kbc/vda5050/condition.h"
#include "tools/kbc/wire/mistake.h"

namespace kb::wire {

struct Answer {
  std::optional<std::int64_t> t_us;      ///< time of the line that it answers; nothing: that line could not be read
  mts::Motion wheels;
  std::string strategy, controller;      ///< the strategy and the controller that drive; empty: none
  std::optional<bool> mission;           ///< whether a mission is in hand; nothing: the driver does not say
  std::string leg, goal;                 ///< the current leg and the landmark it leads to; empty: none
  std::vector<std::string> reports;      ///< `Help.lost`
  std::optional<std::vector<std::string>> outputs;   ///< the satellites declared `output` that are high; nothing: none is declared. Not read back
  mts::Plight plight = mts::Plight::kNone;
  bool lost = false;                     ///< the controller has lost what it follows, or driven all of it
  bool waits = false;                    ///< it stands until a button is pressed
  std::vector<vda5050::HostAction> actions;   ///< each as long as the host is to do it, in the order of their beginning; not read back
  std::string mind;                      ///< the tick before this answer, JSON as `kbc run --trace` writes it; empty: there was none
  std::optional<std::vector<std::string>> seen;   ///< only with a tick: the facts seen after it
};

/// The answer without line break. `waits`, `actions` and `mind` are included only if true or not empty, `seen` only with a tick, `outputs` if there
/// can be any; all else always.
[[nodiscard]] std::string print_answer(const Answer& answer);
/// An answer with wheels 0 and the mistake in line `line`. `actions`: as in Answer, for a mistake in a line ends none of them.
[[nodiscard]] std::string print_answer(const Mistake& mistake, std::uint64_t line, const std::vector<vda5050::HostAction>& actions = {});
/// The last answer, with wheels 0: `why` it ends.
[[nodiscard]] std::string print_end(std::string_view why);

/// Reads a driver's answer, or its first mistake. Only `speed` and `turn` must be there; unknown fields are ignored.
[[nodiscard]] std::variant<Answer, Mistake> read_answer(std::string_view text);

}  // namespace kb::wire
