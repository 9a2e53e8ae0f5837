// Writes emitted fleets for random programs: fleet_make_units OUT_DIR SEED... One file fleet_units.cc that includes all, and cases.inc.
#include <cstdlib>
#include <fstream>
#include <string>

#include "compiler/emit/emit.h"
#include "tests/unit/program/random_program.h"

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string folder = argv[1];
  std::ofstream unit(folder + "/fleet_units.cc"), cases(folder + "/cases.inc");
  unit << "#include \"tests/emitted/fleet_compare.h\"\n";
  for (int i = 2; i < argc; ++i) {
    const unsigned long seed = std::strtoul(argv[i], nullptr, 10);
    const std::string name = "fleet_" + std::to_string(seed);
    const auto program = kb::program::testing::random_program(seed);
    const auto tables = kb::tables::build(program, seed % 2 == 0 ? kb::tables::Limits{} : kb::tables::Limits{2, 0});
    const auto mind = kb::emit::cpp(program, tables, {name, name + ".kb.h"});
    const auto fleet = kb::emit::cpp_fleet(program, tables, {name, name + ".kb.fleet.h"}, {name + ".kb.h", name + ".kb.fleet.cc", mind.print});
    std::ofstream(folder + "/" + name + ".kb.h") << mind.header;
    std::ofstream(folder + "/" + name + ".kb.cc") << mind.source;
    std::ofstream(folder + "/" + name + ".kb.fleet.h") << fleet.header;
    std::ofstream(folder + "/" + name + ".kb.fleet.cc") << fleet.source;
    unit << "#include \"" << name << ".kb.cc\"\n#include \"" << name << ".kb.fleet.cc\"\nbool run_" << name
         << "() { return kb::emitted::fleet_agrees<" << name << "::Knowledge>(" << seed << "); }\n";
    cases << "KB_CASE(" << name << ")\n";
  }
  return unit && cases ? 0 : 1;
}
