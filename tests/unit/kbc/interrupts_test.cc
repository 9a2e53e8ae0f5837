#include "tools/kbc/interrupts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>

namespace kb::cli {
namespace {

TEST(Interrupts, TellWhichSignalCameFirst) {
  const Interrupts interrupts;
  EXPECT_FALSE(Interrupts::came());
  std::raise(SIGTERM);
  std::raise(SIGINT);   // at the same moment: the same request
  EXPECT_EQ(Interrupts::which(), SIGTERM);
}

TEST(Interrupts, BeginAnewWithEachObject) {
  {
    const Interrupts first;
    std::raise(SIGINT);
  }
  const Interrupts second;
  EXPECT_FALSE(Interrupts::came());
}

// Between a look at `came` and the wait anything may happen, also the signal.
TEST(Interrupts, BreakOffAWaitThatBeganAfterTheSignal) {
  const Interrupts interrupts;
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::raise(SIGINT);
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), -1);   // nobody writes
  EXPECT_EQ(errno, EINTR);
  EXPECT_TRUE(Interrupts::came());
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace kb::cli
