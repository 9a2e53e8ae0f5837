// The levels of rules, and what passes between them.
//
// A tick runs from the highest level to the lowest, and so does the picture: under the rules of each level stand the cells that it
// writes, and from there lines lead to the rules of lower levels that read them, always from the nearest level above. What comes
// from elsewhere (facts, values of the last tick) is named in the rule itself, because lines for it would hide the others.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "compiler/emit/dot.h"
#include "compiler/emit/dot_parts.h"

namespace kb::emit {
namespace {

using program::CellId;
using program::CellKind;
using program::Program;

// By cell: the group or relation that it belongs to; a cell that belongs to none has its own name.
class GroupNames {
 public:
  GroupNames(const model::Model& model, const Program& program) : program_(program) {
    for (const model::Group& group : model.groups)
      for (const model::CellId cell : group.cells) add(model[cell].name, group.name);
    for (const model::Relation& relation : model.relations) {
      for (const model::RowId row : relation.rows)
        if (model[row].cell != model::CellId::kNone) add(model[model[row].cell].name, relation.name);
    }
  }
  [[nodiscard]] std::string of(CellId cell) const {
    const std::string name(program_[cell].name);
    const auto found = names_.find(name);
    return found == names_.end() ? name : found->second;
  }

 private:
  void add(std::string_view cell, const std::string& group) {
    names_.try_emplace(std::string(cell), group);
    names_.try_emplace(fmt::format("sat {}", cell), "sat " + group);
  }
  const Program& program_;
  std::unordered_map<std::string, std::string> names_;  // looked up, never iterated
};

// All instances of one rule as written.
struct RuleUse {
  std::set<std::string> facts, reads, writes;  // groups of cells
  bool resets = false;
};

struct Picture {
  std::map<std::pair<std::uint32_t, std::string>, RuleUse> rules;  // by level and name
  std::map<std::string, std::set<std::uint32_t>> written;          // groups: the levels that write them
  std::map<std::string, CellKind> kinds;                           // of groups
  std::set<std::string> outputs;                                   // groups that the program reads
};

// The cells that rules write, except by `reset`: that writes all satellites, which a word says.
std::set<CellId> cells_written(const Program& program, const std::vector<const program::Rule*>& rules) {
  std::set<CellId> cells;
  std::set<std::uint32_t> cleared;
  for (const program::Rule* rule : rules) {
    for (const program::Write& write : rule->writes) cells.insert(write.cell);
    cleared.insert(rule->clears.begin(), rule->clears.end());
  }
  for (const std::uint32_t group : cleared) cells.insert(program.exclusive[group].begin(), program.exclusive[group].end());
  return cells;
}

// Looks at all instances of a rule together, so that a condition that they share (`any sat Leg`), or a group that each of them clears, is
// looked at once and not for each instance.
Picture look(const model::Model& model, const Program& program) {
  const GroupNames names(model, program);
  std::map<std::pair<std::uint32_t, std::string_view>, std::vector<const program::Rule*>> rules;
  for (const program::Rule& rule : program.rules) rules[{rule.level, rule.tmpl()}].push_back(&rule);
  Picture picture;
  for (const auto& [place, instances] : rules) {
    RuleUse& use = picture.rules[{place.first, std::string(place.second)}];
    std::vector<program::CondId> conditions;
    for (const program::Rule* rule : instances) {
      conditions.push_back(rule->condition);
      use.resets = use.resets || rule->reset;
    }
    for (const CellId cell : cells_read(program, conditions))
      (program[cell].kind == CellKind::kFact ? use.facts : use.reads).insert(names.of(cell));
    for (const CellId cell : cells_written(program, instances)) {
      const std::string name = names.of(cell);
      use.writes.insert(name);
      picture.written[name].insert(place.first);
      picture.kinds[name] = program[cell].kind;
      if (program[cell].output) picture.outputs.insert(name);
    }
  }
  return picture;
}

/// The nearest level above `level` that writes the group; none if rules at `level` read the value of the last tick.
std::optional<std::uint32_t> written_above(const Picture& picture, const std::string& group, std::uint32_t level) {
  const auto found = picture.written.find(group);
  if (found == picture.written.end()) return std::nullopt;
  const auto below = found->second.lower_bound(level);
  if (below == found->second.begin()) return std::nullopt;
  return *std::prev(below);
}

std::string rule_node(std::uint32_t level, const std::string& name) {
  return dot_string(fmt::format("rule {} {}", level, name));
}
std::string cell_node(std::uint32_t level, const std::string& group) {
  return dot_string(fmt::format("cell {} {}", level, group));
}

// One line of a label, aligned to the left. The quotes that `dot_string` adds belong to the whole label.
std::string label_line(const std::string& text) {
  const std::string quoted = dot_string(text);
  return quoted.substr(1, quoted.size() - 2) + "\\l";
}

// `title` and the names, a few on each line.
std::string label_list(const std::string& title, const std::set<std::string>& names) {
  std::string label, line = title;
  std::size_t on_line = 0;
  for (const std::string& name : names) {
    if (on_line == 3) {
      label += label_line(line + ",");
      line = "    ";
      on_line = 0;
    }
    line += (on_line++ > 0 ? ", " : " ") + name;
  }
  return names.empty() ? "" : label + label_line(line);
}

std::string rule_label(const Picture& picture, std::uint32_t level, const std::string& name, const RuleUse& use) {
  std::set<std::string> left_behind;
  for (const std::string& group : use.reads)
    if (!written_above(picture, group, level)) left_behind.insert(group);
  return "\"" + label_line(name) + label_list("  facts:", use.facts) + label_list("  last tick:", left_behind) +
         (use.resets ? label_line("  resets all satellites") : "") + "\"";
}

void print_level(const Picture& picture, const Program& program, std::uint32_t level, std::string& out) {
  out += fmt::format(
      "  subgraph cluster_{} {{\n    label={}; labeljust=l; style=filled; fillcolor=\"#f2f2f2\"; color=\"#808080\";\n",
      level, dot_string(fmt::format("{}  {}", level + 1, program.levels[level])));
  out += fmt::format("    {{ rank=same; above_{} [style=invis, shape=point];\n", level);
  for (const auto& [place, use] : picture.rules) {
    if (place.first == level) {
      out += fmt::format("      {} [label={}, shape=box, style=filled, fillcolor=white];\n",
                         rule_node(level, place.second), rule_label(picture, level, place.second, use));
    }
  }
  out += fmt::format("    }}\n    {{ rank=same; below_{} [style=invis, shape=point];\n", level);
  for (const auto& [group, levels] : picture.written) {
    if (levels.contains(level)) {
      out += fmt::format("      {} [label={}, {}];\n", cell_node(level, group), dot_string(group),
                         cell_shape(picture.kinds.at(group), picture.outputs.contains(group)));
    }
  }
  out += fmt::format("    }}\n  }}\n  above_{0} -> below_{0} [style=invis, weight=100];\n", level);
  if (level > 0) out += fmt::format("  below_{} -> above_{} [style=invis, weight=100];\n", level - 1, level);
}

}  // namespace

std::string print_levels_dot(const model::Model& model, const Program& program) {
  const Picture picture = look(model, program);
  std::string out =
      "digraph {\n"
      "  graph [fontname=\"Helvetica\", fontsize=12, rankdir=TB, newrank=true, labelloc=b, nodesep=0.15, "
      "ranksep=0.6];\n"
      "  node [fontname=\"Helvetica\", fontsize=10, margin=\"0.08,0.04\", height=0.3];\n"
      "  edge [arrowsize=0.7];\n"
      "  label=\"solid: writes   dashed: reads what a level above wrote   in the boxes: what else is read" +
      std::string(picture.outputs.empty() ? "" : kOutputLegend) + "\";\n";
  for (std::uint32_t level = 0; level < program.levels.size(); ++level) print_level(picture, program, level, out);
  for (const auto& [place, use] : picture.rules) {
    for (const std::string& group : use.writes)
      out += fmt::format("  {} -> {};\n", rule_node(place.first, place.second), cell_node(place.first, group));
    for (const std::string& group : use.reads) {
      if (const auto from = written_above(picture, group, place.first)) {
        out +=
            fmt::format("  {} -> {} [style=dashed];\n", cell_node(*from, group), rule_node(place.first, place.second));
      }
    }
  }
  return out + "}\n";
}

}  // namespace kb::emit
