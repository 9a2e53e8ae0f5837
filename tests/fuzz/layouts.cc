// Any bytes as a layout: XML as a plant model of openTCS, all else as LIF and as a route graph of Nav2. A map that is made of one must be
// a knowledge base that parses.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/layout/layout.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb;

void try_as(layout::Reader read, const std::string& bytes) {
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  const auto file = sources.add("fuzz", bytes);
  layout::Adaptations adaptations;
  const auto layout = read(sources, file, {}, adaptations, messages);
  const auto roads = layout ? layout::roads_of(*layout, adaptations, messages) : std::nullopt;
  adaptations.report(messages);
  if (!roads) return;
  layout::Wording wording;
  wording.file = wording.format = "fuzz";
  wording.taken = [](std::string_view name) { return std::ranges::find(syntax::words(), name) != syntax::words().end(); };
  const auto names = layout::landmark_names(*layout, wording);
  std::string text = layout::write_map(*layout, *roads, names, wording);
  if (names.size() > 1) {
    const std::string stops[] = {layout->places.front().id, layout->places.back().id};
    if (const auto mission = layout::write_mission(*layout, *roads, names, wording, stops, messages)) text += *mission;
  }
  const std::size_t before = messages.errors();
  static_cast<void>(syntax::parse(sources, sources.add("made.kb", text), messages));
  if (messages.errors() == before) return;
  std::fprintf(stderr, "does not parse:\n%s\n", text.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('<')) {
    try_as(layout::read_opentcs, bytes);
  } else {
    try_as(layout::read_lif, bytes);
    try_as(layout::read_nav2, bytes);
  }
  return 0;
}
