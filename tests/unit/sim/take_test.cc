// Another knowledge base between two ticks of a robot that is driving.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <functional>

#include "compiler/tables/image.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

/// A mission through four landmarks in a row, on an image, as a mind needs it to take another.
struct Mission {
  explicit Mission(std::string_view way)
      : laboratory(Laboratory::of_text(fmt::format(R"(
import std.navigation
map Town {{
    landmark Inn  at (0, 0)
    landmark Well at (3, 0)
    landmark Mill at (6, 0)
    landmark Barn at (9, 0)
    road Inn.E -- Well.W by mark
    road Well.E -- Mill.W by mark
    road Mill.E -- Barn.W by mark
}}
command Go
route Errand on Town by Go: {}
control Move.mark      = follow_line(speed: 0.4 m/s)
control Cross[t, mark] = turn_on_line(turn: t, speed: 0.2 m/s)
)", way))),
        image(tables::write_image(laboratory->compiled->tables, laboratory->compiled->program)) {
    laboratory->knowledge->image = &image;
  }
  [[nodiscard]] const Knowledge& knowledge() const { return *laboratory->knowledge; }

  std::unique_ptr<Laboratory> laboratory;
  tables::LoadedImage image;
};

/// Drives by one mission, and by another one from some moment on.
class Changing final : public Helm {
 public:
  explicit Changing(const Mission& first) : now_(&first.knowledge()), driver_(*now_, *first.laboratory->labyrinth, kRobot) {}

  /// Asked before each tick: the knowledge base to go on with; null: the same.
  std::function<const Knowledge*(const Driver&)> next = [](const Driver&) { return nullptr; };
  std::string trace;

  void press(program::CellId fact, bool) override { driver_.mind().press(fact, 2); }
  mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) override {
    if (now_us % 100'000 < kControlUs) tick(now_us);
    return driver_.hear(senses, tag, dt_s);
  }
  Judge::Belief belief() const override {
    Judge::Belief belief;
    belief.leg = driver_.leg();
    belief.strategy = driver_.strategy();
    return belief;
  }
  std::optional<bool> mission() const override { return driver_.on_mission(); }
  const std::string& goal() const override { return now_->missions.front().goal; }
  std::vector<std::string> reports() const override { return driver_.reports(); }

 private:
  void tick(std::int64_t now_us) {
    if (const Knowledge* other = next(driver_)) {
      driver_.take(*other);
      now_ = other;
    }
    trace += print_json(*now_->program, driver_.tick(now_us, 100'000)) + "\n";
  }

  const Knowledge* now_;
  Driver driver_;
};

Summary drive(const Mission& mission, Changing& helm) {
  DriveOptions options;
  options.helm = &helm;
  return Drive(*mission.laboratory->labyrinth, mission.knowledge(), mission.laboratory->plain(), options).run();
}

std::string way_of(const Summary& summary) { return fmt::format("{}: {}", describe(summary), fmt::join(summary.way, " ")); }

TEST(Taking, AMissionInPlaceOfItselfBeforeEveryTickChangesNoTick) {
  const Mission one("Well -> Mill -> Barn"), other("Well -> Mill -> Barn");
  Changing still(one), moved(one);
  bool second = false;
  moved.next = [&](const Driver&) { return &((second = !second) ? other : one).knowledge(); };
  EXPECT_EQ(way_of(drive(one, still)), "arrived at Barn: Well.E Mill.E");
  EXPECT_EQ(way_of(drive(one, moved)), "arrived at Barn: Well.E Mill.E");
  EXPECT_GT(still.trace.size(), 10'000u);
  EXPECT_EQ(still.trace, moved.trace);
}

/// The other mission from the leg to `landmark` on.
auto on_the_leg_to(std::string landmark, const Mission& other) {
  return [landmark, &other, taken = false](const Driver& driver) mutable -> const Knowledge* {
    if (taken || driver.leg() == nullptr || driver.leg()->to != landmark) return nullptr;
    taken = true;
    return &other.knowledge();
  };
}

TEST(Taking, AWayThatGrowsOnItsLastLegIsDrivenAsIfItHadBeenKnownFromTheStart) {
  const Mission shorter("Well -> Mill"), longer("Well -> Mill -> Barn");
  Changing known(longer), grown(shorter);
  grown.next = on_the_leg_to("Mill", longer);
  const Summary all = drive(longer, known), part = drive(shorter, grown);
  EXPECT_EQ(way_of(part), "arrived at Barn: Well.E Mill.E");
  EXPECT_EQ(part.ticks, all.ticks);
  EXPECT_DOUBLE_EQ(part.length_m, all.length_m);
}

TEST(Taking, AWayThatIsCutEndsWhereItEndsNow) {
  const Mission longer("Well -> Mill -> Barn"), shorter("Well -> Mill");
  Changing cut(longer);
  cut.next = on_the_leg_to("Mill", shorter);
  EXPECT_EQ(way_of(drive(longer, cut)), "arrived at Mill: Well.E");
}

TEST(Taking, OnlyWhatHasTheSameFactsAndStrategiesOnImagesIsTaken) {
  const Mission one("Well -> Mill"), other("Well -> Mill -> Barn");
  EXPECT_TRUE(can_take(one.knowledge(), other.knowledge()));
  Knowledge plain = other.knowledge();
  plain.image = nullptr;
  EXPECT_FALSE(can_take(one.knowledge(), plain));
  const auto route1 = Laboratory::of_file("examples/04_simulator/route1.kb");
  const tables::LoadedImage image(tables::write_image(route1->compiled->tables, route1->compiled->program));
  route1->knowledge->image = &image;
  EXPECT_FALSE(can_take(one.knowledge(), *route1->knowledge));
}

}  // namespace
}  // namespace kb::sim::testing
