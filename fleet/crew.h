// Threads that tick parts of a fleet at the same time.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace mts {

/// A few threads that wait for work. Use a crew from one thread at a time.
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
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    begin_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

  /// Calls `work(0)` to `work(threads() - 1)` at the same time and waits for all. If one of them throws, the program ends, since the others
  /// are still at work.
  void run(const std::function<void(unsigned)>& work) noexcept {
    {
      const std::lock_guard lock(mutex_);
      work_ = &work;
      busy_ = helpers_.size();
      ++round_;
    }
    begin_.notify_all();
    work(0);
    std::unique_lock lock(mutex_);
    end_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void help(unsigned number) {
    std::uint64_t done = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
      begin_.wait(lock, [&] { return over_ || round_ != done; });
      if (over_) return;
      done = round_;
      lock.unlock();
      (*work_)(number);
      lock.lock();
      if (--busy_ == 0) end_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable begin_, end_;
  std::vector<std::thread> helpers_;
  const std::function<void(unsigned)>* work_ = nullptr;
  std::size_t busy_ = 0;
  std::uint64_t round_ = 0;
  bool over_ = false;
};

}  // namespace mts
