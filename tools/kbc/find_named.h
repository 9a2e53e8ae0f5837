// One of several things with names: the one that a command line means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/kbc/support.h"

namespace kb::cli {

/// The thing called `name`, or the only one if `name` is empty; null if there is none, or more than one. Then `report` is called with what
/// stands behind "has no controller": "", " `Steer`", or the names to choose from; it returns the message.
template <class Thing, class Report>
[[nodiscard]] const Thing* find_named(const std::vector<Thing>& all, const std::string& name, Report report) {
  std::vector<std::string_view> names;
  for (const Thing& thing : all) {
    if (thing.name == name || (name.empty() && all.size() == 1)) return &thing;
    names.push_back(thing.name);
  }
  std::string which = name.empty() ? "" : " `" + name + "`";
  if (name.empty() && !all.empty()) which = fmt::format(" that is the only one; name one of its {}: {}", all.size(), fmt::join(names, ", "));
  report(which).suggest(diagnostics::closest(name, names));
  return nullptr;
}

[[nodiscard]] inline const fuzzy::Controller* find_fuzzy(const std::vector<fuzzy::Controller>& all, const std::string& file, const std::string& name,
                                                         diagnostics::Diagnostics& diagnostics) {
  return find_named(all, name, [&](const std::string& which) { return diagnostics.report(diagnostics::Kind::kNoFuzzy, {}, {file, which}); });
}

}  // namespace kb::cli
