#include "tools/kbc/trace/table.h"

#include <gtest/gtest.h>

#include "tests/unit/trace/sample.h"
#include "tools/kbc/trace/cell_names.h"

namespace kb::trace {
namespace {

using program::testing::Trial;

std::string table_of(const TableOptions& options) {
  Trial run(testing::sample_program());
  Table table(run.program(), options);
  const auto step = [&](const std::map<std::string, float>& facts) {
    const program::Tick tick = run(facts);
    EXPECT_TRUE(table.add(tick, [&](program::CellId cell) { return run.interpreter().value(cell); }));
  };
  step({});
  step({{"Start", 1.0f}});
  step({});
  step({});
  step({{"Line", 0.9f}});
  return table.print();
}

TEST(Table, shows_by_default_what_changes_and_when) {
  EXPECT_EQ(table_of({}),
            "tick          1    2    3    5\n"
            "t             0  0.1  0.2  0.4\n"
            "\n"
            "facts\n"
            "  Start       0    1    0    0\n"
            "  Line        0    0    0  0.9\n"
            "\n"
            "satellites\n"
            "  sat Start   1   -1   -1   -1\n"
            "  Driving    -1    1    1   -1\n"
            "  Gate       -1   -1   -1    1\n"
            "\n"
            "strategies\n"
            "  Stop       -1   -1   -1    1\n"
            "  Move       -1    1    1   -1\n");
}

TEST(Table, shows_what_changes_on_the_first_tick) {
  Trial run(testing::sample_program());
  Table table(run.program(), {});
  for (int i = 0; i < 2; ++i) {
    const program::Tick tick = run({{"Line", 0.9f}});
    EXPECT_TRUE(table.add(tick, [&](program::CellId cell) { return run.interpreter().value(cell); }));
  }
  EXPECT_NE(table.print().find("  Line "), std::string::npos) << table.print();
  EXPECT_EQ(table.print().find("Safe"), std::string::npos) << table.print();
}

TEST(Table, shows_every_chosen_cell_at_every_chosen_tick) {
  EXPECT_EQ(table_of({.cells = "Safe Move", .ticks = TickRange{2, 4}}),
            "tick          2    3    4\n"
            "t           0.1  0.2  0.3\n"
            "\n"
            "facts\n"
            "  Safe        0    0    0\n"
            "\n"
            "strategies\n"
            "  Move        1    1    1\n");
}

TEST(Table, names_what_runs_where_two_strategies_are_high) {
  const auto program = testing::sample_program();
  const CellNames names(program);
  const auto stop = names.find("Stop"), move = names.find("Move");
  Table table(program, {.cells = "Stop Move"});
  program::Tick tick;
  for (tick.number = 1; tick.number <= 2; ++tick.number) {
    if (tick.number == 2) tick.active = {stop, move};
    tick.strategy = tick.number == 2 ? stop : program::CellId::kNone;
    ASSERT_TRUE(table.add(tick, [&](program::CellId) { return tick.number == 2 ? 1.0f : -1.0f; }));
  }
  EXPECT_EQ(table.print(),
            "tick         1     2\n"
            "t            0     0\n"
            "\n"
            "strategies\n"
            "  Stop      -1     1\n"
            "  Move      -1     1\n"
            "\n"
            "runs         -  Stop\n");
}

TEST(TickRange, is_a_tick_or_from_to) {
  const auto bounds = [](std::string_view text) {
    const auto range = parse_ticks(text);
    return range ? std::make_pair(range->first, range->last) : std::make_pair(std::uint64_t{0}, std::uint64_t{0});
  };
  EXPECT_EQ(bounds("7"), (std::pair<std::uint64_t, std::uint64_t>{7, 7}));
  EXPECT_EQ(bounds("7-19"), (std::pair<std::uint64_t, std::uint64_t>{7, 19}));
  EXPECT_EQ(bounds("7-"), (std::pair<std::uint64_t, std::uint64_t>{7, UINT64_MAX}));
  EXPECT_EQ(bounds("-19"), (std::pair<std::uint64_t, std::uint64_t>{1, 19}));
  for (const char* wrong : {"", "-", "0", "5-3", "a", "1-2-3", "1,2"}) EXPECT_FALSE(parse_ticks(wrong)) << wrong;
}

}  // namespace
}  // namespace kb::trace
