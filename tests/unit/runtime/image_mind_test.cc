// A mind on an image says what the compiled mind says: watch.kb beside this file, as both.
#include <waymark/runtime/image_mind.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "watch.kb.h"

namespace watch {
namespace {

using mts::ImageKind;
using mts::ImageStatus;

/// The image, aligned.
const std::vector<std::uint64_t>& image_words() {
  static const std::vector<std::uint64_t> words = [] {
    std::ifstream file(WATCH_IMAGE, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    std::vector<std::uint64_t> all((bytes.size() + 7) / 8);
    std::memcpy(all.data(), bytes.data(), bytes.size());
    return all;
  }();
  return words;
}

/// A list of either mind, sorted: some come in no order.
template <class List>
std::vector<std::uint32_t> numbers(const List& list) {
  std::vector<std::uint32_t> all;
  for (const auto item : list) all.push_back(static_cast<std::uint32_t>(item));
  std::sort(all.begin(), all.end());
  return all;
}
template <class List>
std::vector<std::pair<std::uint32_t, float>> changes(const List& list) {
  std::vector<std::pair<std::uint32_t, float>> all;
  for (const auto change : list) all.emplace_back(change.cell, change.value);
  std::sort(all.begin(), all.end());
  return all;
}
template <class List>
std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(const List& list) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (const auto conflict : list) all.emplace_back(conflict.cell, conflict.level);
  std::sort(all.begin(), all.end());
  return all;
}

template <class ImageMind>
void expect_same(const Mind& mind, const ImageMind& image) {
  const Decision decision = mind.decision();
  ASSERT_EQ(image.drives(), decision.drives());
  if (decision.drives()) { ASSERT_STREQ(image.strategy_name(), name(decision.strategy())); }
  ASSERT_EQ(image.status(), decision.status());
  ASSERT_EQ(image.holding(), decision.holding());
  ASSERT_EQ(image.hold_expired(), decision.hold_expired());
  ASSERT_EQ(image.ticks(), decision.tick());
  ASSERT_EQ(image.time_us(), decision.time_us());
  ASSERT_EQ(image.bad_facts(), decision.bad_facts());
  ASSERT_EQ(numbers(image.fired()), numbers(decision.fired()));
  ASSERT_EQ(numbers(image.events()), numbers(decision.events()));
  ASSERT_EQ(numbers(image.lost()), numbers(decision.lost()));
  ASSERT_EQ(numbers(image.active()), numbers(decision.active()));
  ASSERT_EQ(changes(image.changed()), changes(decision.changed()));
  ASSERT_EQ(conflicts(image.conflicts()), conflicts(decision.conflicts()));
  for (std::uint32_t f = 0; f < Knowledge::kShape.facts; ++f) ASSERT_EQ(image.attended(f), mind.attended(static_cast<Fact>(f)));
  for (std::uint32_t s = 0; s < Knowledge::kShape.satellites; ++s) {
    ASSERT_EQ(image.high(s), mind.high(static_cast<Satellite>(s)));
    ASSERT_EQ(image.value(ImageKind::kSatellite, s), mind.value(static_cast<Satellite>(s)));
  }
  for (std::uint32_t s = 0; s < Knowledge::kShape.strategies; ++s) ASSERT_EQ(image.ran(s), mind.ran(static_cast<Strategy>(s)));
}

template <class ImageMind>
class ImageMindOfEitherKind : public testing::Test {};
using Kinds = testing::Types<mts::ImageMind, mts::SmallImageMind>;
TYPED_TEST_SUITE(ImageMindOfEitherKind, Kinds);

TYPED_TEST(ImageMindOfEitherKind, SaysWhatTheCompiledMindSays) {
  alignas(8) std::byte block[4096];
  TypeParam image;
  mts::SwapReport report;
  const std::size_t length = mts::image_length(image_words().data(), image_words().size() * 8);
  ASSERT_EQ(image.take(image_words().data(), length, block, sizeof block, report, [](const mts::SwapLoss&) {}), ImageStatus::kOk);
  Mind mind;
  std::mt19937 random(1);
  unsigned held = 0, expired = 0, hidden = 0, contradicted = 0, attended = 0;
  for (int tick = 0; tick < 20'000; ++tick) {
    if (tick == 10'000) {
      mind.reset();
      image.reset();
      expect_same(mind, image);
    }
    if (random() % 3 == 0) {
      const auto fact = static_cast<std::uint32_t>(random() % Knowledge::kShape.facts);
      constexpr float kValues[] = {-1.0f, 0.0f, 0.4f, 0.7f, 1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
      const float value = kValues[random() % std::size(kValues)];
      mind.give(static_cast<Fact>(fact), value);
      image.set_fact(fact, value);
    }
    const auto passed = mts::milliseconds(random() % 400);
    const Decision decision = mind.tick(passed);
    image.tick(passed);
    expect_same(mind, image);
    if (this->HasFatalFailure()) { FAIL() << "at tick " << tick; }
    held += decision.holding();
    expired += decision.hold_expired();
    hidden += decision.hold_expired() && decision.status() == mts::Status::kBadFact;
    contradicted += !decision.conflicts().empty();
    attended += mind.attended(Fact::Alarm);
  }
  for (const unsigned often : {held, expired, hidden, contradicted, attended}) EXPECT_GT(often, 20u) << "the drive shows too little";
}

TYPED_TEST(ImageMindOfEitherKind, RefusesANullImageAndANullBlock) {
  alignas(8) std::byte block[4096];
  TypeParam image;
  mts::SwapReport report;
  const auto lost = [](const mts::SwapLoss&) {};
  const std::size_t length = mts::image_length(image_words().data(), image_words().size() * 8);
  EXPECT_EQ(image.take(nullptr, length, block, sizeof block, report, lost), ImageStatus::kTooShort);
  EXPECT_EQ(image.take(image_words().data(), length, nullptr, sizeof block, report, lost), ImageStatus::kNoMemory);
  EXPECT_FALSE(image.has_image());
  EXPECT_EQ(mts::image_length(nullptr, length), 0u);
  mts::Image<std::uint16_t> open;
  EXPECT_EQ(mts::open_image(image_words().data(), length, nullptr, sizeof block, open), ImageStatus::kNoScratch);
}

constinit mts::ImageMind zeros;
constinit mts::SmallImageMind small_zeros;

TEST(ImageMind, IsAllZeroAtFirstSoThatAStaticOneTakesNoFlash) {
  const auto is_zero = [](const auto& mind) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&mind);
    return std::all_of(bytes, bytes + sizeof mind, [](unsigned char byte) { return byte == 0; });
  };
  EXPECT_TRUE(is_zero(zeros));
  EXPECT_TRUE(is_zero(small_zeros));
}

TEST(ImageMind, SaysNothingBeforeItsFirstImage) {
  const mts::ImageMind mind;
  EXPECT_EQ(mind.status(), mts::Status::kNoStrategy);
  EXPECT_TRUE(mind.fired().empty() && mind.events().empty() && mind.lost().empty() && mind.active().empty());
  EXPECT_TRUE(mind.changed().empty() && mind.conflicts().empty());
  EXPECT_FALSE(mind.high(0) || mind.ran(0) || mind.attended(0) || mind.holding() || mind.hold_expired());
}

}  // namespace
}  // namespace watch
