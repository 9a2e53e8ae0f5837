// Any bytes as an FLL engine. A fuzzy controller that is made of it must be a knowledge base that parses.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/fuzz/reading.h"
#include "tools/kbc/fll/fll.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kb;
  Reading in;
  const auto engine = in.sources.add("engine.fll", std::string(reinterpret_cast<const char*>(data), size));
  const auto text = fll::import_engine(in.sources, engine, in.messages);
  if (text.has_value() == in.messages.failed()) std::abort();   // taken over, or told why not
  if (text) require_parse(in, *text);
  return 0;
}
