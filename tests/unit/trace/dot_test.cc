#include "compiler/emit/dot.h"

#include <gtest/gtest.h>

#include "tests/unit/trace/sample.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/graphviz.h"

namespace kb::emit {
namespace {

using model::Model;
using model::RowId;
using model::Value;

// A -E- B by the first method, B -> C by the second through a bend; a route A, B, C.
struct Labyrinth {
  Labyrinth() {
    model.sets = {{"Direction", {"N", "E", "S", "W"}, {}, {}}, {"Method", {"mark", "dist"}, {}, {}}};
    const auto landmarks = relation("Landmark", {"at"}),
               roads = relation("Road", {"from", "to", "exit", "approach", "by"});
    const auto legs = relation("Leg", {"from", "to", "exit", "next", "ends"}),
               routes = relation("Route", {"command", "first"});
    model.points = {{0, 0}, {2, 0}};
    const RowId a = row(landmarks, "A", {model::PointId{0}}), b = row(landmarks, "B", {model::PointId{1}}),
                c = row(landmarks, "C \"x\"", {Value{}});
    const RowId east = row(roads, "", {a, b, direction(1), direction(3), method(0)}),
                west = row(roads, "", {b, a, direction(3), direction(1), method(0)});
    const RowId south = row(roads, "", {b, c, direction(2), direction(0), method(1)});
    model::Map map;
    map.landmarks = {a, b, c};
    map.roads = {{0, east, 0, 0}, {0, west, 0, 0}, {1, south, 0, 1}};
    map.bends = {{2, -1}};
    model.maps.push_back(map);
    const RowId second = row(legs, "R.2", {b, c, direction(2), Value{}, Value{}});
    const RowId first = row(legs, "R.1", {a, b, direction(1), second, Value{}});
    const RowId route = row(routes, "R", {Value{}, first});
    model.values[model[second].first + 4] = route;
  }
  model::RelationId relation(std::string name, std::vector<std::string> fields) {
    model::Relation one;
    one.name = std::move(name);
    one.fields = std::move(fields);
    model.relations.push_back(one);
    return model::RelationId{static_cast<std::uint32_t>(model.relations.size() - 1)};
  }
  RowId row(model::RelationId of, std::string_view name, const std::vector<Value>& fields) {
    const RowId id{static_cast<std::uint32_t>(model.rows.size())};
    model::Row one;
    one.relation = of;
    one.name = model.texts->keep(name);
    one.first = static_cast<std::uint32_t>(model.values.size());
    model.values.insert(model.values.end(), fields.begin(), fields.end());
    model.rows.push_back(std::move(one));
    model.relations[index(of)].rows.push_back(id);
    return id;
  }
  static Value direction(std::uint32_t i) { return model::Member{model::SetId{0}, i}; }
  static Value method(std::uint32_t i) { return model::Member{model::SetId{1}, i}; }
  Model model;
};

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(MapDot, draws_each_road_once_in_the_line_of_its_method_with_its_exits) {
  const std::string dot = print_map_dot(Labyrinth().model);
  EXPECT_TRUE(has(dot, "  l0 -> l1 [style=solid, dir=none, taillabel=\"E\", headlabel=\"W\"];\n")) << dot;
  EXPECT_FALSE(has(dot, "l1 -> l0 [")) << dot;
  EXPECT_TRUE(has(dot,
                  "  l1 -> b1_1_0 [style=dashed, dir=forward, taillabel=\"S\"];\n  b1_1_0 -> l2 [style=dashed, "
                  "dir=forward, headlabel=\"N\"];\n"))
      << dot;
  EXPECT_TRUE(has(dot, "solid: mark   dashed: dist")) << dot;
}

TEST(MapDot, puts_landmarks_where_they_are_and_marks_where_a_route_ends) {
  const std::string dot = print_map_dot(Labyrinth().model);
  EXPECT_TRUE(has(dot, "l1 [label=\"B\", pos=\"1.700,0.000!\"];")) << dot;
  EXPECT_TRUE(has(dot, "l2 [label=\"C \\\"x\\\"\", peripheries=2];")) << dot;
}

TEST(MapDot, numbers_the_legs_of_a_route_and_follows_bends) {
  const std::string dot = print_map_dot(Labyrinth().model);
  EXPECT_TRUE(has(dot, "label=\"R 1\"")) << dot;
  EXPECT_TRUE(has(dot, "l1 -> b1_1_0 [color=\"#0072B2\"")) << dot;
}

TEST(MapDot, ends_at_a_route_that_bites_its_tail) {
  Labyrinth labyrinth;
  for (auto& row : labyrinth.model.rows)
    if (row.name == "R.2") labyrinth.model.values[row.first + 3] = RowId{static_cast<std::uint32_t>(labyrinth.model.rows.size() - 2)};
  EXPECT_TRUE(has(print_map_dot(labyrinth.model), "R 2"));
}

TEST(LevelsDot, leads_from_the_nearest_level_that_writes_to_the_rules_that_read) {
  const auto program = trace::testing::sample_program();
  const std::string dot = print_levels_dot({}, program);
  EXPECT_TRUE(has(dot, "\"rule 0 obey\" -> \"cell 0 Driving\";")) << dot;
  EXPECT_TRUE(has(dot, "\"cell 0 Driving\" -> \"rule 1 wait\" [style=dashed];")) << dot;
  EXPECT_TRUE(has(dot, "\"cell 1 Driving\" -> \"rule 2 run\" [style=dashed];")) << dot;
  EXPECT_FALSE(has(dot, "\"cell 0 Driving\" -> \"rule 2 run\"")) << dot;
}

TEST(LevelsDot, tells_in_the_rule_what_comes_from_outside_or_from_the_last_tick) {
  const auto program = trace::testing::sample_program();
  const std::string dot = print_levels_dot({}, program);
  EXPECT_TRUE(has(dot, R"("obey\l  facts: Start\l  last tick: Driving\l")")) << dot;
  EXPECT_TRUE(has(dot, R"("abort\l  facts: Abort\l  resets all satellites\l")")) << dot;
}

TEST(RulesDot, shows_what_an_instance_reads_and_writes) {
  const auto program = trace::testing::sample_program();
  const std::string dot = print_rules_dot(program, trace::find_rules(program, "pass[S]"));
  EXPECT_TRUE(has(dot, "label=\"Near[left,far]\"")) << dot;
  EXPECT_TRUE(has(dot, "[label=\"1\"]")) << dot;
  EXPECT_TRUE(has(dot, "label=\"others of: Driving Gate\"")) << dot;
}

TEST(Graphviz, draws_all_three_kinds_or_says_why_not) {
  const auto program = trace::testing::sample_program();
  for (const std::string& dot : {print_map_dot(Labyrinth().model), print_levels_dot({}, program),
                                 print_rules_dot(program, trace::find_rules(program, "pass"))}) {
    const trace::Drawing drawing = trace::draw_svg(dot);
    if (drawing.outcome == trace::Drawing::Outcome::kNotInstalled) GTEST_SKIP() << "Graphviz is not installed";
    ASSERT_EQ(drawing.outcome, trace::Drawing::Outcome::kDrawn) << drawing.error;
    EXPECT_TRUE(has(drawing.svg, "</svg>"));
  }
  const trace::Drawing wrong = trace::draw_svg("digraph {");
  EXPECT_EQ(wrong.outcome, trace::Drawing::Outcome::kFailed);
  EXPECT_TRUE(has(wrong.error, "syntax error")) << wrong.error;
}

}  // namespace
}  // namespace kb::emit
