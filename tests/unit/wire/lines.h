// Lines as tests read them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "tools/kbc/wire/line.h"

namespace kb::wire {

/// A line in which nothing may be wrong.
inline Line good(std::string_view text) {
  auto read = read_line(text);
  if (const auto* mistake = std::get_if<Mistake>(&read)) {
    ADD_FAILURE() << text << ": " << message_of(*mistake);
    return {};
  }
  return std::get<Line>(std::move(read));
}

/// Code, field and message of what is wrong.
inline std::string wrong(std::string_view text) {
  const auto read = read_line(text);
  const auto* mistake = std::get_if<Mistake>(&read);
  if (mistake == nullptr) return "nothing is wrong";
  return diagnostics::code_text(mistake->kind) + " " + mistake->field + ": " + message_of(*mistake);
}

}  // namespace kb::wire
