// Mistakes of command lines, which CLI11 finds, in words of ours.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace kb::cli {

/// One sentence; CLI11's own, if this kind of mistake is not known here.
[[nodiscard]] std::string usage_words(const CLI::ParseError& error);

}  // namespace kb::cli
