#include "compiler/model/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// A value is multiplied and then divided, so that 20 cm are 20 / 100, exactly 0.2, and not 20 * 0.01.
struct Unit {
  std::string_view name;
  std::string_view si;
  double multiply;
  double divide;
};

constexpr std::array kUnits = {
    Unit{"m", "m", 1, 1},
    Unit{"cm", "m", 1, 100},
    Unit{"mm", "m", 1, 1000},
    Unit{"km", "m", 1000, 1},
    Unit{"s", "s", 1, 1},
    Unit{"ms", "s", 1, 1000},
    Unit{"us", "s", 1, 1'000'000},
    Unit{"min", "s", 60, 1},
    Unit{"h", "s", 3600, 1},
    Unit{"deg", "deg", 1, 1},
    Unit{"rad", "deg", 180, std::numbers::pi},
    Unit{"m/s", "m/s", 1, 1},
    Unit{"cm/s", "m/s", 1, 100},
    Unit{"mm/s", "m/s", 1, 1000},
    Unit{"km/h", "m/s", 1, 3.6},
    Unit{"deg/s", "deg/s", 1, 1},
    Unit{"rad/s", "deg/s", 180, std::numbers::pi},
    Unit{"%", "", 1, 100},
};

/// Names of units elsewhere, some of which are no slips of the right one but of another.
struct Alias { std::string_view name, unit; };
constexpr std::array kAliases = {
    Alias{"mps", "m/s"},       Alias{"cmps", "cm/s"},  Alias{"mmps", "mm/s"},    Alias{"kmh", "km/h"},   Alias{"kmph", "km/h"},
    Alias{"kph", "km/h"},      Alias{"dps", "deg/s"},  Alias{"degps", "deg/s"},  Alias{"radps", "rad/s"}, Alias{"rads", "rad/s"},
    Alias{"degrees", "deg"},   Alias{"degree", "deg"}, Alias{"radians", "rad"},  Alias{"radian", "rad"}, Alias{"metres", "m"},
    Alias{"metre", "m"},       Alias{"meters", "m"},   Alias{"meter", "m"},      Alias{"seconds", "s"},  Alias{"second", "s"},
    Alias{"secs", "s"},        Alias{"sec", "s"},      Alias{"minutes", "min"},  Alias{"mins", "min"},   Alias{"hours", "h"},
    Alias{"msec", "ms"},       Alias{"usec", "us"},    Alias{"percent", "%"},    Alias{"mph", ""},       Alias{"rpm", ""},
    Alias{"rps", ""},
};

/// The unit that was meant; nothing if the language has no such unit.
std::optional<std::string> meant_unit(std::string_view name, std::span<const std::string_view> units) {
  for (const Alias& alias : kAliases) {
    if (alias.name == name) return alias.unit.empty() ? std::nullopt : std::optional<std::string>(alias.unit);
  }
  return diagnostics::closest(name, units);
}

const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return &unit;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string_view> unit_names() {
  std::vector<std::string_view> out;
  for (const Unit& unit : kUnits) out.push_back(unit.name);
  return out;
}

std::optional<Quantity> to_si(const syntax::Number& number, diagnostics::Diagnostics& diagnostics) {
  if (number.unit.text.empty()) return Quantity{number.value, {}};
  if (const Unit* unit = find_unit(number.unit.text)) {
    return Quantity{number.value * unit->multiply / unit->divide, unit->si};
  }
  const std::vector<std::string_view> candidates = unit_names();
  const auto better = meant_unit(number.unit.text, candidates);
  auto message = diagnostics.report(Kind::kUnknownUnit, number.unit.span, {number.unit.text});
  if (better) message.suggest(better);
  else message.note(Kind::kUnitsAre, {}, {fmt::format("`{}`", fmt::join(candidates, "`, `"))});
  return std::nullopt;
}

bool same_quantity(const syntax::Number& a, const syntax::Number& b) {
  const Unit* one = find_unit(a.unit.text);
  const Unit* other = find_unit(b.unit.text);
  if (one == nullptr || other == nullptr) return a.value == b.value && a.unit.text == b.unit.text;
  return one->si == other->si && a.value * one->multiply / one->divide == b.value * other->multiply / other->divide;
}

std::optional<std::uint32_t> to_microseconds(const syntax::Number& number, diagnostics::Diagnostics& diagnostics) {
  constexpr double kLongest = 4294967295.0;
  const std::string text = syntax::number_text(number);
  const Unit* unit = find_unit(number.unit.text);
  if (number.unit.text.empty()) {
    if (number.value == 0.0) return 0;
    diagnostics.report(Kind::kNoTimeUnit, number.span, {text, text, text});
    return std::nullopt;
  }
  if (unit == nullptr || unit->si != "s") {
    diagnostics.report(Kind::kNotATimeUnit, number.unit.span, {number.unit.text});
    return std::nullopt;
  }
  const double exact = number.value * unit->multiply * 1e6 / unit->divide;
  if (number.value < 0.0) {
    diagnostics.report(Kind::kNegativeDuration, number.span, {text});
  } else if (exact > 0.0 && exact < 1.0) {
    diagnostics.report(Kind::kTimeTooShort, number.span, {text});
  } else if (std::round(exact) > kLongest) {
    diagnostics.report(Kind::kTimeTooLong, number.span, {text, "4294.967295"});
  } else {
    return static_cast<std::uint32_t>(std::llround(exact));
  }
  return std::nullopt;
}

}  // namespace kb::model
