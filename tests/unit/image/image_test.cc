// Images are written in one form, verified, and run as the tables do.
#include <waymark/runtime/image.h>

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "compiler/program/conditions.h"
#include "compiler/program/interpret.h"
#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"
#include "tests/unit/image/running.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables {
namespace {

using mts::ImageStatus;
using program::Program;

TEST(Crc32c, IsThatOfTheStandard) {
  mts::Crc32c crc;
  crc.take(reinterpret_cast<const std::uint8_t*>("123456789"), 9);
  EXPECT_EQ(crc.value(), 0xE3069283u);  // RFC 3720, B.4, and every catalogue of CRCs
}

TEST(Crc32c, IsTheSameInPiecesOfAnyLength) {
  std::vector<std::uint8_t> bytes(64);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 37 + 11);
  std::uint32_t state = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) state = mts::Crc32c::step(state, byte);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    mts::Crc32c crc;
    crc.take(bytes.data(), cut);
    crc.take(bytes.data() + cut, bytes.size() - cut);
    EXPECT_EQ(crc.value(), ~state) << "cut at " << cut;
  }
}

TEST(Image, OfRandomKnowledgeBasesRunsAsTheirTablesDo) {
  for (std::uint64_t seed = 1; seed <= program::testing::count_from("KB_RANDOM_COUNT", 500); ++seed) {
    const Program program = program::testing::random_program(seed);
    const Limits limits = seed % 3 == 0 ? Limits{.large_group = 2, .broad = 0} : Limits{};
    const Tables tables = build(program, limits);
    const LoadedImage image(write_image(tables, program));
    ASSERT_EQ(image.status(), ImageStatus::kOk) << mts::text(image.status()) << ", seed " << seed;
    Tables recalled = recall_tables(image);
    const Program rules = recall_program(image, recalled);
    Machine expected(program, tables), got(rules, image);
    program::Interpreter interpreter(rules);
    for (const auto& step : program::testing::random_trace(program, seed, 30)) {
      const program::Tick tick = expected.tick(step.facts, step.dt_us);
      ASSERT_EQ(print_json(rules, got.tick(step.facts, step.dt_us)), print_json(program, tick)) << "seed " << seed;
      ASSERT_EQ(print_json(rules, interpreter.tick(step.facts, step.dt_us)), print_json(program, tick)) << "seed " << seed;
    }
  }
}

