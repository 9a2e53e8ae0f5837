// Any bytes: tokens, a tree, its printed forms; and what parses without error can be formatted, stays the same tree, and
// is formatted to itself.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kb;
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  const auto file = sources.add("fuzz.kb", std::string(reinterpret_cast<const char*>(data), size));
  (void)syntax::print_tokens(sources, syntax::lex(sources, file, messages));
  const auto tree = syntax::parse(sources, file, messages);
  (void)syntax::print_tree(sources, tree);
  if (messages.failed()) return 0;
  const auto once = sources.add("once.kb", syntax::format(sources, file));
  (void)syntax::parse(sources, once, messages);
  if (messages.failed()) std::abort();
  if (syntax::format(sources, once) != sources.bytes(once)) std::abort();
  return 0;
}
