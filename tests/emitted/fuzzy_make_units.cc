// Writes emitted C++ for random fuzzy controllers: fuzzy_make_units OUT_DIR COUNT. One file fuzzy_units.cc that includes all,
// and cases.inc.
#include <cstdlib>
#include <fstream>
#include <string>

#include "compiler/emit/emit.h"
#include "tests/unit/fuzzy/random_controller.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string folder = argv[1];
  const unsigned count = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  std::ofstream unit(folder + "/fuzzy_units.cc"), cases(folder + "/cases.inc");
  unit << "#include \"tests/emitted/fuzzy_compare.h\"\n";
  for (unsigned seed = 1; seed <= count; ++seed) {
    const std::string name = "fuzzy_" + std::to_string(seed);
    kb::program::Program program;
    program.levels.emplace_back("control");
    program.fuzzy.push_back(kb::fuzzy::testing::random_controller(seed));
    const auto cpp = kb::emit::cpp(program, kb::tables::build(program), {name, name + ".kb.h"});
    std::ofstream(folder + "/" + name + ".kb.h") << cpp.header;
    std::ofstream(folder + "/" + name + ".kb.cc") << cpp.source;
    unit << "#include \"" << name << ".kb.cc\"\nbool run_" << name << "() { return kb::emitted::agrees<" << name << "::Random>(" << seed << "); }\n";
    cases << "KB_CASE(" << name << ")\n";
  }
  return unit && cases ? 0 : 1;
}
