// The emitted tables: one row on each line, with symbolic names, and its origin in a comment.
#include <fmt/format.h>

#include <bit>

#include "compiler/emit/cpp.h"
#include "compiler/tables/names.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using tables::I;

class TablesPrinter {
 public:
  TablesPrinter(const CppInput& in, std::string& out) : in_(in), t_(in.tables), out_(out) {}

  void print() {
    symbols();
    atoms();
    cells();
    timers();
    rules();
    groups();
    start();
    strengths();
    if (in_.planes.planes() != 0) planes();
    assembly();
  }

 private:
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(Out(out_), format, std::forward<T>(values)...);
    out_ += '\n';
  }

  template <class F>
  void array(std::string_view type, std::string_view name, std::size_t count, F&& row) { emit_array(out_, type, name, count, row); }
  std::string generic(std::string_view type) const { return fmt::format("mts::{}<Index>", type); }

  template <class T>
  void numbers(std::string_view type, std::string_view name, const std::vector<T>& values) { emit_numbers(out_, type, name, values); }

  std::string literal(I l) const {
    return fmt::format("{}({})", (l & 1u) != 0 ? "no" : "yes", in_.names.atoms[l >> 1]);
  }
  std::string cell(std::size_t c) const { return std::string(in_.program.cells[c].name); }

  void symbols() {
    line("using Index = Knowledge::Index;\n");
    line("// Atoms: see note [atoms] in runtime/table.h.");
    line("enum Atom : Index {{");
    for (std::size_t a = 0; a < in_.names.atoms.size() && !is_full(out_); ++a) {
      const std::string text = tables::atom_name(t_, in_.program, static_cast<std::uint32_t>(a));
      line("  {},{}", in_.names.atoms[a], text == in_.names.atoms[a] ? "" : "  // " + text);
    }
    out_ +=
        "};\n"
        "[[maybe_unused]] constexpr Index yes(Atom atom) { return static_cast<Index>(atom << 1); }\n"
        "[[maybe_unused]] constexpr Index no(Atom atom) { return static_cast<Index>(atom << 1 | 1); }\n\n";
  }

  /// The names of the rules of a word, for a comment; empty if there are none.
  std::string rule_names(std::string_view what, I word, mts::Word rules) const {
    std::string names;
    for (mts::Word rest = rules; rest != 0; rest &= rest - 1u) {
      (names += ' ') += in_.program.rules[t_.word_rule[word] + static_cast<std::uint32_t>(std::countr_zero(rest))].name;
    }
    return names.empty() ? names : fmt::format("  {}:{}", what, names);
  }
  std::string readers(const mts::Readers<I>& r) const {
    return fmt::format("{{{}, {{0x{:08x}, 0x{:08x}}}, 0x{:08x}}},  //{}{}{}", r.word, r.good[0], r.good[1], r.keyed,
                       rule_names("false", r.word, r.good[0]), rule_names("true", r.word, r.good[1]),
                       rule_names("key", r.word, r.keyed));
  }

  void atoms() {
    array(generic("Atom"), "kAtoms", t_.atoms.size(), [&](std::size_t a) {
      const auto& x = t_.atoms[a];
      return fmt::format("{{{}, {}, {}}},  // {}", x.readers, x.parents, x.timers,
                         a < in_.names.atoms.size() ? in_.names.atoms[a] : "end");
    });
    array(generic("Readers"), "kReaders", t_.readers.size(), [&](std::size_t i) { return readers(t_.readers[i]); });
    numbers("Index", "kParents", t_.parents);
    numbers("Index", "kTimerInputs", t_.timer_inputs);
    numbers("std::uint8_t", "kBroad", t_.broad);
  }

  std::string atom(I a) const { return a == 0 ? "0" : in_.names.atoms[a]; }

  void cells() {
    array(generic("CellAtoms"), "kCellAtoms", t_.cell_atoms.size(), [&](std::size_t c) {
      const auto& x = t_.cell_atoms[c];
      return fmt::format("{{{}, {}, {}}},  // {}", atom(x.high), atom(x.low), atom(x.zero), cell(c));
    });
    array(generic("FactAtoms"), "kFactAtoms", t_.fact_atoms.size(), [&](std::size_t f) {
      const auto& x = t_.fact_atoms[f];
      return fmt::format("{{{}, {}, {}, {}, {}}},  // {}", atom(x.seen), atom(x.event), atom(x.lost), float_literal(x.plain),
                         float_literal(x.attended), cell(f));
    });
    numbers("Index", "kAttendsBegin", t_.attends_begin);
    numbers("Index", "kAttends", t_.attends);
    numbers("Index", "kPriority", t_.priority);
  }

  void timers() {
    array(generic("Node"), "kNodes", t_.nodes.size(), [&](std::size_t n) {
      const std::size_t a = t_.shape.first_node() + n;
      return fmt::format("{{{}}},  // {}", t_.nodes[n].need, tables::atom_name(t_, in_.program, static_cast<std::uint32_t>(a)));
    });
    array(generic("Timer"), "kTimers", t_.timers.size(), [&](std::size_t i) {
      const std::size_t a = t_.shape.first_timer() + i;
      return fmt::format("{{{}, {}}},  // {}", literal(t_.timers[i].input), t_.timers[i].queue,
                         tables::atom_name(t_, in_.program, static_cast<std::uint32_t>(a)));
    });
    numbers("std::uint32_t", "kQueueUs", t_.queue_us);
    array(generic("Stage"), "kStages", t_.stages.size(), [&](std::size_t i) {
      const auto& x = t_.stages[i];
      return fmt::format("{{{}, {}, {}, {}}},", x.first_timer, x.end_timer, x.first_queue, x.end_queue);
    });
    array(generic("Level"), "kLevels", t_.levels.size(), [&](std::size_t i) {
      const auto& x = t_.levels[i];
      return fmt::format("{{{}, {}, {}, {}}},  // {}", x.first_word, x.end_word, x.first_stage, x.end_stage,
                         in_.program.levels[i]);
    });
  }

  void rules() {
    array(generic("Rule"), "kRules", t_.rules.size(), [&](std::size_t r) {
      const auto& x = t_.rules[r];
      const bool last = r == in_.program.rules.size();
      return fmt::format("{{{}, {}, {}}},  // {}{}{}", x.conditions, x.writes, x.clears,
                         last ? "end" : in_.program.rules[r].name, last ? "" : "  ", last ? "" : in_.program.at(in_.program.rules[r]));
    });
    numbers("Index", "kWordRule", t_.word_rule);
    words("kWhileRules", t_.while_rules);
    words("kResetRules", t_.reset_rules);
    by_rule("Index", "kConditions", &mts::Rule<I>::conditions, [&](I i) { return literal(t_.conditions[i]); });
    by_rule(generic("Write"), "kWrites", &mts::Rule<I>::writes, [&](I i) {
      return fmt::format("{{{}, {}}}", t_.writes[i].cell, t_.writes[i].value);
    });
    numbers("Index", "kClears", t_.clears);
    array("float", "kValues", t_.values.size(), [&](std::size_t i) { return float_literal(t_.values[i]) + ","; });
  }

  /// Items of rules, one line for each rule.
  template <class F>
  void by_rule(std::string_view type, std::string_view name, I mts::Rule<I>::*begin, F&& item) {
    if (t_.rules.back().*begin == 0) return;
    line("constexpr {} {}[] = {{", type, name);
    for (std::size_t r = 0; r + 1 < t_.rules.size() && !is_full(out_); ++r) {
      if (t_.rules[r].*begin == t_.rules[r + 1].*begin) continue;
      out_ += "   ";
      for (I i = t_.rules[r].*begin; i < t_.rules[r + 1].*begin; ++i) out_ += ' ' + item(i) + ',';
      out_.append("  // ").append(in_.program.rules[r].name) += '\n';
    }
    out_ += "};\n\n";
  }

  void words(std::string_view name, const std::vector<mts::Word>& values) {
    array("mts::Word", name, values.size(), [&](std::size_t i) { return fmt::format("0x{:08x},", values[i]); });
  }

  void groups() {
    numbers("Index", "kGroupOf", t_.group_of);
    numbers("Index", "kGroupSlot", t_.group_slot);
    numbers("Index", "kGroupBegin", t_.group_begin);
  }

  void start() {
    array("float", "kInitial", t_.initial.size(), [&](std::size_t s) {
      return fmt::format("{},  // {}", float_literal(t_.initial[s]), cell(in_.program.facts + s));
    });
    words("kKeep", t_.keep);
    words("kInitialTruth", t_.initial_truth);
    numbers("Index", "kInitialCount", t_.initial_count);
  }

  void strengths() {
    numbers("Index", "kChildBegin", t_.child_begin);
    numbers("Index", "kChildren", t_.children);
    numbers("std::uint8_t", "kIsAnd", t_.is_and);
    numbers("Index", "kAtomCell", t_.atom_cell);
    numbers("std::uint8_t", "kAtomTerm", t_.atom_term);
  }

  void planes() {
    numbers("std::uint16_t", "kPlaneFirst", in_.planes.first);
    numbers("std::uint16_t", "kPlaneBegin", in_.planes.begin);
    array("mts::PlaneRow", "kPlaneRows", in_.planes.rows.size(), [&](std::size_t i) { return fmt::format("{{{}, 0x{:08x}}},", in_.planes.rows[i].plane, in_.planes.rows[i].rules); });
    words("kPlanesAtStart", in_.planes.at_start);
  }

  void assembly() {
    line("}}  // namespace\n");
    line("constexpr mts::Tables<Knowledge::Index> Knowledge::kTables = {{");
    line("    .abi = Knowledge::kAbi,");
    line("    .shape = Knowledge::kShape,");
    line("    .firing = {},", float_literal(t_.firing));
    const char* idle[] = {"kStop", "kHold", "kStrategy"};
    line("    .idle = mts::Idle::{},", idle[static_cast<std::size_t>(t_.idle)]);
    line("    .idle_strategy = {},", t_.idle_strategy);
    line("    .hold_limit_us = {},", t_.hold_limit_us);
    tables::for_each_array(t_, [this](const char* name, const auto& values) {
      line("    .{} = {},", name, values.empty() ? "nullptr" : "k" + type_name(name));
    });
    line("}};\n");
  }

  const CppInput& in_;
  const tables::Tables& t_;
  std::string& out_;
};

