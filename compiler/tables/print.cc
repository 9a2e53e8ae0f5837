// `kbc dump tables`: the contents of the tables, by names, one item on each line.
#include <fmt/format.h>

#include <iterator>

#include "compiler/tables/names.h"
#include "compiler/tables/perception.h"
#include "compiler/tables/tables.h"

namespace kb::tables {

std::string atom_name(const Tables& tables, const program::Program& program, std::uint32_t atom) {
  const AtomOrigin& o = tables.origins[atom];
  const auto cell = [&] { return std::string(program[o.cell].name); };
  switch (o.kind) {
    case AtomOrigin::Kind::kTrue: return "true";
    case AtomOrigin::Kind::kFalse: return "false";
    case AtomOrigin::Kind::kTerm: return o.term == program::Term::kHigh ? cell() : fmt::format("{} is {}", cell(), word(o.term));
    case AtomOrigin::Kind::kSeen: return "seen " + cell();
    case AtomOrigin::Kind::kEvent: return "event " + cell();
    case AtomOrigin::Kind::kLost: return "lost " + cell();
    case AtomOrigin::Kind::kTimer:
    case AtomOrigin::Kind::kNode: return fmt::format("({})", program::print_condition(program, o.condition));
  }
  return "?";
}

std::string literal_name(const Tables& tables, const program::Program& program, std::uint32_t literal) {
  return ((literal & 1u) != 0 ? "not " : "") + atom_name(tables, program, literal >> 1);
}

namespace {

using Out = std::back_insert_iterator<std::string>;

void print_atoms(Out out, const Tables& t, const program::Program& p) {
  const auto rules = [&](std::uint32_t atom, auto&& which) {
    int n = 0;
    for (I i = t.atoms[atom].readers; i < t.atoms[atom + 1].readers; ++i) n += std::popcount(which(t.readers[i]));
    return n;
  };
  const auto good = [&](std::uint32_t atom, std::uint32_t now) {
    const bool broad = !t.broad.empty() && (t.broad[atom] >> now & 1u) != 0;
    return fmt::format("{}{}", rules(atom, [now](const auto& r) { return r.good[now]; }), broad ? "*" : "");
  };
  for (std::uint32_t a = 0; a < t.shape.atoms; ++a) {
    const auto& x = t.atoms[a];
    const auto& e = t.atoms[a + 1];
    fmt::format_to(out, "atom {} {} when_true={} when_false={} keys={} parents={} timers={}\n", a, atom_name(t, p, a), good(a, 1),
                   good(a, 0), rules(a, [](const auto& r) { return r.keyed; }), e.parents - x.parents, e.timers - x.timers);
  }
}

void print_rules(Out out, const Tables& t, const program::Program& p) {
  for (std::uint32_t r = 0; r < t.shape.rules; ++r) {
    fmt::format_to(out, "rule {} {} key={} if", r, p.rules[r].name, atom_name(t, p, t.rule_key[r]));
    for (I i = t.rules[r].conditions; i < t.rules[r + 1].conditions; ++i) {
      fmt::format_to(out, "{} {}", i == t.rules[r].conditions ? "" : " &", literal_name(t, p, t.conditions[i]));
    }
    fmt::format_to(out, " then");
    for (I i = t.rules[r].writes; i < t.rules[r + 1].writes; ++i) {
      fmt::format_to(out, " {}={}", p.cells[t.writes[i].cell].name, t.values[t.writes[i].value]);
    }
    for (I i = t.rules[r].clears; i < t.rules[r + 1].clears; ++i) fmt::format_to(out, " clear group {}", t.clears[i]);
    fmt::format_to(out, "{}\n", p.rules[r].reset ? " reset" : "");
  }
}

}  // namespace

std::string print(const Tables& t, const program::Program& p) {
  std::string text;
  const Out out(text);
  const mts::Shape& n = t.shape;
  fmt::format_to(out, "tables abi={} index={} facts={} satellites={} strategies={} atoms={} rules={} words={}\n", mts::kAbi,
                 t.narrow ? 16 : 32, n.facts, n.satellites, n.strategies, n.atoms, n.rules, n.words);
  fmt::format_to(out, "tables nodes={} timers={} queues={} levels={} groups={} contested={}\n", n.nodes, n.timers, n.queues,
                 n.levels, n.groups, n.contested);
  for (std::uint32_t f = 0; f < n.facts; ++f) {
    const auto& a = t.fact_atoms[f];
    fmt::format_to(out, "fact {} {} plain={} attended={}\n", f, p.cells[f].name, a.plain, a.attended);
  }
  for (std::uint32_t s = 0; s < n.satellites; ++s) {
    const bool keep = (t.keep[s / mts::kWordBits] >> s % mts::kWordBits & 1u) != 0;
    fmt::format_to(out, "satellite {} {} initial={}{}\n", n.facts + s, p.cells[n.facts + s].name, t.initial[s], keep ? " keep" : "");
  }
  for (std::uint32_t l = 0; l < n.levels; ++l) {
    const auto& level = t.levels[l];
    fmt::format_to(out, "level {} {} words={}..{} stages={}..{}\n", l, p.levels[l], level.first_word, level.end_word,
                   level.first_stage, level.end_stage);
  }
  print_atoms(out, t, p);
  for (std::uint32_t i = 0; i < n.timers; ++i) {
    fmt::format_to(out, "timer {} {} for {} us\n", i, literal_name(t, p, t.timers[i].input), t.queue_us[t.timers[i].queue]);
  }
  print_rules(out, t, p);
  text += print(build_perception(p), p);
  for (std::size_t i = 0; i < t.fuzzy.size(); ++i) text += print(p.fuzzy[i], t.fuzzy[i]);
  return text;
}

}  // namespace kb::tables
