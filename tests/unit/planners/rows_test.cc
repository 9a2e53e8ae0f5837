#include "planners/report/rows.h"

#include <gtest/gtest.h>

#include <new>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

Result run_out_of_memory(const Problem&, const RunOptions&) { throw std::bad_alloc(); }

TEST(Rows, tell_whoever_asked_what_a_thread_has_thrown) {
  const auto& benchmark = testing::benchmarks()[0];
  const Method greedy{"greedy", Knowledge::kFullMap, Touch::kApart, false, false, run_out_of_memory, nullptr, "takes all"};
  EXPECT_THROW(static_cast<void>(answer_rows(greedy, benchmark.grid, benchmark.scenarios, {}, 3)), std::bad_alloc);
}

}  // namespace
}  // namespace kb::planners
