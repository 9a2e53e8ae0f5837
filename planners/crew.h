// Runs one job on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace kb::planners {

/// How many threads this machine runs at once; 1 if that is not known.
[[nodiscard]] inline unsigned cores() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Starts threads that call `work(1)` to `work(jobs - 1)`, or as many of them as the system can start. The caller joins them.
[[nodiscard]] std::vector<std::thread> start_threads(std::size_t jobs, const std::function<void(unsigned thread)>& work);

/// Calls `work(0)` on the calling thread and `work(1)` to `work(jobs - 1)` on threads of their own, and returns when all have returned.
/// If one throws, `stop` becomes true, which the others should heed, and the first exception is rethrown. `jobs` 0 counts as 1.
void on_threads(unsigned jobs, std::atomic<bool>& stop, const std::function<void(unsigned thread)>& work);

}  // namespace kb::planners
