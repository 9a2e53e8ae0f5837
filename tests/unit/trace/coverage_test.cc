#include "tools/kbc/trace/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/unit/trace/sample.h"

namespace kb::trace {
namespace {

using program::testing::cell;
using program::testing::rule;

struct Sample {
  Sample() {
    model::Map map;
    map.landmarks = {model::RowId{0}};
    model::Cell landmark;
    landmark.name = "Line";
    model.cells.push_back(landmark);
    model::Row row;
    row.cell = model::CellId{0};
    model.rows.push_back(row);
    model.maps.push_back(map);
  }
  void run(const std::vector<std::map<std::string, float>>& ticks) {
    program::Interpreter interpreter(program);
    interpreter.observe(&coverage);
    coverage.begin_run();
    for (const auto& facts : ticks) {
      coverage.before(interpreter);
      coverage.after(interpreter.tick(program::testing::facts(program, facts), 100'000), interpreter);
    }
  }
  [[nodiscard]] CoverageReport report() const { return summarise("sample.kb", {sources, model, program, dead}, coverage); }

  program::Program program = testing::sample_program();
  source::Sources sources;
  model::Model model;
  std::vector<bool> dead;
  Coverage coverage{program};
};

TEST(Coverage, counts_firings_and_true_conditions_over_all_runs) {
  Sample covered;
  covered.run({{}, {{"Start", 1.0f}}, {}});
  covered.run({{}, {{"Start", 1.0f}}, {{"Line", 1.0f}}, {{"Line", 1.0f}}});
  EXPECT_EQ(covered.coverage.runs(), 2u);
  EXPECT_EQ(covered.coverage.ticks(), 7u);
  EXPECT_EQ(covered.coverage.rule(rule(covered.program, "obey")).fired, 2u);
  EXPECT_EQ(covered.coverage.rule(rule(covered.program, "wait")).fired, 1u);
  EXPECT_EQ(covered.coverage.rule(rule(covered.program, "pass[S]")).held, 0u);
  EXPECT_EQ(covered.coverage.raised(cell(covered.program, "Driving")), 2u);
  EXPECT_EQ(covered.coverage.strategy(cell(covered.program, "Move")).starts, 2u);
}

TEST(Coverage, tells_events_with_attention_from_those_without) {
  Sample covered;
  covered.run({{}, {{"Start", 0.6f}, {"Line", 0.6f}}, {{"Line", 0.9f}}});
  EXPECT_EQ(covered.coverage.fact(cell(covered.program, "Start")).attended, 1u);
  EXPECT_EQ(covered.coverage.fact(cell(covered.program, "Line")).attended, 0u);
  EXPECT_EQ(covered.coverage.fact(cell(covered.program, "Line")).unattended, 1u);
  EXPECT_EQ(covered.coverage.fact(cell(covered.program, "Line")).seen, 1u);
}

TEST(Coverage, takes_a_satellite_at_the_threshold_of_firing_as_high) {
  Sample covered;
  for (program::Rule& rule : covered.program.rules) {
    for (program::Write& write : rule.writes) write.value = std::min(write.value, static_cast<float>(covered.program.settings.firing));
  }
  covered.run({{}, {{"Start", 1.0f}}});
  EXPECT_EQ(covered.coverage.raised(cell(covered.program, "Driving")), 1u);
}

TEST(Coverage, is_told_in_words) {
  Sample covered;
  covered.run({{}, {{"Start", 1.0f}}, {}});
  const std::string text = print_text(covered.report());
  for (const char* line :
       {"coverage of sample.kb: 1 case, 3 ticks\n", "rules: 2 of 5 fired, with 2 of 7 instances\n", "`pass` at drive",
        "its condition was never true", "`run` at control: 1 of 2 instances fired; not run[Stop]\n",
        "landmarks: 0 of 1 seen\n  not Line\n", "events: 1 with attention, 0 without\n",
        "strategies: 1 of 2 ran\n  not Stop\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nis not in\n" << text;
}

TEST(Coverage, of_the_library_is_a_line) {
  Sample covered;
  covered.dead.assign(covered.program.rules.size(), false);
  for (std::size_t i = 0; i < covered.dead.size(); ++i) covered.dead[i] = covered.program.rules[i].tmpl() == "pass";
  covered.dead[index(rule(covered.program, "run[Stop]"))] = true;   // one of two instances
  covered.run({{}, {{"Start", 1.0f}}, {}});
  CoverageReport report = covered.report();
  for (auto& one : report.templates) one.library = one.name == "obey" || one.name == "wait";
  for (auto& strategy : report.strategies) strategy.library = strategy.name == "Stop";
  const std::string text = print_text(without_library(report));
  for (const char* line : {"rules: 1 of 3 fired", "`pass` at drive", "it never can", "strategies: 1 of 1 ran\n",
                           "standard library: 1 of 2 rules fired, 0 of 1 strategies ran; `--coverage-library` lists these\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nis not in\n" << text;
  EXPECT_EQ(text.find("it never can"), text.rfind("it never can")) << text;
  EXPECT_EQ(text.find("`wait`"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(print_json({report}));
  EXPECT_EQ(json.at(0).at("rules").size(), report.templates.size());
}

TEST(Coverage, is_json_with_every_instance) {
  Sample covered;
  covered.run({{}, {{"Start", 1.0f}}});
  const auto json = nlohmann::json::parse(print_json({covered.report()}));
  const auto& rules = json.at(0).at("rules");
  const auto pass = std::find_if(rules.begin(), rules.end(), [](const auto& one) { return one.at("rule") == "pass"; });
  ASSERT_NE(pass, rules.end());
  EXPECT_EQ(pass->at("instances").size(), 2u);
  EXPECT_EQ(pass->at("fired"), 0);
}

TEST(Coverage, is_a_page_that_asks_for_nothing_from_elsewhere) {
  Sample covered;
  covered.run({{}});
  auto report = covered.report();
  report.program = "a<b>&.kb";
  const std::string page = print_html({report});
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("a&lt;b&gt;&amp;.kb"), std::string::npos);
  EXPECT_NE(page.find("✗ never"), std::string::npos) << "states are told by signs and words too";
}

TEST(Coverage, has_a_table_of_landmarks_and_one_of_other_facts) {
  Sample covered;
  covered.run({{}, {{"Start", 1.0f}}, {{"Line", 1.0f}}});
  const std::string page = print_html({covered.report()});
  const auto at = [&](const char* what) { return page.find(what); };
  ASSERT_NE(at("<h3>Strategies</h3>"), std::string::npos);
  EXPECT_LT(at("<h3>Landmarks</h3>"), at("<code>Line</code>"));
  EXPECT_LT(at("<code>Line</code>"), at("<h3>Other facts</h3>"));
  EXPECT_LT(at("<h3>Other facts</h3>"), at("<code>Start</code>"));
  EXPECT_LT(at("<code>Start</code>"), at("<h3>Strategies</h3>"));
  EXPECT_NE(at("<h3>Rules</h3>"), std::string::npos);
}

}  // namespace
}  // namespace kb::trace
