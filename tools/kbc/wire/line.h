// What a robot says to who drives it: one line of JSON for each control period. docs/driving.md explains each field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <waymark/controllers/senses.h>

#include "sim/robot/sensors.h"
#include "tools/kbc/wire/guide.h"
#include "tools/kbc/wire/mistake.h"
#include "tools/kbc/wire/vehicle.h"

namespace kb::wire {

/// A name, and where in the line it stands.
struct Name {
  std::string text;
  source::Span at{};
};

/// What the reader says of the tag below it.
struct Tag {
  Name landmark, exit;             ///< on whose road it lies: `LM5`, `W`
  bool safe = true;                ///< the crossing may be entered
  std::vector<Name> closed;        ///< exits whose roads must not be taken
};

struct Line {
  struct Said { Name fact; std::optional<float> value; };   ///< no value: the host says nothing of it any more
  std::int64_t t_us = 0;
  mts::Senses senses;
  std::optional<Guide> guide;      ///< in place of the darknesses: `line` is silent in `senses`
  bool reader = false;             ///< the tag reader works
  std::optional<Tag> tag;          ///< what it reads; nothing: no tag
  std::vector<Name> buttons;       ///< that are pressed
  std::vector<Said> facts;
  Vehicle vehicle;
  std::vector<ActionWord> actions;
  source::Span t_at{};             ///< where the time stands
};

/// What a line says, or the first mistake in it. Names are not looked up. O(bytes).
[[nodiscard]] std::variant<Line, Mistake> read_line(std::string_view text);

/// The same senses, and the tag as a reader of the simulator hears it, as a line without line break. Reads back as the same floats.
[[nodiscard]] std::string print_line(std::int64_t t_us, const mts::Senses& senses, const sim::TagHeard& tag, const std::vector<std::string>& buttons);

/// A line that was understood, with the answer to it in the field `answered`, in place of one that it brought: as recordings have it.
[[nodiscard]] std::string with_answer(std::string_view line, std::string_view answer);

/// The names and meanings of the fields, for `kbc drive --describe`.
struct FieldHelp { std::string_view name, unit, about; };
[[nodiscard]] const std::vector<FieldHelp>& line_fields();

}  // namespace kb::wire