// As deep as the language allows. What says least stands innermost.
TEST(Image, KnowsTheStrengthOfTheDeepestCondition) {
  using namespace program::testing;
  ProgramBuilder b({"goal", "control"});
  b.fact("Least").fact("More").fact("None").satellite("Out");
  Expression deep = high("Least");
  for (int i = 0; i < 32; ++i) deep = any({all({deep, high("More")}), high("None")});
  b.when("deep", "goal", deep, {assign("Out", 0.4f)}).when("flat", "goal", high("Least"), {assign("Out", 1.0f)});
  const Program program = b.build();
  const Tables tables = build(program);
  const LoadedImage image(write_image(tables, program));
  ASSERT_EQ(image.status(), ImageStatus::kOk);
  Machine of_tables(program, tables), of_image(program, image);
  Trial trial(program);
  trial({});
  const std::vector<float> given = facts(program, {{"Least", 0.6f}, {"More", 0.9f}});
  of_tables.tick(facts(program, {}), 100'000);
  of_image.tick(facts(program, {}), 100'000);
  const std::string expected = print_json(program, trial.interpreter().tick(given, 100'000));
  EXPECT_NEAR(trial.value("Out"), 0.7f, 1e-6f);
  EXPECT_EQ(print_json(program, of_tables.tick(given, 100'000)), expected);
  EXPECT_EQ(print_json(program, of_image.tick(given, 100'000)), expected);
}

TEST(Image, WrittenOfAnImageIsTheSameBytes) {
  for (std::uint64_t seed = 1; seed <= program::testing::count_from("KB_RANDOM_COUNT", 500); ++seed) {
    const Program program = program::testing::random_program(seed);
    const std::string bytes = write_image(build(program, seed % 3 == 0 ? Limits{.large_group = 2, .broad = 0} : Limits{}), program);
    const LoadedImage image(bytes);
    ASSERT_EQ(image.status(), ImageStatus::kOk);
    Tables recalled = recall_tables(image);
    const Program rules = recall_program(image, recalled);
    ASSERT_TRUE(program::verify(rules).empty()) << program::verify(rules).front();
    ASSERT_TRUE(write_image(recalled, rules) == bytes) << "seed " << seed;
  }
}

TEST(Image, FindsNames) {
  const Program program = program::testing::random_program(5);
  const LoadedImage image(write_image(build(program), program));
  image.visit([&](const auto& view) {
    for (std::uint32_t f = 0; f < program.facts; ++f) {
      EXPECT_EQ(view.find(mts::ImageKind::kFact, std::string(program.cells[f].name).c_str()), f);
      EXPECT_EQ(view.name(mts::ImageKind::kFact, f), program.cells[f].name);
    }
    EXPECT_EQ(view.find(mts::ImageKind::kFact, "nobody"), program.facts);
    EXPECT_EQ(view.find(mts::ImageKind::kFact, ""), program.facts);
  });
}

TEST(Image, IsRefusedWhereverItIsCutOffAndWhateverIsAppended) {
  const Program program = program::testing::random_program(7);
  const std::string bytes = write_image(build(program), program);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_NE(LoadedImage(std::string_view(bytes).substr(0, size)).status(), ImageStatus::kOk) << size;
  }
  EXPECT_EQ(LoadedImage(bytes + std::string(4, '\0')).status(), ImageStatus::kWrongSize);
}

TEST(Image, SaysWhyItIsRefused) {
  const Program program = program::testing::random_program(7);
  const std::string bytes = write_image(build(program), program);
  const auto status_with = [&](std::size_t at, char byte) {
    std::string changed = bytes;
    changed[at] = byte;
    return LoadedImage(changed).status();
  };
  EXPECT_EQ(LoadedImage("").status(), ImageStatus::kTooShort);
  EXPECT_EQ(status_with(0, 'x'), ImageStatus::kNotAnImage);
  EXPECT_EQ(status_with(offsetof(mts::ImageHead, form), 9), ImageStatus::kOtherForm);
  EXPECT_EQ(status_with(offsetof(mts::ImageHead, abi), 99), ImageStatus::kOtherAbi);
  EXPECT_EQ(status_with(offsetof(mts::ImageHead, index_bytes), 4), ImageStatus::kOtherWidth);
  EXPECT_EQ(status_with(bytes.size() - 3, static_cast<char>(bytes[bytes.size() - 3] ^ 1)), ImageStatus::kWrongChecksum);
  std::vector<std::uint64_t> memory(bytes.size() / 8 + 2);
  std::memcpy(reinterpret_cast<char*>(memory.data()) + 1, bytes.data(), bytes.size());
  mts::ImageInfo info;
  EXPECT_EQ(mts::peek_image(reinterpret_cast<char*>(memory.data()) + 1, bytes.size(), info), ImageStatus::kMisaligned);
  std::memcpy(memory.data(), bytes.data(), bytes.size());
  mts::Image<std::uint32_t> wide;
  EXPECT_EQ(mts::open_image(memory.data(), bytes.size(), nullptr, 0, wide), ImageStatus::kOtherWidth);
  mts::Image<std::uint16_t> narrow;
  EXPECT_EQ(mts::open_image(memory.data(), bytes.size(), nullptr, 0, narrow), ImageStatus::kNoScratch);
}

/// A strength is found by walking through a condition, a part as often as it stands there: here a million million times.
TEST(Image, OfPartsThatAreSharedAgainAndAgainIsRefused) {
  const auto with_levels = [](int levels) {
    using namespace program::testing;
    ProgramBuilder b({"goal", "control"});
    b.fact("A").fact("B").fact("C").satellite("S").strategy("Go");
    b.when("up", "goal", any({high("A"), high("B")}), {raise("S")}).when("down", "goal", high("C"), {lower("S")});
    Program program = b.build();
    program::ConditionPool pool(program.conds);
    std::array<program::CondId, 2> last{pool.is(program::CellId{0}, program::Term::kHigh), pool.is(program::CellId{1}, program::Term::kHigh)};
    for (int i = 0; i < levels; ++i) last = {last[1], i % 2 == 0 ? pool.all_of(last) : pool.any_of(last)};
    program.rules.front().condition = last[1];
    return LoadedImage(write_image(build(program), program)).status();
  };
  EXPECT_EQ(with_levels(15), ImageStatus::kOk);
  EXPECT_EQ(with_levels(60), ImageStatus::kNodes);
}

/// Every bit of a small image is flipped and the checksum mended: either a check of the structure finds it, or what was said
/// has another meaning and runs without harm.
TEST(Image, WithAnyBitFlippedAndTheChecksumMendedIsRefusedOrRuns) {
  for (const std::uint64_t seed : {16u, 26u}) {
    const Program program = program::testing::random_program(seed);
    const std::string bytes = write_image(build(program), program);
    std::vector<std::uint64_t> memory((bytes.size() + 7) / 8);
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    auto* at = reinterpret_cast<std::uint8_t*>(memory.data());
    const auto day = program::testing::random_trace(program, seed, 3);
    std::size_t refused = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      at[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
      mts::ImageInfo info;
      std::vector<mts::Word> scratch;
      mts::Image<std::uint16_t> view;
      bool good = mts::peek_image(at, bytes.size(), info) == ImageStatus::kOk;
      if (good) {
        scratch.resize(info.scratch_words);
        good = mts::open_image(at, bytes.size(), scratch.data(), scratch.size(), view, mts::Checksum::kTrust) == ImageStatus::kOk;
      }
      if (good) {
        testing::Running<std::uint16_t> running(view);
        running.engine().reset();
        for (const auto& step : day) running.tick(step.facts, step.dt_us);
      } else {
        ++refused;
      }
      at[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    }
    EXPECT_GT(refused, 8 * bytes.size() / 3) << "seed " << seed;
    ::testing::Test::RecordProperty("refused_" + std::to_string(seed), std::to_string(refused) + " of " + std::to_string(8 * bytes.size()));
  }
}

}  // namespace
}  // namespace kb::tables
