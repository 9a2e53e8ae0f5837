// Writes emitted C++ for random programs, several to a translation unit:
//   make_units OUT_DIR UNITS PROGRAMS_EACH SEED...
// Those that have a compact form are written in it as well.
// OUT_DIR/unit_N.cc, OUT_DIR/unit_more.cc with the programs of the seeds, and OUT_DIR/cases.inc that names all cases for main.cc.
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "compiler/emit/emit.h"
#include "compiler/tables/compact.h"
#include "tests/unit/program/random_program.h"

namespace {

class Maker {
 public:
  explicit Maker(std::string folder) : folder_(std::move(folder)), cases_(folder_ + "/cases.inc") {}

  /// False if something could not be written.
  bool unit(const std::string& name, const std::vector<std::uint64_t>& seeds) {
    std::ofstream unit(folder_ + "/unit_" + name + ".cc");
    unit << "#include \"tests/emitted/compare.h\"\n";
    for (const std::uint64_t seed : seeds) program(unit, seed);
    return unit && cases_;
  }

 private:
  void program(std::ofstream& unit, std::uint64_t seed) {
    const auto program = kb::program::testing::random_program(seed);
    // Every second one as if it were large, so that the mechanisms for large programs are emitted too.
    const auto tables = kb::tables::build(program, seed % 2 == 0 ? kb::tables::Limits{} : kb::tables::Limits{2, 0});
    write(unit, seed, program, tables, "random_", false);
    if (kb::tables::against_compact(tables, program).empty()) write(unit, seed, program, tables, "compact_", true);
  }

  void write(std::ofstream& unit, std::uint64_t seed, const kb::program::Program& program, const kb::tables::Tables& tables, const char* form, bool compact) {
    const std::string name = form + std::to_string(seed);
    const auto cpp = kb::emit::cpp(program, tables, {name, name + ".kb.h", compact});
    std::ofstream(folder_ + "/" + name + ".kb.h") << cpp.header;
    std::ofstream(folder_ + "/" + name + ".kb.cc") << cpp.source;
    unit << "#include \"" << name << ".kb.cc\"\n"
         << "bool run_" << name << "() { return kb::emitted::agrees<" << name << "::Knowledge, " << name << "::Mind>(" << seed << "); }\n";
    cases_ << "KB_CASE(" << name << ")\n";
  }

  std::string folder_;
  std::ofstream cases_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const auto number = [&](int i) { return std::strtoull(argv[i], nullptr, 10); };
  const std::uint64_t units = number(2), each = number(3);
  Maker maker(argv[1]);
  bool good = true;
  std::uint64_t seed = 0;
  std::vector<std::uint64_t> seeds(each);
  for (std::uint64_t u = 0; u < units; ++u) {
    for (std::uint64_t& one : seeds) one = ++seed;
    good = maker.unit(std::to_string(u), seeds) && good;
  }
  seeds.clear();
  for (int i = 4; i < argc; ++i) seeds.push_back(number(i));
  return maker.unit("more", seeds) && good ? 0 : 1;
}
