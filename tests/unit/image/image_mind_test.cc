// A mind in an image: it takes images, keeps its own if one is refused, and says what is in it.
#include <waymark/runtime/image_mind.h>

#include <gtest/gtest.h>

#include <cstring>

#include "compiler/tables/tables.h"
#include "tests/unit/image/running.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables {
namespace {

TEST(ImageMind, ARefusedImageLeavesEverythingAsItWas) {
  const program::Program program = program::testing::random_program(3);
  std::string bytes = write_image(build(program), program);
  std::vector<std::uint64_t> aligned((bytes.size() + 7) / 8), damaged;
  std::memcpy(aligned.data(), bytes.data(), bytes.size());
  mts::ImageInfo info;
  ASSERT_EQ(mts::peek_image(aligned.data(), bytes.size(), info), mts::ImageStatus::kOk);
  std::vector<std::uint64_t> block(info.state_bytes / 8 + 1), other(info.state_bytes / 8 + 1);
  const auto at = [](std::vector<std::uint64_t>& memory) { return reinterpret_cast<std::byte*>(memory.data()); };
  const auto ignore = [](const mts::SwapLoss&) {};
  mts::ImageMind calm;
  mts::SmallImageMind disturbed;
  mts::SwapReport report;
  std::vector<std::uint64_t> calm_block(block.size());
  ASSERT_EQ(calm.take(aligned.data(), bytes.size(), at(calm_block), calm_block.size() * 8, report, ignore), mts::ImageStatus::kOk);
  ASSERT_EQ(disturbed.take(aligned.data(), bytes.size(), at(block), block.size() * 8, report, ignore), mts::ImageStatus::kOk);
  std::size_t tick = 0;
  for (const auto& step : program::testing::random_trace(program, 3, 30)) {
    damaged = aligned;
    damaged[(tick * 37) % damaged.size()] ^= 1u << (tick % 29);
    EXPECT_NE(disturbed.take(damaged.data(), bytes.size(), at(other), other.size() * 8, report, ignore), mts::ImageStatus::kOk);
    EXPECT_EQ(disturbed.take(aligned.data(), bytes.size(), at(other), 8, report, ignore), mts::ImageStatus::kNoMemory);
    EXPECT_EQ(disturbed.take(aligned.data(), bytes.size(), at(block), block.size() * 8, report, ignore), mts::ImageStatus::kNoMemory);
    EXPECT_EQ(disturbed.take(aligned.data(), bytes.size(), at(other) + 4, other.size() * 8 - 4, report, ignore), mts::ImageStatus::kNoMemory);
    const auto drive = [&](auto& mind) {
      for (std::uint32_t f = 0; f < program.facts; ++f) mind.set_fact(f, step.facts[f]);
      mind.tick(mts::microseconds(step.dt_us));
    };
    drive(calm);
    drive(disturbed);
    for (std::uint32_t s = 0; s < program.satellites; ++s) {
      ASSERT_EQ(disturbed.value(mts::ImageKind::kSatellite, s), calm.value(mts::ImageKind::kSatellite, s));
    }
    ASSERT_EQ(disturbed.status(), calm.status());
    ASSERT_EQ(disturbed.drives(), calm.drives());
    if (calm.drives()) { ASSERT_STREQ(disturbed.strategy_name(), calm.strategy_name()); }
    ++tick;
  }
}

TEST(ImageMind, TakesNoBlockThatOverlapsItsOwn) {
  const program::Program program = program::testing::random_program(3);
  const std::string bytes = write_image(build(program), program);
  mts::ImageInfo info;
  ASSERT_EQ(mts::peek_image(bytes.data(), bytes.size(), info), mts::ImageStatus::kOk);
  const auto length = static_cast<std::size_t>(info.state_bytes);
  std::vector<std::uint64_t> memory(length / 8 * 3 + 1);
  auto* const first = reinterpret_cast<std::byte*>(memory.data());
  mts::ImageMind mind;
  mts::SwapReport report;
  const auto nobody = [](const mts::SwapLoss&) {};
  const auto take = [&](std::size_t at) { return mind.take(bytes.data(), bytes.size(), first + at, length, report, nobody); };
  ASSERT_EQ(take(length), mts::ImageStatus::kOk);
  EXPECT_EQ(take(length + 8), mts::ImageStatus::kNoMemory);
  EXPECT_EQ(take(8), mts::ImageStatus::kNoMemory);
  EXPECT_EQ(take(0), mts::ImageStatus::kOk);
  EXPECT_EQ(take(length), mts::ImageStatus::kOk) << "side by side";
}

TEST(ImageMind, TakesNoBlockThatOverlapsAnImage) {
  const program::Program program = program::testing::random_program(3);
  const std::string bytes = write_image(build(program), program);
  mts::ImageInfo info;
  ASSERT_EQ(mts::peek_image(bytes.data(), bytes.size(), info), mts::ImageStatus::kOk);
  const std::size_t size = bytes.size(), length = static_cast<std::size_t>(info.state_bytes), apart = (size + 7) / 8 * 8;
  std::vector<std::uint64_t> memory((2 * apart + 2 * length) / 8);   // an image, a block, another image, another block
  auto* const image = reinterpret_cast<std::byte*>(memory.data());
  std::byte* const other = image + apart + length;
  std::memcpy(image, bytes.data(), size);
  std::memcpy(other, bytes.data(), size);
  mts::ImageMind mind;
  mts::SwapReport report;
  const auto take = [&](const std::byte* from, std::byte* block) { return mind.take(from, size, block, length, report, [](const mts::SwapLoss&) {}); };
  EXPECT_EQ(take(image, image), mts::ImageStatus::kNoMemory);
  EXPECT_EQ(take(image, image + apart - 8), mts::ImageStatus::kNoMemory);
  ASSERT_EQ(take(image, image + apart), mts::ImageStatus::kOk);
  EXPECT_EQ(take(other, image), mts::ImageStatus::kNoMemory) << "the image in use";
  EXPECT_EQ(take(other, other + apart - 8), mts::ImageStatus::kNoMemory);
  EXPECT_EQ(std::memcmp(image, bytes.data(), size) | std::memcmp(other, bytes.data(), size), 0) << "neither was touched";
  EXPECT_EQ(take(other, other + apart), mts::ImageStatus::kOk);
  EXPECT_EQ(take(other, image), mts::ImageStatus::kOk) << "nobody uses the first one any more";
}

TEST(ImageMind, SaysNothingOfWhatThereIsNot) {
  const program::Program program = program::testing::random_program(3);
  const std::string bytes = write_image(build(program), program);
  alignas(8) static std::byte memory[1 << 16];
  mts::ImageMind mind;
  mts::SwapReport report;
  ASSERT_EQ(mind.take(bytes.data(), bytes.size(), memory, sizeof memory, report, [](const mts::SwapLoss&) {}), mts::ImageStatus::kOk);
  for (const auto kind : {mts::ImageKind::kFact, mts::ImageKind::kSatellite, mts::ImageKind::kStrategy, mts::ImageKind::kRule}) {
    const std::uint32_t none = mind.find(kind, "nothing of this name");
    EXPECT_EQ(none, mind.count(kind));
    EXPECT_EQ(mind.value(kind, none), 0.0f);
    EXPECT_STREQ(mind.name(kind, none), "?");
  }
  EXPECT_EQ(mind.value(mts::ImageKind::kRule, 0), 0.0f) << "rules have none";
  static_assert(!std::is_copy_constructible_v<mts::ImageMind> && !std::is_copy_assignable_v<mts::ImageMind>);
}

TEST(SmallImageMind, RefusesWideImagesAndGoesOn) {
  const program::Program little = testing::many_facts(40), much = testing::many_facts(33'000);
  const std::string small = write_image(build(little), little), large = write_image(build(much), much);
  std::vector<std::uint64_t> block(1 << 20), other(1 << 20);
  mts::SmallImageMind mind;
  mts::SwapReport report;
  const auto take = [&](const std::string& bytes, std::vector<std::uint64_t>& memory) {
    return mind.take(bytes.data(), bytes.size(), reinterpret_cast<std::byte*>(memory.data()), memory.size() * 8, report,
                     [](const mts::SwapLoss&) {});
  };
  EXPECT_EQ(take(large, block), mts::ImageStatus::kOtherWidth);
  EXPECT_FALSE(mind.has_image());
  ASSERT_EQ(take(small, block), mts::ImageStatus::kOk);
  mind.tick(mts::milliseconds(20));
  EXPECT_EQ(take(large, other), mts::ImageStatus::kOtherWidth);
  EXPECT_EQ(mind.block(), reinterpret_cast<std::byte*>(block.data()));
  mind.tick(mts::milliseconds(20));
  EXPECT_EQ(mind.ticks(), 2u);
}

}  // namespace
}  // namespace kb::tables
