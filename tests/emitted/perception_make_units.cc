// Writes emitted C++ for random programs with perception: perception_make_units OUT_DIR COUNT. One file perception_units.cc that
// includes all, and cases.inc.
#include <cstdlib>
#include <fstream>
#include <string>

#include "compiler/emit/emit.h"
#include "tests/unit/tables/random_perceiver.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string folder = argv[1];
  const unsigned count = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  std::ofstream unit(folder + "/perception_units.cc"), cases(folder + "/cases.inc");
  unit << "#include \"tests/emitted/perception_compare.h\"\n";
  for (unsigned seed = 1; seed <= count; ++seed) {
    const std::string name = "perceiver_" + std::to_string(seed);
    const auto program = kb::tables::testing::random_perceiver(seed);
    if (program.perception.perceived.empty()) continue;
    const auto cpp = kb::emit::cpp(program, kb::tables::build(program), {name, name + ".kb.h"});
    std::ofstream(folder + "/" + name + ".kb.h") << cpp.header;
    std::ofstream(folder + "/" + name + ".kb.cc") << cpp.source;
    unit << "#include \"" << name << ".kb.cc\"\nbool run_" << name << "() { return kb::emitted::sees_alike<" << name << "::Perception, " << name
         << "::Mind>(" << seed << "); }\n";
    cases << "KB_CASE(" << name << ")\n";
  }
  return unit && cases ? 0 : 1;
}
