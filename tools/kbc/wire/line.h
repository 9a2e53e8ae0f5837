// A robot's lines to its driver: one line of JSON for each control period. docs/driving.md explains each field.
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

/// A name and its place in the line.
struct Name {
  std::string text;
  source::Span at{};
};

/// The tag reader's report on the tag below it.
struct Tag {
  Name landmark, exit;             ///< the landmark, and the exit on whose road the tag lies: `LM5`, `W`
  bool safe = true;                ///< the crossing may be entered
  std::vector<Name> closed;        ///< exits whose roads must not be taken
};

struct Line {
  struct Said { Name fact; std::optional<float> value; };   ///< no value: the host no longer gives the fact
  using Value = std::variant<std::monostate, float, std::string>;   ///< nothing: the sensor is silent
  /// What a sensor of the knowledge base measured: one value, or those of an array.
  struct Measured { Name sensor; std::vector<Value> values; bool list = false; };
  std::int64_t t_us = 0;
  mts::Senses senses;
  double x_m = 0.0, y_m = 0.0, turned_rad = 0.0;   ///< those of `senses` as they were said: see note [odometry of any zero]
  std::optional<Guide> guide;      ///< in place of the darknesses: `line` is silent in `senses`
  bool reader = false;             ///< the tag reader works
  std::optional<Tag> tag;          ///< what it reads; nothing: no tag
  std::vector<Name> buttons;       ///< those that are pressed
  std::vector<Said> facts;
  std::vector<Measured> readings;
  Vehicle vehicle;
  std::vector<vda5050::HostActionState> actions;
  std::optional<float> turns_rad;  ///< the compass as it was said, if that is more than a full turn; `senses` have it without whole turns
  source::Span t_at{}, compass_at{}, vehicle_at{}, actions_at{};   ///< the places of the time, and of these fields; empty: it has them not
};

/// Reads a line, or its first mistake. Names are not looked up. O(bytes).
[[nodiscard]] std::variant<Line, Mistake> read_line(std::string_view text);

/// Senses, and the tag as the simulator's reader hears it, as a line without line break. It reads back as the same floats.
[[nodiscard]] std::string print_line(std::int64_t t_us, const mts::Senses& senses, const sim::TagHeard& tag, const std::vector<std::string>& buttons);

/// A line that was understood, with its answer in the field `answered`, which replaces any that it had. The form of recordings.
[[nodiscard]] std::string with_answer(std::string_view line, std::string_view answer);

/// The mistake of a name that nothing has: "there is no fact `Fier`". `better`: what was probably meant.
[[nodiscard]] Mistake no_such(std::string_view kind, const Name& name, std::string field, std::optional<std::string> better);

/// The names and meanings of the fields, for `kbc drive --describe`.
struct FieldHelp { std::string_view name, unit, about; };
[[nodiscard]] std::vector<FieldHelp> line_fields();

}  // namespace kb::wire
