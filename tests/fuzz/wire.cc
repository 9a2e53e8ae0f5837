// Any bytes, line by line, as what a robot says and as what its driver answers.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/reading.h"
#include "tools/kbc/wire/answer.h"
#include "tools/kbc/wire/line.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::string_view line = kb::take_line(rest);
    const auto said = kb::wire::read_line(line);
    if (const auto* mistake = std::get_if<kb::wire::Mistake>(&said)) static_cast<void>(kb::wire::print_answer(*mistake, 1));
    else if (const auto again = kb::wire::read_line(kb::wire::with_answer(line, "{}")); !std::holds_alternative<kb::wire::Line>(again)) std::abort();
    const auto answered = kb::wire::read_answer(line);
    if (const auto* answer = std::get_if<kb::wire::Answer>(&answered)) static_cast<void>(kb::wire::print_answer(*answer));
  }
  return 0;
}
