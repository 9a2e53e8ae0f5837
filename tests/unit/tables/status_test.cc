// The compiler and the runtime may not include each other, so each has the list of statuses; it must be the same list.
#include <gtest/gtest.h>

#include <waymark/runtime/status.h>
#include "compiler/program/tick.h"

namespace kb::tables {
namespace {

TEST(Statuses, HaveTheSameWordsInCompilerAndRuntime) {
  for (int value = 0; value <= static_cast<int>(mts::Status::kTwoStrategies); ++value) {
    EXPECT_STREQ(program::status_text(static_cast<program::Status>(value)), mts::text(static_cast<mts::Status>(value)));
  }
  EXPECT_STREQ(program::status_text(static_cast<program::Status>(static_cast<int>(mts::Status::kTwoStrategies) + 1)), "unknown");
}

}  // namespace
}  // namespace kb::tables
