// What who drives a robot says to it: one line of JSON for each line that it was told. docs/driving.md explains each field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <waymark/controllers/senses.h>

#include "tools/kbc/wire/mistake.h"

namespace kb::wire {

/// What the host is to do besides driving, as long as it stands in the answers.
struct Action {
  std::string id, type;
  std::string parameters;                ///< JSON, an object in one line; empty: `{}`
};

struct Answer {
  std::optional<std::int64_t> t_us;      ///< of the line that it answers; nothing: that line could not be read
  mts::Motion wheels;
  std::string strategy, controller;      ///< what drives; empty: nothing does
  std::optional<bool> mission;           ///< a mission is in hand; nothing: the driver does not say
  std::string leg, goal;                 ///< the current one, and the landmark it leads to; empty: none
  std::vector<std::string> reports;      ///< `Help.lost`
  mts::Plight plight = mts::Plight::kNone;
  bool lost = false;                     ///< what drives has lost what it follows, or driven all of it
  bool waits = false;                    ///< it stands until a button is pressed
  std::vector<Action> actions;           ///< in the order of their beginning; not read back
  std::string mind;                      ///< the tick that came before, JSON as `kbc run --trace` writes it; empty: there was none
  std::optional<std::vector<std::string>> seen;   ///< with a tick: the facts that are seen after it
};

/// Without line break; all but `waits`, `actions`, `mind` and `seen`, which are there where there is something to say.
[[nodiscard]] std::string print_answer(const Answer& answer);
/// Wheels 0, and what was wrong with line `line`.
[[nodiscard]] std::string print_answer(const Mistake& mistake, std::uint64_t line);
/// Wheels 0, as the last thing that is said: `why` it ends.
[[nodiscard]] std::string print_end(std::string_view why);

/// What a driver answered, or the first mistake in it. Only `speed` and `turn` must be there; what is not known is passed over.
[[nodiscard]] std::variant<Answer, Mistake> read_answer(std::string_view text);

}  // namespace kb::wire
