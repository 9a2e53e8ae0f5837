#include "tests/world/mind.h"

#include <gtest/gtest.h>

namespace kb::world {
namespace {

std::shared_ptr<const Knowledge> lamp() {
  return Knowledge::of_text(
      "levels only > control\nfact Button\nsatellite On\nstrategy Shine\npriority Shine\n"
      "rule press at only when event Button then +On\nrule shine at only while On then +sat Shine\n");
}

program::Tick tick(Mind& mind, float button) { return mind.tick(std::vector<float>{button}, 100'000); }

TEST(LockStep, AnswersWhatBothSay) {
  const auto knowledge = lamp();
  const auto mind = make_mind(MindKind::kBoth, *knowledge);
  tick(*mind, 0.0f);
  tick(*mind, 0.9f);
  EXPECT_EQ(mind->value(knowledge->cell("On")), 1.0f);
  EXPECT_EQ(tick(*mind, 0.0f).strategy, knowledge->cell("Shine"));
}

TEST(LockStep, StopsAtTheFirstTickThatDiffersAndPrintsItTwice) {
  const auto knowledge = lamp();
  auto engine = make_mind(MindKind::kMachine, *knowledge);
  engine->poke(knowledge->cell("On"), 1.0f);
  const auto mind = make_lock_step(*knowledge, make_mind(MindKind::kInterpreter, *knowledge), std::move(engine));
  try {
    tick(*mind, 0.0f);
    FAIL() << "the difference was not noticed";
  } catch (const MindsDiffer& differ) {
    const std::string said = differ.what();
    EXPECT_NE(said.find(R"(interpreter {"tick":1)"), std::string::npos) << said;
    EXPECT_NE(said.find(R"("fired":["shine","run[Shine]"])"), std::string::npos) << said;
  }
}

TEST(Knowledge, ThatDoesNotCompileSaysWhy) {
  try {
    (void)Knowledge::of_text("fact Line\nrule r at nowhere when Line then +Lin\n");
    FAIL() << "it compiled";
  } catch (const DoesNotCompile& messages) {
    EXPECT_NE(std::string(messages.what()).find("mission.kb:2:"), std::string::npos) << messages.what();
  }
}

}  // namespace
}  // namespace kb::world
