// Threads that tick parts of a fleet at the same time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "../runtime/cpp20.h"

#if defined(__GLIBCXX__) && !defined(_GLIBCXX_HAS_GTHREADS)
#error "fleets need std::thread: of MinGW's two compilers take the one with posix threads"
#endif

namespace mts {

/// A few threads that wait for work. Use a crew from one thread at a time. A thread that has nothing to do looks for work for 0.2 ms, giving
/// way to others, and then sleeps: waking it takes some 50 us, longer than a tick of 65,536 robots. If its last work came within 1 ms, it
/// looks for as long as that. After `fork` the child has no threads, and would wait for ever: make crews after it.
class Crew {
 public:
  /// `threads`: how many work at the same time, including the caller's; 0 is taken as 1. If the system cannot start a thread, the program
  /// ends.
  explicit Crew(unsigned threads) noexcept {
    for (unsigned i = 1; i < threads; ++i) helpers_.emplace_back([this, i] { help(i); });
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    work_ = nullptr;
    begin();
    for (std::thread& helper : helpers_) helper.join();
  }

  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

  /// Calls `work(0)` to `work(threads() - 1)` at the same time and waits for all. If one of them throws, the program ends, since the others
  /// are still at work.
  void run(const std::function<void(unsigned)>& work) noexcept {
    work_ = &work;
    busy_.store(static_cast<std::uint32_t>(helpers_.size()), std::memory_order_relaxed);
    begin();
    work(0);
    while (const std::uint32_t busy = busy_.load(std::memory_order_acquire)) await_change(busy_, busy, done_, kPatience);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::microseconds kPatience{200}, kMostPatience{1'000};

  /// Starts all helpers; they see everything that was written before.
  void begin() {
    round_.fetch_add(1, std::memory_order_release);
    wake(began_);
  }

  void help(unsigned number) noexcept {
    Clock::duration patience = kPatience;
    for (std::uint32_t round = 0;; ++round) {
      const Clock::time_point idle = Clock::now();
      await_change(round_, round, began_, patience);
      patience = Clock::now() - idle < kMostPatience ? kMostPatience : kPatience;
      if (work_ == nullptr) return;
      (*work_)(number);
      if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) wake(done_);
    }
  }

  /// A number has changed: who found it unchanged with the mutex locked sleeps by now.
  void wake(std::condition_variable& sleepers) {
    { const std::lock_guard<std::mutex> lock(mutex_); }
    sleepers.notify_all();
  }

  // Not std::atomic::wait: without futexes, as on Windows, libstdc++ 12 loses wakes.
  void await_change(const std::atomic<std::uint32_t>& number, std::uint32_t from, std::condition_variable& changes, Clock::duration patience) {
    const auto changed = [&] { return number.load(std::memory_order_acquire) != from; };
    const Clock::time_point until = Clock::now() + patience;
    while (!changed()) {
      if (Clock::now() < until) {
        std::this_thread::yield();
      } else {
        std::unique_lock<std::mutex> lock(mutex_);
        changes.wait(lock, changed);
      }
    }
  }

  std::atomic<std::uint32_t> round_ = 0, busy_ = 0;
  const std::function<void(unsigned)>* work_ = nullptr;   ///< nullptr: the crew is over
  std::mutex mutex_;                                      ///< held by nobody who works
  std::condition_variable began_, done_;
  std::vector<std::thread> helpers_;                      ///< last: they use all of the above
};

}  // namespace mts
