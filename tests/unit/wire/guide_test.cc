// The darknesses of a line that was measured.
#include "tools/kbc/wire/guide.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <waymark/controllers/line_sight.h>

namespace kb::wire {
namespace {

mts::LineSight seen(const Guide& guide, const mts::Body& body) {
  mts::Senses senses;
  set_line(guide, body, senses);
  return mts::look_at_line(senses, body);
}

TEST(Guide, TheLineIsSeenWhereItWasMeasured) {
  for (const float span_m : {0.04f, 0.08f, 0.1f, 0.2f}) {
    mts::Body body;
    body.line_span_m = span_m;
    for (int i = -500; i <= 500; ++i) {
      const float left_m = 0.001f * static_cast<float>(i) * span_m;
      mts::Senses senses;
      set_line({left_m, false}, body, senses);
      const mts::LineSight sight = mts::look_at_line(senses, body);
      ASSERT_TRUE(sight.narrow()) << span_m << ' ' << left_m;
      ASSERT_NEAR(sight.left_m, left_m, 1e-6) << span_m;
      ASSERT_GT(*std::max_element(std::begin(senses.line), std::end(senses.line)), 0.5f) << "perception takes it for paint: " << left_m;
      ASSERT_FALSE(sight.left_arm || sight.right_arm || sight.across);
    }
  }
}

TEST(Guide, BeyondTheRowTheLineIsAtItsEnd) {
  const mts::Body body;
  EXPECT_NEAR(seen({0.3f, false}, body).left_m, 0.04f, 1e-6);
  EXPECT_NEAR(seen({-0.041f, false}, body).left_m, -0.04f, 1e-6);
}

TEST(Guide, ThereIsPaintAcrossOrNone) {
  EXPECT_TRUE(seen({std::nullopt, true}, {}).across);
  EXPECT_TRUE(seen({0.02f, true}, {}).across);
  EXPECT_FALSE(seen({}, {}).seen);
}

}  // namespace
}  // namespace kb::wire
