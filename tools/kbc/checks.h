// Checks of what the commands about runs take on the command line. Included by cmd_*.cc only: it brings CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/table.h"

namespace kb::cli {

inline CLI::Validator is_duration() {
  return CLI::Validator(
      [](std::string& text) {
        return trace::parse_duration(text) ? std::string() : text + " is no length of time, such as 10ms";
      },
      "TIME");
}

inline CLI::Validator is_tick_range() {
  return CLI::Validator(
      [](std::string& text) {
        return trace::parse_ticks(text) ? std::string() : text + " is no range of ticks, such as 7-19";
      },
      "TICKS");
}

}  // namespace kb::cli
