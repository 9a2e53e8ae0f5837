#include "planners/crew.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace kb::planners {

void on_threads(unsigned jobs, std::atomic<bool>& stop, const std::function<void(unsigned thread)>& work) {
  std::mutex mutex;
  std::exception_ptr failure;
  const auto guarded = [&](unsigned thread) {
    try {
      work(thread);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  std::vector<std::thread> threads;
  try {
    for (unsigned thread = 1; thread < std::max(jobs, 1u); ++thread) threads.emplace_back(guarded, thread);
  } catch (const std::system_error&) {
    // The system has no more threads: those that have started do the work.
  }
  guarded(0);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace kb::planners
