// Robots of other sizes: everything of a floor of size 4 is four times as long, and what drives it does the same, twice as slowly.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

constexpr double kSize = 4.0;
constexpr float kLength = 4.0f, kTime = 2.0f;   // exact in binary: so must be all that is made of them

struct Pair {
  std::unique_ptr<Laboratory> small, large;
};

/// The same knowledge on both; what control lines say is as much longer and faster.
Pair both(std::string_view file) {
  Pair pair{Laboratory::of_file(file), nullptr};
  LayoutOptions layout;
  layout.build.size = kSize;
  layout.scale = kSize * pair.small->labyrinth->scale;
  layout.build.widths = {kSize * PaintWidths{}.line_m, kSize * PaintWidths{}.stop_line_m};
  pair.large = Laboratory::of_file(file, layout);
  for (Strategy& strategy : pair.large->knowledge->strategies) {
    for (auto& setting : strategy.settings) setting.number = mts::Similarity(kLength).out(setting.number, mts::find_parameter(strategy.controller, setting.name.c_str())->unit);
  }
  return pair;
}

void expect_as_large(Spot small, Spot large) {
  EXPECT_EQ(large.x_m, kSize * small.x_m);
  EXPECT_EQ(large.y_m, kSize * small.y_m);
}
template <class List>
void expect_lines_as_large(const List& small, const List& large) {
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t i = 0; i < small.size(); ++i) {
    expect_as_large(small[i].from, large[i].from);
    expect_as_large(small[i].to, large[i].to);
  }
}

class Size : public ::testing::TestWithParam<const char*> {};

TEST_P(Size, AllThatIsBuiltOnAFloorGrowsWithIt) {
  const Pair pair = both(GetParam());
  const Labyrinth &small = *pair.small->labyrinth, &large = *pair.large->labyrinth;
  expect_lines_as_large(small.paint, large.paint);
  expect_lines_as_large(small.stop_lines, large.stop_lines);
  expect_lines_as_large(small.walls, large.walls);
  ASSERT_EQ(small.tags.size(), large.tags.size());
  for (std::size_t i = 0; i < small.tags.size(); ++i) expect_as_large(small.tags[i].at, large.tags[i].at);
  ASSERT_EQ(small.pillars.size(), large.pillars.size());
  for (std::size_t i = 0; i < small.pillars.size(); ++i) EXPECT_EQ(large.pillars[i].radius_m, kSize * small.pillars[i].radius_m);
  expect_as_large(small.low, large.low);
  expect_as_large(small.high, large.high);
  const Pose here = pair.small->plain().start, there = pair.large->scenario("[sensors.line]\nspan = 0.4\n").start;   // its tape is broader than the usual
  expect_as_large({here.x_m, here.y_m}, {there.x_m, there.y_m});
}

/// Drives the small robot, and asks at each step what the large one would do that saw the same.
class Twins final : public Helm {
 public:
  Twins(const Pair& pair, const mts::Body& body)
      : pair_(pair), floor_(*pair.large->labyrinth), small_(*pair.small->knowledge, *pair.small->labyrinth, body), large_(*pair.large->knowledge, *pair.large->labyrinth, mts::Similarity(kLength).out(body)) {}

  mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) override {
    constexpr std::int64_t kTickUs = 100'000;
    if (now_us / kTickUs != ticked_) {
      ticked_ = now_us / kTickUs;
      for (Driver* driver : {&small_, &large_}) static_cast<void>(driver->tick(ticked_ * kTickUs, kTickUs));
      EXPECT_EQ(small_.strategy() != nullptr ? small_.strategy()->name : "", large_.strategy() != nullptr ? large_.strategy()->name : "") << now_us;
      EXPECT_TRUE(std::ranges::equal(small_.mind().facts(), large_.mind().facts())) << now_us;
    }
    mts::Senses larger = senses;
    for (float& range_m : larger.range_m) range_m *= kLength;
    for (float* one : {&larger.x_m, &larger.y_m}) *one *= kLength;
    larger.speed_m_s *= kLength / kTime;
    TagHeard there = tag;
    if (tag.memory != nullptr) there.memory = floor_.memory(pair_.large->labyrinth->crossing(tag.memory->landmark));
    const mts::Motion motion = small_.hear(senses, tag, dt_s), slower = large_.hear(larger, there, kTime * dt_s);
    EXPECT_EQ(slower.speed_m_s, kLength / kTime * motion.speed_m_s) << now_us;
    EXPECT_EQ(slower.turn_rad_s, motion.turn_rad_s / kTime) << now_us;
    ran_.insert(small_.strategy() != nullptr ? small_.strategy()->name : "");
    return motion;
  }
  void press(program::CellId fact, bool /*held*/) override {
    for (Driver* driver : {&small_, &large_}) driver->mind().press(fact, 2);
  }
  Judge::Belief belief() const override { return {}; }
  std::optional<bool> mission() const override { return small_.on_mission(); }
  const std::string& goal() const override { return goal_; }
  std::vector<std::string> reports() const override { return small_.reports(); }
  [[nodiscard]] const std::set<std::string>& ran() const { return ran_; }

 private:
  const Pair& pair_;
  Floor floor_;
  Driver small_, large_;
  std::int64_t ticked_ = 0;
  std::string goal_;
  std::set<std::string> ran_;
};

TEST_P(Size, WhoDrivesItDoesTheSameInItsOwnMeasure) {
  const Pair pair = both(GetParam());
  const Scenario scenario = pair.small->plain();
  Twins twins(pair, as_driven(scenario.body, scenario.sensors.range, scenario.drive));
  DriveOptions options;
  options.helm = &twins;
  Drive drive(*pair.small->labyrinth, *pair.small->knowledge, scenario, options);
  while (drive.step() && !::testing::Test::HasFailure()) {
  }
  EXPECT_GE(twins.ran().size(), 4u) << "it drove";
  EXPECT_FALSE(twins.mission().value()) << "to the end";
}

INSTANTIATE_TEST_SUITE_P(Floors, Size,
                         ::testing::Values("examples/04_simulator/route1.kb", "examples/07_open_hall/bug.kb", "examples/07_open_hall/neural_map.kb", "examples/07_open_hall/fuzzy.kb"),
                         [](const auto& file) {
                           std::string name(file.param);
                           name = name.substr(name.rfind('/') + 1);
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace kb::sim::testing
