// Writes emitted fleets for random programs: fleet_make_units OUT_DIR SEED... rest SEED... One file fleet_units.cc that includes all, and
// cases.inc. Robots of those after `rest` must come to rest on a calm day; others may contradict themselves all day long.
#include <cstdlib>
#include <fstream>
#include <string>

#include "compiler/emit/emit.h"
#include "compiler/tables/fleet_rest.h"
#include "tests/emitted/usual_facts.h"
#include "tests/unit/program/random_program.h"

/// Most of the planes that stay as they are in robots that are told every second fact only: some are left out, so that resting kernels have
/// planes of every kind on both sides.
kb::tables::FleetRest some_at_rest(const kb::program::Program& program, const kb::tables::Tables& tables, unsigned long seed) {
  std::vector<kb::tables::FleetMission> missions(2);
  for (std::size_t i = 0; i < missions.size(); ++i) {
    for (const kb::program::testing::Step& step : kb::program::testing::random_trace(program, seed + 100'000 * i, 60)) {
      missions[i].dt_us.push_back(step.dt_us);
      for (std::uint32_t f = 0; f < program.facts; ++f) missions[i].facts.push_back(kb::emitted::is_usual(f) ? step.facts[f] : 0.0f);
    }
  }
  kb::tables::FleetRest rest = kb::tables::planes_at_rest(kb::tables::build_fleet(program, tables), tables, missions);
  std::erase_if(rest, [seed](const auto& plane) {
    const auto& [kind, of, bit] = plane.first;
    return (static_cast<unsigned long>(kind) * 5 + of * 7 + seed) % 4 == 0;   // all bits of a satellite together
  });
  return rest;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string folder = argv[1];
  std::ofstream unit(folder + "/fleet_units.cc"), cases(folder + "/cases.inc");
  unit << "#include \"tests/emitted/fleet_compare.h\"\n";
  bool rest = false;
  for (int i = 2; i < argc; ++i) {
    if (std::string(argv[i]) == "rest") {
      rest = true;
      continue;
    }
    const unsigned long seed = std::strtoul(argv[i], nullptr, 10);
    const std::string name = "fleet_" + std::to_string(seed);
    const auto program = kb::program::testing::random_program(seed);
    const auto tables = kb::tables::build(program, seed % 2 == 0 ? kb::tables::Limits{} : kb::tables::Limits{2, 0});
    const auto mind = kb::emit::cpp(program, tables, {name, name + ".kb.h"});
    const auto fleet = kb::emit::cpp_fleet(program, tables, {name, name + ".kb.fleet.h"}, {name + ".kb.h", name + ".kb.fleet.cc", mind.print},
                                          some_at_rest(program, tables, seed));
    std::ofstream(folder + "/" + name + ".kb.h") << mind.header;
    std::ofstream(folder + "/" + name + ".kb.cc") << mind.source;
    std::ofstream(folder + "/" + name + ".kb.fleet.h") << fleet.header;
    std::ofstream(folder + "/" + name + ".kb.fleet.cc") << fleet.source;
    unit << "#include \"" << name << ".kb.cc\"\n#include \"" << name << ".kb.fleet.cc\"\nbool run_" << name
         << "() { return kb::emitted::fleet_agrees<" << name << "::Knowledge>(" << seed << ", " << rest << "); }\n";
    cases << "KB_CASE(" << name << ")\n";
  }
  return unit && cases ? 0 : 1;
}
