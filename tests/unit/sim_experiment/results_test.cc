// Results are read back as they were written, and only if a run can have led to them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "sim/experiment/results.h"
#include "tests/unit/whole_file.h"

namespace kb::sim::experiment {
namespace {

TEST(RowTest, comes_back_as_it_was_written) {
  Row row;
  row.scenario = 17;
  row.method = "mine";
  row.set = 1;
  row.what = Class::kPlace;
  row.kinds = "worn+carried";
  row.outcome = "stopped";
  row.reports = "Help.lost";
  row.time_s = 12.5;
  row.shortest_s = row.shortest_m = 10.0;
  row.lost_unaware = true;
  row.labyrinth = 1;
  experiment::Setup setup;
  setup.labyrinths = 4;
  const Combinations& set = setup.set = {{{"robot.slip", "0.1"}, {"limit", "6"}}, {{"robot.slip", "0.1"}, {"limit", "60"}}};
  row.what = Class::kNone;   // as the 17th scenario of four labyrinths has it
  row.kinds = "";
  const std::string line = print(row, set);
  EXPECT_TRUE(line.starts_with("17,mine,0.1,60,1,0,none,")) << line;
  const auto again = parse_row(line, setup);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->set, 1u);
  EXPECT_EQ(print(*again, set), line);
  EXPECT_FALSE(parse_row(line, experiment::Setup{}));
  EXPECT_FALSE(parse_row("17,mts,0.1,6,0", setup));
  EXPECT_FALSE(parse_row(line + ",1", setup));
  EXPECT_FALSE(parse_row("x" + line, setup));
  row.time_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(parse_row(print(row, set), setup)) << "a result that is no number was never driven";
}

TEST(ResultsTest, a_row_that_no_run_of_its_scenario_can_have_led_to_is_refused) {
  experiment::Setup setup;
  setup.scenarios = 100;
  const std::string_view good = "62,mts,2,0,3 place,worn+tag_wrong,stopped,Help.lost,40.0,9.00,36.8,11.20,0,0,0,0,0.00,0.00,0.500,0,31.5,123";
  ASSERT_TRUE(parse_row(good, setup));
  EXPECT_TRUE(parse_row("1,bug2,1,0,none,,stopped,no way,77.9,3.29,61.7,19.69,0,0,0,0,0.00,0.00,,0,17.9,3880619436174751", setup));
  const auto with = [&](std::string_view was, std::string_view is) {
    std::string row(good);
    return row.replace(row.find(was), was.size(), is);
  };
  for (const auto& [was, is] : std::initializer_list<std::pair<std::string_view, std::string_view>>{
           {"mts,2,0", "mts,9999,0"}, {"mts,2,0", "mts,2,77"}, {"3 place", "2 between"}, {"62,", "162,"}, {"worn+tag_wrong", "NOT A KIND"}, {"worn+tag_wrong", "power"},
           {"worn+tag_wrong", ""}, {"worn+tag_wrong", "worn+"}, {"worn+tag_wrong", "\"worn"}, {"Help.lost", "boo\thoo"}, {"Help.lost", "\""}, {"stopped", "lost"},
           {"40.0", "-5"}, {"40.0", "4000.0"}, {"9.00", "1e300"}, {"9.00", "9.0"}, {"36.8", "0.0"}, {"11.20", "0.00"}, {"31.5", "41.0"}, {"0.500,0", "0.500,17"},
           {"123", "123/"}, {"0.500", "-1.000"}}) {
    EXPECT_FALSE(parse_row(with(was, is), setup)) << with(was, is);
  }
}

TEST(ResultsTest, a_limit_that_is_set_bounds_the_time) {
  experiment::Setup setup;
  const std::string_view row = "0,mts,900,0,0,none,,arrived,,700.0,9.00,36.8,11.20,0,0,0,0,0.00,0.00,,0,700.0,1";
  setup.set = {{{"limit", "900"}}};
  EXPECT_TRUE(parse_row(row, setup));
  setup.set = {{{"robot.slip", "900"}}};
  EXPECT_FALSE(parse_row(row, setup));
}

TEST(ResultsTest, a_way_of_no_length_is_none_that_others_are_measured_by) {
  const auto reads = [](std::string_view shortest) {
    return parse_row(fmt::format("0,mts,0,0,none,,arrived,,0.0,0.00,{},0,0,0,0,0.00,0.00,,0,0.0,1", shortest), experiment::Setup{}).has_value();
  };
  EXPECT_TRUE(reads("36.8,11.20"));
  EXPECT_FALSE(reads("0.0,11.20"));
  EXPECT_FALSE(reads("36.8,-1"));
  EXPECT_FALSE(reads("0.04,11.20")) << "written again it is 0.0";
}

TEST(ResultsTest, a_torn_line_is_cut_off_and_another_experiment_is_left_alone) {
  const std::string path = ::testing::TempDir() + "waymark_results_test.csv";
  std::filesystem::remove(path);
  experiment::Setup two;
  two.scenarios = 2;
  Row row;
  row.method = "mts";
  row.outcome = "arrived";
  row.shortest_s = row.shortest_m = 1.0;
  {
    Results results;
    ASSERT_EQ(results.open(path, "# kbc 0, seed 1", two), Results::Opened::kOpen);
    ASSERT_TRUE(results.add(row));
    EXPECT_EQ(results.bad_line(), 0u);
  }
  // A scenario that this experiment does not have, and a line without an end.
  const std::string rest = ",0,none,,arrived,,0.0,0.00,1.0,1.00,0,0,0,0,0.00,0.00,,0,0.0,0\n";
  std::ofstream(path, std::ios::app) << "2,mts,2" + rest + "1,mts,1,0,no";
  {
    Results results;
    ASSERT_EQ(results.open(path, "# kbc 0, seed 1", two), Results::Opened::kOpen);
    EXPECT_EQ(results.sorted().size(), 1u);
    EXPECT_EQ(results.bad_line(), 4u);
    row.scenario = row.labyrinth = 1;
    ASSERT_TRUE(results.add(row));
  }
  EXPECT_EQ(whole_file(path), "# kbc 0, seed 1\n" + row_header({{}}) + "\n" + "0,mts,0" + rest + "1,mts,1" + rest);
  Results other;
  EXPECT_EQ(other.open(path, "# kbc 0, seed 2", two), Results::Opened::kOther);
  EXPECT_EQ(other.error(), "seed 1 instead of 2");
  std::filesystem::remove(path);
}

TEST(ResultsTest, somebody_elses_file_is_left_alone_however_short_and_a_torn_beginning_is_not) {
  const std::string path = ::testing::TempDir() + "waymark_short_results_test.csv";
  for (const auto& [bytes, opened] : {std::pair("hello", Results::Opened::kNotOurs), std::pair("# kbc fleet, batch 1, 2 runs\n", Results::Opened::kNotOurs), std::pair("# a\nscen", Results::Opened::kOpen), std::pair("", Results::Opened::kOpen)}) {
    std::ofstream(path, std::ios::trunc) << bytes;
    EXPECT_EQ(Results().open(path, "# a", experiment::Setup{}), opened) << bytes;
    EXPECT_EQ(whole_file(path), opened == Results::Opened::kNotOurs ? bytes : "# a\n" + row_header({{}}) + "\n");
  }
  std::filesystem::remove(path);
}

TEST(ResultsTest, of_another_experiment_tell_in_what_it_differs) {
  const std::string path = ::testing::TempDir() + "waymark_other_results_test.csv";
  std::filesystem::remove(path);
  const std::string head = "# kbc 0.1.0 12, seed 1, scenarios 8, labyrinths 2, maze none, rules 34";
  ASSERT_EQ(Results().open(path, head + ", limit=60", experiment::Setup{}), Results::Opened::kOpen);
  const auto differs = [&](const std::string& from) {
    Results results;
    EXPECT_EQ(results.look(path, from, experiment::Setup{}), Results::Opened::kOther);
    return results.error();
  };
  EXPECT_EQ(differs("# kbc 0.1.0 13, seed 1, scenarios 8, labyrinths 2, maze none, rules 34, limit=60"), "another kbc");
  EXPECT_EQ(differs("# kbc 0.1.0 12, seed 2, scenarios 9, labyrinths 2, maze 56, rules 34, limit=60"), "seed 1 instead of 2, scenarios 8 instead of 9, no maze");
  EXPECT_EQ(differs("# kbc 0.1.0 12, seed 1, scenarios 8, labyrinths 2, maze none, rules 35, limit=60,70"), "other rules of the library, limit=60 instead of 60,70");
  EXPECT_EQ(differs(head), "limit=60");
  EXPECT_EQ(differs(head + ", robot.size=2"), "limit=60, no robot.size=2");
  std::filesystem::remove(path);
}

TEST(ResultsTest, a_mind_comes_in_later_and_is_not_another_one_by_the_same_name) {
  const std::string path = ::testing::TempDir() + "waymark_minds_test.csv";
  std::filesystem::remove(path);
  const auto open = [&](const Results::Minds& minds) {
    Results results;
    const auto opened = results.open(path, "# a", experiment::Setup{}, minds);
    Row row;
    row.outcome = "arrived";
    row.shortest_s = row.shortest_m = 1.0;
    row.method = minds.empty() ? "mts" : minds.begin()->first;
    if (opened != Results::Opened::kOtherMind) {
      EXPECT_TRUE(results.add(row));
    }
    return std::pair(opened, results.sorted().size());
  };
  using Opened = Results::Opened;
  EXPECT_EQ(open({}), std::pair(Opened::kOpen, std::size_t{1}));
  EXPECT_EQ(open({{"b", "2"}}), std::pair(Opened::kOpen, std::size_t{2}));
  EXPECT_EQ(open({{"a", "1"}}), std::pair(Opened::kOpen, std::size_t{3}));
  EXPECT_EQ(open({{"b", "3"}}).first, Opened::kOtherMind);
  EXPECT_EQ(open({}), std::pair(Opened::kOpen, std::size_t{3}));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace kb::sim::experiment
