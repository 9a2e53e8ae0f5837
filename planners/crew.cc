#include "planners/crew.h"

#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace kb::planners {

std::vector<std::thread> start_threads(std::size_t jobs, const std::function<void(unsigned thread)>& work) {
  std::vector<std::thread> threads;
  try {
    for (unsigned thread = 1; thread < jobs; ++thread) threads.emplace_back(work, thread);
  } catch (const std::system_error&) {
    // The system has no more threads: those that have started do the work.
  }
  return threads;
}

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
  std::vector<std::thread> threads = start_threads(jobs, guarded);
  guarded(0);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace kb::planners
