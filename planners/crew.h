// Several threads at one job.
#pragma once

#include <atomic>
#include <functional>

namespace kb::planners {

/// Calls `work(0)` here and `work(1)` to `work(jobs - 1)` on threads of their own, and returns when all have. If one throws,
/// `stop` becomes true, which the others should heed, and the first that was thrown is thrown on. `jobs` 0 is 1.
void on_threads(unsigned jobs, std::atomic<bool>& stop, const std::function<void(unsigned thread)>& work);

}  // namespace kb::planners
