// Which signs a lookout believes, and what it learns from them. Others: lookout_test.cc.
#include <waymark/controllers/lookout.h>

#include <gtest/gtest.h>

#include "stray.kb.map.h"

namespace mts {
namespace {

/// A robot on its way east from Dock to Arch, or anywhere, that knows the map.
struct Reader {
  Reader() {
    senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
    for (float& range_m : senses.range_m) range_m = kOutOfRange;
    pilot.choose(&kFollow);
    go(0.0f);
  }
  static constexpr ControlLine kFollow = {"follow_line", nullptr, 0}, kAround = {"turn_round", nullptr, 0};

  void go(float metres) {
    for (int i = 0; i < 50; ++i) {
      senses.speed_m_s = metres;
      senses.x_m += metres / 50.0f;
      static_cast<void>(pilot.step(senses, 0.02f));
      lookout.step(pilot, sign, 0.02f);
    }
    lookout.write(facts);
  }
  /// Reads a sign for a second, 10 cm long.
  void read(const char* landmark, const char* exit) {
    sign = {.landmark = landmark, .exit = exit};
    go(0.1f);
    sign = {};
  }

  Senses senses;
  Sign sign;
  stray::Facts facts;
  Pilot pilot;
  Lookout<stray::Knowledge> lookout{Body{}, stray::landmarks(), stray::find_road};
};

TEST(Signs, WhereItsRoadBeginsASignThatNamesAnotherLandmarkIsMisread) {
  for (const float along_m : {0.5f, 2.3f}) {
    Reader reader;
    reader.pilot.put(*stray::find_road("Dock", "E"), along_m);
    reader.read("Arch", "W");
    EXPECT_EQ(reader.facts.Arch > 0.5f, along_m > 1.0f) << along_m;
  }
}

TEST(Signs, ALandmarkIsAbsentAsLongAsTheReaderWorksAndUnknownWhereItIsSilent) {
  Reader reader;
  EXPECT_EQ(reader.facts.Arch, -0.9f);
  EXPECT_EQ(reader.facts.Shelf, -0.9f);
  reader.sign.reader = false;
  reader.go(0.1f);
  EXPECT_EQ(reader.facts.Arch, 0.0f);
  reader.sign.reader = true;
  reader.read("Shelf", "W");
  EXPECT_EQ(reader.facts.Arch, -0.9f);
  EXPECT_GT(reader.facts.Shelf, 0.8f);
}

TEST(Signs, FromTheSignThatItLeavesARobotLearnsItsRoadAndHowThatIsDriven) {
  Reader reader;
  reader.read("Arch", "E");
  ASSERT_NE(reader.pilot.place().road(), nullptr);
  EXPECT_STREQ(reader.pilot.place().road()->to, "Shelf");
  EXPECT_EQ(reader.facts.MoveBy.dist, 0.9f);
  EXPECT_EQ(reader.facts.MoveBy.mark, -0.9f);
}

TEST(Signs, BehindACrossingWhoseWayOutHasNoSignTheMapSaysHowTheRoadIsDriven) {
  static constexpr ControlLine kOver = {"turn_on_line", nullptr, 0};
  Reader reader;
  reader.pilot.put(*stray::find_road("Dock", "E"), 2.2f);
  reader.read("Arch", "W");
  reader.pilot.choose(&kOver, stray::find_road("Arch", "E"));
  reader.go(0.8f);
  reader.pilot.choose(&Reader::kFollow, stray::find_road("Arch", "E"));
  reader.go(0.02f);
  EXPECT_EQ(reader.lookout.watch().at(), RoadWatch::At::kLeaving);
  EXPECT_EQ(reader.facts.MoveBy.dist, 0.9f);
  EXPECT_EQ(reader.facts.MoveBy.mark, -0.9f) << "that was the road on which it came";
}

TEST(Signs, ARobotThatTurnsRoundOnItsRoadComesToTheLandmarkBehindIt) {
  Reader reader;
  reader.pilot.put(*stray::find_road("Arch", "E"), 1.5f);
  reader.go(0.1f);
  reader.pilot.choose(&Reader::kAround);
  reader.go(0.0f);
  for (int i = 0; i < 4; ++i) {
    reader.senses.turned_rad += 0.25f * kPi;
    reader.senses.heading_rad = wrapped_angle(reader.senses.heading_rad + 0.25f * kPi);
    reader.go(0.0f);
  }
  reader.pilot.choose(&Reader::kFollow);
  reader.go(0.0f);
  ASSERT_NE(reader.pilot.place().road(), nullptr);
  EXPECT_STREQ(reader.pilot.place().road()->to, "Arch");
}

}  // namespace
}  // namespace mts
