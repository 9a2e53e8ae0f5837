// Any text as a knowledge base, with the standard library at hand: the whole compiler; and what compiles is a sound program
// whose tables decide as the interpreter does.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "compiler/emit/emit.h"
#include "compiler/program/interpret.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb;

/// Read once: a fuzzer must not go to the disk.
source::MemoryFileSystem library() {
  source::MemoryFileSystem files;
  const source::RealFileSystem real;
  for (const char* name : {"basics", "care", "crossing", "detour", "driving", "mission", "navigation", "obstacle", "pause", "retreat", "road", "route",
                           "search"}) {
    const std::string path = std::string("std/") + name + ".kb";
    auto result = real.read(std::string(KB_LIBRARY) + "/" + path);
    if (!result.bytes) std::abort();
    files.add("library/" + path, *result.bytes);
  }
  return files;
}

void compare(const driver::Compilation& c) {
  if (!program::verify(c.program).empty()) std::abort();
  program::Interpreter oracle(c.program);
  tables::Machine machine(c.program, c.tables);
  std::vector<float> facts(c.program.facts);
  std::uint32_t random = 1;
  for (int tick = 0; tick < 12; ++tick) {
    for (float& fact : facts) {
      random = random * 1664525u + 1013904223u;
      fact = static_cast<float>(random >> 24) / 127.5f - 1.0f;
    }
    if (!(oracle.tick(facts, 100'000) == machine.tick(facts, 100'000))) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const source::MemoryFileSystem standard = library();
  source::MemoryFileSystem files = standard;
  files.add("fuzz.kb", std::string(reinterpret_cast<const char*>(data), size));
  driver::Options options;
  options.library = "library";
  const auto c = driver::compile("fuzz.kb", files, options, diagnostics::CountingConsumer::make, nullptr);
  if (!c->ok()) return 0;
  if (c->program.rules.size() > 2'000) return 0;   // right, but slow to compare
  (void)program::print_json(c->program);
  (void)emit::cpp(c->program, c->tables, {"fuzz", "fuzz.kb.h"});
  compare(*c);
  return 0;
}
