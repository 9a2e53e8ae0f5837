// Writes emitted C++ for random fuzzy controllers: fuzzy_make_units OUT_DIR COUNT. One file fuzzy_units.cc that includes all,
// and cases.inc. Fails if a row of nests is not folded: it would test nothing.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "compiler/emit/emit.h"
#include "compiler/tables/fuzzy_fold.h"
#include "tests/emitted/fuzzy_compare.h"

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
    program.fuzzy.push_back(kb::emitted::controller_of(seed));
    const auto layout = kb::tables::lay_out(program.fuzzy.back(), kb::tables::pack(program.fuzzy.back()));
    if (kb::emitted::has_row_of_nests(seed) && layout.fold.end_nest == 0) {
      std::cerr << name << ": the row of nests is not folded\n";
      return 1;
    }
    const auto cpp = kb::emit::cpp(program, kb::tables::build(program), {name, name + ".kb.h"});
    std::ofstream(folder + "/" + name + ".kb.h") << cpp.header;
    std::ofstream(folder + "/" + name + ".kb.cc") << cpp.source;
    unit << "#include \"" << name << ".kb.cc\"\nbool run_" << name << "() { return kb::emitted::agrees<" << name << "::Random>(" << seed << "); }\n";
    cases << "KB_CASE(" << name << ")\n";
  }
  return unit && cases ? 0 : 1;
}
