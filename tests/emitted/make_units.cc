// Writes emitted C++ for random programs, several to a translation unit:
//   make_units OUT_DIR UNITS PROGRAMS_EACH
// Those that have a compact form are written in it as well.
// OUT_DIR/unit_N.cc, and OUT_DIR/cases.inc that names all cases for main.cc.
#include <cstdlib>
#include <fstream>
#include <string>

#include "compiler/emit/emit.h"
#include "compiler/tables/compact.h"
#include "tests/unit/program/random_program.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string folder = argv[1];
  const unsigned units = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  const unsigned each = static_cast<unsigned>(std::strtoul(argv[3], nullptr, 10));
  std::ofstream cases(folder + "/cases.inc");
  std::uint64_t seed = 0;
  for (unsigned u = 0; u < units; ++u) {
    std::ofstream unit(folder + "/unit_" + std::to_string(u) + ".cc");
    unit << "#include \"tests/emitted/compare.h\"\n";
    for (unsigned k = 0; k < each; ++k) {
      const std::string name = "random_" + std::to_string(++seed);
      const auto program = kb::program::testing::random_program(seed);
      // Every second one as if it were large, so that the mechanisms for large programs are emitted too.
      const auto tables = kb::tables::build(program, seed % 2 == 0 ? kb::tables::Limits{} : kb::tables::Limits{2, 0});
      const auto cpp = kb::emit::cpp(program, tables, {name, name + ".kb.h"});
      std::ofstream(folder + "/" + name + ".kb.h") << cpp.header;
      std::ofstream(folder + "/" + name + ".kb.cc") << cpp.source;
      unit << "#include \"" << name << ".kb.cc\"\n"
           << "bool run_" << name << "() { return kb::emitted::agrees<" << name << "::Knowledge>(" << seed << "); }\n";
      cases << "KB_CASE(" << name << ")\n";
      if (!kb::tables::against_compact(tables, program).empty()) continue;
      const std::string small = "compact_" + std::to_string(seed);
      const auto compact = kb::emit::cpp(program, tables, {small, small + ".kb.h", true});
      std::ofstream(folder + "/" + small + ".kb.h") << compact.header;
      std::ofstream(folder + "/" + small + ".kb.cc") << compact.source;
      unit << "#include \"" << small << ".kb.cc\"\n"
           << "bool run_" << small << "() { return kb::emitted::agrees<" << small << "::Knowledge, " << small << "::Mind>(" << seed << "); }\n";
      cases << "KB_CASE(" << small << ")\n";
    }
    if (!unit) return 1;
  }
  return cases ? 0 : 1;
}
