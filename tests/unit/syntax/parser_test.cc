#include <gtest/gtest.h>

#include "tests/unit/syntax/reading.h"

namespace kb::syntax::testing {
namespace {

std::string tree(const std::string& text) {
  const Reading reading = read(text);
  EXPECT_TRUE(reading.messages.empty()) << said(reading);
  return reading.tree;
}

TEST(Statements, are_separated_by_nothing) {
  EXPECT_EQ(tree("fact A fact B satellites C, D exclusive satellite E"),
            "fact\n  A\nfact\n  B\nsatellites\n  C\n  D\n  exclusive\nsatellite\n  E\n");
}

TEST(Statements, import_by_path_and_by_dotted_name) {
  EXPECT_EQ(tree("import \"a/b.kb\" import std.road"), "import \"a/b.kb\"\nimport std.road\n");
}

TEST(Statements, set_numbers_and_words) {
  EXPECT_EQ(tree("set event = 0.75, hold = 2 s, idle = stop"), "set\n  event = 0.75\n  hold = 2 s\n  idle = stop\n");
}

TEST(Declarations, let_one_of_serve_all_items_since_the_last) {
  EXPECT_EQ(tree("satellites A, B of X, C of Y[i], D exclusive = 0.5 keep"),
            "satellites\n  A of X\n  B of X\n  C of Y[i]\n  D\n  exclusive\n  keep\n  = 0.5\n");
}

TEST(Declarations, have_three_shapes_and_thresholds) {
  EXPECT_EQ(tree("facts A, G { a, b }, In[D, E] sat = +1 event 0.6 attention 0.1"),
            "facts\n  A\n  G { a, b }\n  In[D, E]\n  sat = 1\n  event 0.6\n  attention 0.1\n");
}

TEST(Relations, keep_their_satellites_apart_from_the_next_statement) {
  EXPECT_EQ(tree("relation R(a, b) satellites S, T"), "relation R(a, b)\nsatellites\n  S\n  T\n");
  EXPECT_EQ(tree("relation R(a) satellites exclusive relation S(b) satellites fact X"),
            "relation R(a)\n  satellites exclusive\nrelation S(b)\n  satellites\nfact\n  X\n");
  EXPECT_EQ(tree("relation R(to, by) satellites of to, by exclusive"),
            "relation R(to, by)\n  satellites of to, by exclusive\n");
}

TEST(Relations, have_rows_with_conditions) {
  EXPECT_EQ(tree("row d in Detour(instead: a.b, when: A is low and B) row in R(x: y)"),
            "row d in Detour\n  instead:\n    a.b\n  when:\n    and\n      A is low\n      B\nrow in R\n  x:\n    y\n");
}

TEST(Maps, take_the_clauses_of_a_road_in_any_order) {
  EXPECT_EQ(tree("map M { landmark A at (1, -2.5) landmark B road A.gate -> B.W through (1, 2), (3, 4) by mark }"),
            "map M\n  landmark A at (1, -2.5)\n  landmark B\n"
            "  road A.gate -> B.W by mark through (1, 2), (3, 4)\n");
}

TEST(Routes, name_exits_where_they_must) {
  EXPECT_EQ(tree("route R on M by S: A -> B.N -> C detour A -> B -> C on R when not Safe detours on R"),
            "route R on M by S\n  A\n  B.N\n  C\ndetour on R\n  A\n  B\n  C\n  when\n    not\n      Safe\ndetours on R\n");
}

TEST(Tables, have_one_or_two_parameters_and_more_entries) {
  EXPECT_EQ(tree("table f(A, B) -> C { x y  a: c d  b: d c } table g(A) -> C { a: c b: d }"),
            "table f(A, B) -> C\n  columns x y\n  a: c d\n  b: d c\ntable g(A) -> C\n  a: c\n  b: d\n");
  EXPECT_EQ(tree("names D more { NE } table f more { NE N: x }"), "names D more { NE }\ntable f more\n  columns NE\n  N: x\n");
  EXPECT_EQ(tree("names more { more } fact more"), "names more { more }\nfact\n  more\n");
}

TEST(Rules, have_binders_and_all_effects) {
  EXPECT_EQ(tree("rule r[l in Leg, d in D] at map while l then +l.next, -sat G[*], sat X = -0.5, reset"),
            "rule r\n  l in Leg\n  d in D\n  at map\n  while\n    l\n  then\n    +l.next\n    -sat G[*]\n"
            "    sat X = -0.5\n    reset\n");
}

TEST(Control, takes_numbers_with_units_and_words) {
  EXPECT_EQ(tree("control Cross[t, mark] = turn_on_line(turn: t, speed: 0.4 m/s, power: 50 %) control U = f()"),
            "control Cross[t, mark] = turn_on_line\n  turn: t\n  speed: 0.4 m/s\n  power: 50 %\ncontrol U = f\n");
}

// See note [words in context].
TEST(Words, are_names_where_nothing_else_can_stand) {
  EXPECT_EQ(tree("levels goal > route > map > when > control"), "levels goal > route > map > when > control\n");
  EXPECT_EQ(tree("names X { map, lost, row } facts G { when, at }"), "names X { map, lost, row }\nfacts\n  G { when, at }\n");
  EXPECT_EQ(tree("relation Detour(instead, first, when, by, at, on)"), "relation Detour(instead, first, when, by, at, on)\n");
  EXPECT_EQ(tree("rule r at when when d.when and Help[lost] then +Help.lost, -l.by"),
            "rule r\n  at when\n  when\n    and\n      d.when\n      Help[lost]\n  then\n    +Help.lost\n    -l.by\n");
  EXPECT_EQ(tree("map M { landmark at at (1, 2) landmark road road at.by -> road.on by map }"),
            "map M\n  landmark at at (1, 2)\n  landmark road\n  road at.by -> road.on by map\n");
  EXPECT_EQ(tree("table f(A) -> B { map: route row: on }"), "table f(A) -> B\n  map: route\n  row: on\n");
}

TEST(Words, that_begin_the_next_line_are_not_swallowed) {
  const Reading reading = read("names X { a, b\nmap M { }\nlevels a >\nrule r at l when A then +B\n");
  EXPECT_EQ(said(reading), "1:15 expected `}` before the next statement, `map`\n"
                           "3:11 expected a level after `>`, found the next statement, `rule`\n");
  EXPECT_TRUE(reading.tree.starts_with("map M\nrule r\n"));
}

TEST(Places, of_statements_and_references_are_exact) {
  source::Sources sources;
  const auto file = sources.add("t.kb", "fact A\n  rule r at l when G[a].b then +X.y # c\n");
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  const Tree parsed = parse(sources, file, diagnostics);
  ASSERT_EQ(parsed.statements.size(), 2u);
  EXPECT_EQ(sources.text(parsed.statements[1].span), "rule r at l when G[a].b then +X.y");
  const auto& rule = std::get<Rule>(parsed.statements[1].node);
  EXPECT_EQ(sources.text(parsed[rule.condition].span), "G[a].b");
  EXPECT_EQ(sources.text(parsed[parsed[rule.condition].ref].postfixes[0].span), "[a]");
  EXPECT_EQ(sources.text(rule.effects[0].span), "+X.y");
}

}  // namespace
}  // namespace kb::syntax::testing
