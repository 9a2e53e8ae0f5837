// Checks of command-line values for the commands about runs. Included by cmd_*.cc only, as it includes CLI11.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "sim/scenario/setting.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/table.h"

namespace kb::cli {

/// Refuses a command line where two of these options go to standard output: files called `-`, and flags, which print. Flags print one after the other.
inline void refuse_shared_standard_output(CLI::App& app, std::vector<CLI::Option*> outputs) {
  app.parse_complete_callback([outputs = std::move(outputs)] {
    const CLI::Option* first = nullptr;
    const auto takes_file = [](const CLI::Option* output) { return output->get_items_expected_max() > 0; };
    for (const CLI::Option* output : outputs) {
      if (output->empty() || (takes_file(output) && !is_standard_output(output->as<std::string>()))) continue;
      if (first != nullptr && (takes_file(first) || takes_file(output))) throw CLI::ValidationError("standard output can take one of " + first->get_name() + " and " + output->get_name() + "; name a file for the other");
      first = output;
    }
  });
}

/// `engine` becomes one of trace::kEngineWords.
inline void add_engine_option(CLI::App& app, std::string& engine) {
  app.add_option("--engine", engine, "What decides: tables (as on the robot), interpreter, or both, compared")
      ->check(CLI::IsMember(std::vector<std::string>(trace::kEngineWords.begin(), trace::kEngineWords.end())))
      ->capture_default_str();
}

/// A check made from a function that returns what is wrong with a text, or nothing. Only `type_name` describes what the option takes.
template <class Fault>
CLI::Validator refuse_if(Fault fault) {
  return CLI::Validator([fault](const std::string& text) -> std::string { return fault(text); }, "");
}

/// The same for a finite number; `good` accepts values, `wanted` describes them: "length in metres, such as 0.25". As a `transform` it also writes
/// a whole number as CLI11 understands it, which takes 010 for 8.
template <class Number, class Good>
CLI::Validator is_number(std::string wanted, Good good) {
  return CLI::Validator([wanted = std::move(wanted), good](std::string& text) -> std::string {
    Number number{};
    if (!source::read_number(text, number) || !good(number)) return diagnostics::quoted_code(text) + " is no " + wanted;
    if constexpr (std::is_integral_v<Number>) text = std::to_string(number);
    return "";
  }, "");
}

/// A whole number of things.
inline CLI::Validator is_count(std::uint32_t least, std::uint32_t most) {
  return is_number<std::uint32_t>(fmt::format("whole number from {} to {}", least, most), [least, most](std::uint32_t number) { return number >= least && number <= most; });
}

inline CLI::Validator is_duration() {
  return refuse_if([](const std::string& text) { return trace::parse_duration(text) ? "" : diagnostics::quoted_code(text) + " is no length of time from 1 us to 71 min, such as 10ms"; });
}

/// A length that is not negative, in metres: no other unit can be written.
inline CLI::Validator is_length() {
  return is_number<double>("length in metres, such as 0.25", [](double number) { return number >= 0.0 && number <= 1e6; });
}

/// The extension of a file's name, in lower case.
inline std::string ending(const std::string& path) {
  return source::lower(std::filesystem::path(path).extension().string());
}

/// Whether the name promises a picture in a format that kbc does not write.
inline bool is_other_picture(const std::string& path) {
  constexpr std::array<std::string_view, 12> kOthers{".bmp", ".eps", ".gif", ".jpeg", ".jpg", ".pdf", ".png", ".ps", ".svgz", ".tif", ".tiff", ".webp"};
  return std::find(kOthers.begin(), kOthers.end(), ending(path)) != kOthers.end();
}

inline CLI::Validator is_svg() {
  return refuse_if([](const std::string& text) { return is_other_picture(text) ? diagnostics::quoted_code(text) + " cannot be written; a picture is SVG (`.svg`)" : ""; });
}

inline CLI::Validator is_factor() {
  return is_number<double>("number above 0, such as 2.5", [](double number) { return number > 0.0; });
}

inline CLI::Validator is_port() {
  return is_number<std::uint16_t>("port; it is a whole number up to 65535, 0 for any that is free", [](std::uint16_t) { return true; });
}

/// A whole number below 2^64 that is a seed, a count, ... CLI11's own reader takes -1 for the largest.
inline CLI::Validator is_whole_number(const std::string& what) {
  return is_number<std::uint64_t>(what + "; it is a whole number, such as 7", [](std::uint64_t) { return true; });
}

inline CLI::Validator is_tick() {
  return is_number<std::uint64_t>("tick; the first is 1", [](std::uint64_t number) { return number > 0; });
}

inline CLI::Validator is_tick_range() {
  return refuse_if([](const std::string& text) { return trace::parse_ticks(text) ? "" : diagnostics::quoted_code(text) + " is no range of ticks, such as 7-19"; });
}

inline CLI::Validator is_sweep() {
  return refuse_if([](const std::string& text) {
    std::string why;
    return sim::read_sweep(text, why) ? "" : diagnostics::quoted_code(text) + ": " + why;
  });
}

}  // namespace kb::cli
