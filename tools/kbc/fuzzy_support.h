// What the commands about fuzzy controllers share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/kbc/support.h"

namespace kb::cli {

/// The controller called `name`, or the only one if `name` is empty; null (reported) if there is none, or more than one.
[[nodiscard]] inline const fuzzy::Controller* find_fuzzy(const std::vector<fuzzy::Controller>& all, const std::string& file, const std::string& name,
                                                         diagnostics::Diagnostics& diagnostics) {
  std::vector<std::string_view> names;
  for (const fuzzy::Controller& controller : all) {
    if (controller.name == name || (name.empty() && all.size() == 1)) return &controller;
    names.push_back(controller.name);
  }
  std::string which = name.empty() ? "" : " `" + name + "`";
  if (name.empty() && !all.empty()) which = fmt::format(" that is the only one; name one of its {}: {}", all.size(), fmt::join(names, ", "));
  diagnostics.report(diagnostics::Kind::kNoFuzzy, {}, {file, which}).suggest(diagnostics::closest(name, names));
  return nullptr;
}

}  // namespace kb::cli
