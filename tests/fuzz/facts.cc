// Any bytes as a facts CSV, read in pieces of a length that the first byte says.
#include <cstdint>
#include <string_view>

#include "compiler/diagnostics/consumers.h"
#include "tools/kbc/trace/facts_csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

kb::program::Program make_program() {
  kb::program::Program program;
  for (const char* name : {"Line", "Safe", "In.N", "In.S", "Near[left,far]", "\u0421\u0442\u0430\u0440\u04421"}) {
    kb::program::Cell fact;
    fact.name = name;
    program.cells.push_back(fact);
    ++program.facts;
  }
  kb::program::Cell satellite;
  satellite.name = "sat Line";
  satellite.kind = kb::program::CellKind::kSatellite;
  program.cells.push_back(satellite);
  ++program.satellites;
  return program;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const kb::program::Program program = make_program();
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  kb::source::Sources sources;
  kb::diagnostics::CountingConsumer consumer;
  kb::diagnostics::Diagnostics messages(sources, consumer);
  kb::trace::MemoryStream stream(bytes, data[0] % 64 + 1u);
  kb::trace::FactsReader reader("facts.csv", stream, program, sources, messages);
  if (!reader.open()) return 0;
  while (reader.next() != nullptr) {
  }
  return 0;
}
