// Checks of what the commands about runs take on the command line. Included by cmd_*.cc only: it brings CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "sim/batch/fields.h"
#include "sim/scenario/setting.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/table.h"

namespace kb::cli {

/// No two of these options go to standard output: files that are called `-`, and flags, which print.
inline void refuse_shared_standard_output(CLI::App& app, std::vector<CLI::Option*> outputs) {
  app.parse_complete_callback([outputs = std::move(outputs)] {
    const CLI::Option* first = nullptr;
    for (const CLI::Option* output : outputs) {
      const bool file = output->get_items_expected_max() > 0;
      if (output->empty() || (file && output->as<std::string>() != "-")) continue;
      if (first != nullptr) throw CLI::ValidationError("standard output can take one of " + first->get_name() + " and " + output->get_name() + "; name a file for the other");
      first = output;
    }
  });
}

/// A folder's name: an empty one, such as a variable of the shell that is not set makes it, is none.
inline CLI::Validator is_folder() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("this names no folder") : std::string(); }, "DIR");
}

inline CLI::Validator is_duration() {
  return CLI::Validator(
      [](std::string& text) {
        return trace::parse_duration(text) ? std::string() : diagnostics::between_backticks(text) + " is no length of time, such as 10ms";
      },
      "TIME");
}

/// A length that is not negative; in metres, for nothing else is written.
inline CLI::Validator is_length() {
  return CLI::Validator(
      [](std::string& text) {
        double number = 0.0;
        const bool good = sim::batch::read_number(text, number) && number >= 0.0 && number <= 1e6;
        return good ? std::string() : text + " is no length in metres, such as 0.25";
      },
      "METRES");
}

/// A number above 0 that is no infinity.
inline CLI::Validator is_factor() {
  return CLI::Validator(
      [](std::string& text) {
        double number = 0.0;
        const bool good = sim::batch::read_number(text, number) && number > 0.0;
        return good ? std::string() : diagnostics::between_backticks(text) + " is no number above 0, such as 2.5";
      },
      "FACTOR");
}

inline CLI::Validator is_port() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint16_t number = 0;
        return sim::batch::read_number(text, number) ? std::string() : diagnostics::between_backticks(text) + " is no port; it is a whole number up to 65535, 0 for any that is free";
      },
      "PORT");
}

/// A whole number below 2^64. The command line's own reader takes -1 for the largest of them.
inline CLI::Validator is_seed() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t number = 0;
        return sim::batch::read_number(text, number) ? std::string() : diagnostics::between_backticks(text) + " is no seed; it is a whole number, such as 7";
      },
      "N");
}

inline CLI::Validator is_sweep() {
  return CLI::Validator(
      [](std::string& text) {
        std::string why;
        return sim::read_sweep(text, why) ? std::string() : text + ": " + why;
      },
      "KEY=V1,V2,...");
}

inline CLI::Validator is_tick() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t number = 0;
        const bool good = sim::batch::read_number(text, number) && number > 0;
        return good ? std::string() : text + " is no tick; the first is 1";
      },
      "TICK");
}

inline CLI::Validator is_tick_range() {
  return CLI::Validator(
      [](std::string& text) {
        return trace::parse_ticks(text) ? std::string() : text + " is no range of ticks, such as 7-19";
      },
      "TICKS");
}

}  // namespace kb::cli
