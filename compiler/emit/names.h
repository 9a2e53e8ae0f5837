// Every name in emitted C++ is made here.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/fleet.h"
#include "compiler/tables/form.h"

namespace kb::emit {

/// A C++ identifier that looks like `name`: letters (of any script), digits and single underscores; anything else becomes
/// an underscore; a C++ keyword gets one appended. `Cross[right,mark]` -> `Cross_right_mark`.
[[nodiscard]] std::string identifier(std::string_view name);

/// Identifiers of one scope: each is handed out once; a second request for the same one gets a number appended.
class Scope {
 public:
  /// `taken`: names that the scope has already.
  explicit Scope(std::initializer_list<std::string_view> taken = {});
  [[nodiscard]] std::string make(std::string_view name);

 private:
  std::set<std::string, std::less<>> taken_;
};

/// The identifiers of a knowledge base's things, by their index.
struct Names {
  std::vector<std::string> facts, satellites, strategies, rules;   ///< members of the enumerations
  std::vector<std::string> atoms;                                  ///< in emitted tables
};
[[nodiscard]] Names make_names(const program::Program& program, const tables::Tables& tables);

/// The scope of controllers' types; it already holds the names that an emitted header or source declares itself.
[[nodiscard]] Scope type_scope();

/// The identifiers of one fuzzy controller. A quantity carries its unit: `speed_m_per_s`.
struct FuzzyNames {
  std::string type;                           ///< `GoToGoal`
  std::vector<std::string> inputs, outputs;   ///< fields
};
[[nodiscard]] std::vector<FuzzyNames> make_fuzzy_names(const program::Program& program);

/// What a plane stands for, in words.
[[nodiscard]] std::string plane_text(const program::Program& program, const tables::FleetForm& form, const tables::FleetPlane& plane);

/// The identifiers of a fleet's kernel.
struct FleetNames {
  std::vector<std::string> planes, texts;   ///< by plane; `texts` describes it in words
  std::vector<std::string> fire;            ///< by rule
  std::vector<std::string> steps;           ///< by step: the name of its value
};
[[nodiscard]] FleetNames make_fleet_names(const program::Program& program, const tables::FleetForm& form);

/// "m/s" -> "m_per_s".
[[nodiscard]] std::string unit_suffix(std::string_view unit);

/// The inline namespace of emitted C++, `kb_5f3a9c21d40e77b6`: named after the fingerprint of the code in it. See
/// note [two minds of one name].
[[nodiscard]] std::string version_name(std::string_view declared, std::string_view defined);

/// `route1` for "maps/route1.kb".
[[nodiscard]] std::string name_space_for(std::string_view path);

}  // namespace kb::emit