/// `items`: things with a name.
template <class Items>
void texts(std::string& out, std::string_view type, std::string_view variable, const Items& items) {
  fmt::format_to(Out(out), "const char* name({} {}) {{\n", type, variable);
  if (items.empty()) {
    fmt::format_to(Out(out), "  static_cast<void>({});\n  return \"\";\n}}\n\n", variable);
    return;
  }
  out += "  static constexpr const char* kNames[] = {\n";
  for (const auto& item : items) {
    if (!is_full(out)) fmt::format_to(Out(out), "      \"{}\",\n", item.name);
  }
  fmt::format_to(Out(out), "  }};\n  const auto i = static_cast<std::uint32_t>({});\n  return i < {} ? kNames[i] : \"?\";\n}}\n\n", variable,
                 items.size());
}

}  // namespace

void emit_tables(const CppInput& in, std::string& out) { TablesPrinter(in, out).print(); }

void emit_texts(const CppInput& in, std::string& out) {
  using program::CellKind;
  texts(out, "Fact", "fact", in.program.cells_of(CellKind::kFact));
  texts(out, "Satellite", "satellite", in.program.cells_of(CellKind::kSatellite));
  texts(out, "Strategy", "strategy", in.program.cells_of(CellKind::kStrategy));
  texts(out, "Rule", "rule", in.program.rules);
}

}  // namespace kb::emit
