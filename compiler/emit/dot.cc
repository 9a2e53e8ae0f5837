// The picture of single rules, and what all pictures share. For levels see dot_levels.cc, for the map dot_map.cc.
#include "compiler/emit/dot.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compiler/emit/dot_parts.h"
#include "compiler/program/conditions.h"

namespace kb::emit {

using program::CellId;
using program::CellKind;
using program::Program;
using program::RuleId;

std::string_view cell_shape(CellKind kind, bool output) {
  switch (kind) {
    case CellKind::kFact: return "shape=ellipse";
    case CellKind::kSatellite: return output ? "shape=box, style=rounded, peripheries=2" : "shape=box, style=rounded";
    case CellKind::kStrategy: return "shape=octagon";
  }
  return "";
}

std::set<CellId> cells_read(const Program& program, const std::vector<program::CondId>& conditions) {
  std::set<CellId> cells;
  for (const program::CondId id : program::reachable(program.conds, conditions))
    if (program[id].cell != CellId::kNone) cells.insert(program[id].cell);
  return cells;
}

std::string dot_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

namespace {

// The members of a group; only the first few if there are many.
std::string group_label(const Program& program, const std::vector<CellId>& group) {
  constexpr std::size_t most = 6;
  std::string label;
  for (std::size_t i = 0; i < group.size() && i < most; ++i) label.append(i == 0 ? "" : " ").append(program[group[i]].name);
  return label + (group.size() > most ? " ..." : "");
}

/// Collects nodes while edges are printed, so that each node is printed once.
class RulePicture {
 public:
  explicit RulePicture(const Program& program) : program_(program) {}

  void add(const program::Rule& rule) {
    const std::string node = dot_string(fmt::format("rule {}", rule.name));
    nodes_ +=
        fmt::format("  {} [label={}, shape=box, style=filled, fillcolor=\"#f2f2f2\"];\n", node, dot_string(rule.name));
    for (const CellId cell : cells_read(program_, {rule.condition})) {
      read_.insert(cell);
      edges_ += fmt::format("  \"in {}\" -> {} [style=dashed];\n", index(cell), node);
    }
    for (const program::Write& write : rule.writes) {
      written_.insert(write.cell);
      edges_ += fmt::format("  {} -> \"out {}\" [label=\"{}\"{}];\n", node, index(write.cell), write.value,
                            write.value < 0 ? ", color=\"#707070\"" : "");
    }
    for (const std::uint32_t group : rule.clears) {
      cleared_.insert(group);
      edges_ += fmt::format("  {} -> \"group {}\" [label=\"-1\", color=\"#707070\"];\n", node, group);
    }
    if (rule.reset) edges_ += fmt::format("  {} -> reset;\n", node);
    resets_ = resets_ || rule.reset;
  }

  [[nodiscard]] bool has_output() const {
    const auto output = [this](CellId cell) { return program_[cell].output; };
    return std::any_of(read_.begin(), read_.end(), output) || std::any_of(written_.begin(), written_.end(), output);
  }

  [[nodiscard]] std::string print() const {
    std::string out = nodes_;
    for (const CellId cell : read_) out += cell_node("in", cell);
    for (const CellId cell : written_) out += cell_node("out", cell);
    for (const std::uint32_t group : cleared_) {
      out += fmt::format("  \"group {}\" [label={}, shape=box, style=\"rounded,dashed\"];\n", group,
                         dot_string("others of: " + group_label(program_, program_.exclusive[group])));
    }
    if (resets_) out += "  reset [label=\"reset: all other satellites\", shape=box, style=\"rounded,dashed\"];\n";
    return out + edges_;
  }

 private:
  [[nodiscard]] std::string cell_node(std::string_view side, CellId cell) const {
    return fmt::format("  \"{} {}\" [label={}, {}];\n", side, index(cell), dot_string(program_[cell].name),
                       cell_shape(program_[cell].kind, program_[cell].output));
  }
  const Program& program_;
  std::string nodes_, edges_;
  std::set<CellId> read_, written_;
  std::set<std::uint32_t> cleared_;
  bool resets_ = false;
};

}  // namespace

std::string print_rules_dot(const Program& program, const std::vector<RuleId>& rules) {
  RulePicture picture(program);
  for (const RuleId rule : rules) picture.add(program[rule]);
  return "digraph {\n"
         "  graph [fontname=\"Helvetica\", fontsize=12, rankdir=LR, labelloc=b, ranksep=1.2];\n"
         "  node [fontname=\"Helvetica\", fontsize=10, margin=\"0.08,0.04\", height=0.3];\n"
         "  edge [fontname=\"Helvetica\", fontsize=9, arrowsize=0.7];\n"
         "  label=\"left: read   right: written, with the value" +
         std::string(picture.has_output() ? kOutputLegend : "") + "\";\n" + picture.print() + "}\n";
}

}  // namespace kb::emit
