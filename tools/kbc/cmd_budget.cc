// kbc budget: what a knowledge base costs on the robot.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <waymark/runtime/certainty.h>
#include <waymark/runtime/masks.h>
#include "compiler/tables/tables.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

struct BudgetOptions {
  std::string file;
  bool json = false;
};

std::string print_json(const tables::Budget& b) {
  const nlohmann::ordered_json object = {{"table_bytes", b.table_bytes},
                                         {"mask_bytes", b.mask_bytes},
                                         {"state_bytes", b.state_bytes},
                                         {"compact_state_bytes", b.compact_state_bytes},
                                         {"name_bytes", b.name_bytes},
                                         {"facts", b.facts},
                                         {"satellites", b.satellites},
                                         {"strategies", b.strategies},
                                         {"rules", b.rules},
                                         {"atoms", b.atoms},
                                         {"nodes", b.nodes},
                                         {"timers", b.timers},
                                         {"most_awake", b.most_awake},
                                         {"counted", b.counted},
                                         {"perception_table_bytes", b.perception_table_bytes},
                                         {"perception_state_bytes", b.perception_state_bytes},
                                         {"perception_stack_bytes", b.perception_stack_bytes},
                                         {"fuzzy_table_bytes", b.fuzzy_table_bytes},
                                         {"fuzzy_stack_bytes", b.fuzzy_stack_bytes}};
  return object.dump(2) + "\n";
}

std::string print_text(const tables::Budget& b, bool image) {
  std::string out;
  const auto line = [&out](std::string_view what, std::size_t count, std::string_view about) {
    fmt::format_to(std::back_inserter(out), "{:<14}{:>10}{}{}\n", what, count, about.empty() ? "" : "  ", about);
  };
  line("tables", b.table_bytes, "bytes, read-only (flash)");
  if (b.mask_bytes != 0) {
    line("  as masks", b.mask_bytes, "bytes more, and code for each atom, where compiled for speed; none with -Os or --compact");
  } else if (!image) {
    line("  as masks", 0, fmt::format("bytes: with more than {} rules, {} atoms, {} satellites or {} planes of conditions, rules stay lists", mts::kMostMaskedRules, mts::kMostMasked, mts::kMostMasked, mts::kMostPlanes));
  }
  line("state", b.state_bytes, "bytes of memory, owned by the caller");
  if (b.compact_state_bytes != 0) line("  compact", b.compact_state_bytes, "bytes of memory instead with --compact; the tables shrink as well");
  line("names", b.name_bytes, "bytes and a pointer to each, read-only, only if names are linked in");
  if (b.perception_table_bytes != 0) {
    constexpr std::size_t kShared = sizeof mts::detail::kLevelTable + sizeof mts::detail::kCoarseLevels;
    line("perception", b.perception_table_bytes, fmt::format("bytes, read-only, besides the tables; and {} that all knowledge bases share", kShared));
    line("  its state", b.perception_state_bytes, "bytes of memory, readings included");
    line("  its stack", b.perception_stack_bytes, "bytes for a moment, and up to 400 for calls");
  }
  if (b.fuzzy_table_bytes != 0) {
    line("fuzzy", b.fuzzy_table_bytes, "bytes, read-only, of all fuzzy controllers");
    line("  its stack", b.fuzzy_stack_bytes, "bytes for a moment, of the largest one, and up to 300 for calls; as straight code some 100");
  }
  line("facts", b.facts, "");
  line("satellites", b.satellites, "");
  line("strategies", b.strategies, "");
  line("rules", b.rules, "");
  line("atoms", b.atoms, "different conditions on single cells, a bit each");
  line("nodes", b.nodes, "conditions put together of others");
  line("timers", b.timers, "different `for` conditions");
  line("rules awake", b.most_awake, image ? "can be awake at once; which facts exclude each other is not in an image" : "can be awake at once, exclusive groups counted once");
  line("rules counted", b.counted, "have so long a condition that what holds of it is counted; the others sleep under a key");
  return out;
}

}  // namespace

Run setup_budget(CLI::App& app) {
  auto options = std::make_shared<BudgetOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  app.add_flag("--json", options->json, "Print JSON, for programs");
  return [options](Session& session) {
    const auto compiled = session.load(options->file, driver::Stage::kTables);
    if (!compiled->ok()) return static_cast<int>(kErrors);
    const bool image = compiled->image != nullptr;
    const tables::Budget budget = tables::budget(compiled->tables, compiled->program, image);
    session.print(options->json ? print_json(budget) : print_text(budget, image));
    return session.exit_code();
  };
}

}  // namespace kb::cli
