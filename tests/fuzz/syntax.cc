// Any bytes: tokens, a tree, its printed forms; and what parses without error can be formatted, stays the same tree, and
// is formatted to itself. At any place it can be asked what may be written there.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kPlaces = 32;   // of a text: each costs as much as to read it

void ask_anywhere(const kb::source::Sources& sources, kb::source::FileId file) {
  const std::size_t size = sources.bytes(file).size();
  for (std::size_t at = 0; at < size; at += size / kPlaces + 1) (void)kb::syntax::wanted_at(sources, file, static_cast<std::uint32_t>(at));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kb;
  Reading in;
  const auto file = in.sources.add("fuzz.kb", std::string(reinterpret_cast<const char*>(data), size));
  (void)syntax::print_tokens(in.sources, syntax::lex(in.sources, file, in.messages));
  const auto tree = syntax::parse(in.sources, file, in.messages);
  (void)syntax::print_tree(in.sources, tree);
  ask_anywhere(in.sources, file);
  if (in.messages.failed()) return 0;
  const auto once = in.sources.add("once.kb", syntax::format(in.sources, file));
  (void)syntax::parse(in.sources, once, in.messages);
  if (in.messages.failed()) std::abort();
  if (syntax::format(in.sources, once) != in.sources.bytes(once)) std::abort();
  return 0;
}
