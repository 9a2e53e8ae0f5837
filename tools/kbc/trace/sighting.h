// How a fact came by its certainty on one tick, for `kbc why`.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace kb::trace {

/// A perceived fact as a look found it, or a fact that was given as no certainty.
struct Sighting {
  /// What the definition asks: a comparison of a reading, or another fact.
  struct Part {
    std::string condition;       ///< `range ~ near`, `tag ~ "LM7"`, or the name of the fact
    float certainty = 0.0f;
    bool compares = false;       ///< a reading
    std::variant<std::monostate, float, std::string> reading{};   ///< nothing: there is no reading, or it is a text that the program does not know
    bool read = false;           ///< there is a reading
    std::string unit{};          ///< of a number, as the sensor declares it
    double age_s = 0.0;
  };
  std::string fact;
  std::string definition;        ///< empty: it was given
  float certainty = 0.0f;        ///< as perceived or as given, which may be no certainty
  float counts_as = 0.0f;
  bool asleep = false;           ///< lazy, and nobody waited for it: nothing was looked at
  std::vector<Part> parts{};     ///< in the order of the definition
};

/// For people: a line for the fact, and one for each part.
[[nodiscard]] std::string print(const Sighting& sighting);
/// For programs: see docs/outputs.md.
[[nodiscard]] nlohmann::ordered_json json_sighting(const Sighting& sighting);

}  // namespace kb::trace
