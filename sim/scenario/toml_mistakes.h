// What is wrong with a text that is no TOML, in the words of people who know little of TOML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kb::sim {

/// The well-known mistake at the byte `at` of `bytes`, where the TOML library gave up and said `description`; empty if it is none. It reads
/// the line of `at`, and the head of the table above it.
[[nodiscard]] std::string toml_mistake(std::string_view bytes, std::size_t at, std::string_view description);

/// The number at the beginning of a text, as TOML writes it: `0.3` for `0,3 m/s`; empty if there is none.
[[nodiscard]] std::string number_at(std::string_view text);

}  // namespace kb::sim
