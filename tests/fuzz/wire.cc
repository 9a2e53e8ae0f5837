// Any bytes, line by line, as what a robot says and as what its driver answers.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/kbc/wire/answer.h"
#include "tools/kbc/wire/line.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(line.size() < rest.size() ? line.size() + 1 : line.size());
    const auto said = kb::wire::read_line(line);
    if (const auto* mistake = std::get_if<kb::wire::Mistake>(&said)) static_cast<void>(kb::wire::print_answer(*mistake, 1));
    else if (const auto again = kb::wire::read_line(kb::wire::with_answer(line, "{}")); !std::holds_alternative<kb::wire::Line>(again)) std::abort();
    const auto answered = kb::wire::read_answer(line);
    if (const auto* answer = std::get_if<kb::wire::Answer>(&answered)) static_cast<void>(kb::wire::print_answer(*answer));
  }
  return 0;
}
