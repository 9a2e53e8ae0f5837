// Any bytes as an FLL engine. A fuzzy controller that is made of it must be a knowledge base that parses.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/fll/fll.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kb;
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  const auto engine = sources.add("engine.fll", std::string(reinterpret_cast<const char*>(data), size));
  const auto text = fll::import_engine(sources, engine, messages);
  if (text.has_value() == messages.failed()) std::abort();   // taken over, or told why not
  if (!text) return 0;
  static_cast<void>(syntax::parse(sources, sources.add("made.kb", *text), messages));
  if (!messages.failed()) return 0;
  std::fprintf(stderr, "does not parse:\n%s\n", text->c_str());
  std::abort();
}
