// Distributes the shards of a batch: to threads of this process, or to ranks of an MPI job.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kb::cli {

/// Deals out shards to free threads. Any thread may call it; `thread` is the caller's number among those of its process.
class Dealer {
 public:
  virtual ~Dealer() = default;
  /// A shard that was not dealt out yet; nothing if none is left or the batch is to stop.
  [[nodiscard]] virtual std::optional<std::size_t> next(unsigned thread) = 0;
  /// Hands in the rows of a shard that was dealt out.
  virtual void take(std::size_t shard, const std::string& rows) = 0;
};

/// Deals from a list, in its order.
class ListDealer final : public Dealer {
 public:
  /// `keep` gets the rows of one shard at a time; if it returns false, nothing further is dealt out.
  ListDealer(std::vector<std::size_t> shards, std::function<bool(std::size_t shard, const std::string& rows)> keep)
      : shards_(std::move(shards)), keep_(std::move(keep)) {}
  [[nodiscard]] std::optional<std::size_t> next(unsigned) override {
    const std::lock_guard lock(mutex_);
    if (stopped_ || at_ == shards_.size()) return std::nullopt;
    return shards_[at_++];
  }
  void take(std::size_t shard, const std::string& rows) override {
    const std::lock_guard lock(mutex_);
    if (!stopped_ && !keep_(shard, rows)) stopped_ = true;
  }

 private:
  std::mutex mutex_;
  std::vector<std::size_t> shards_;
  std::function<bool(std::size_t, const std::string&)> keep_;
  std::size_t at_ = 0;
  bool stopped_ = false;
};

/// The processes of an MPI job as `kbc fleet` sees them. The implementation is in tools/kbc/mpi; kbc itself has none.
class Ranks {
 public:
  virtual ~Ranks() = default;
  [[nodiscard]] virtual unsigned rank() const = 0;
  /// Rank 0, once: announces the batch to the others. Empty: there is none, as something is wrong and has been reported.
  virtual void announce(const std::string& fingerprint) = 0;
  /// The others, once: returns what rank 0 announced.
  [[nodiscard]] virtual std::string hear() = 0;
  /// Rank 0: deals from `dealer` to the others until all of them have ended.
  virtual void serve(Dealer& dealer) = 0;
  /// The others: a dealer that asks rank 0.
  [[nodiscard]] virtual Dealer& dealer() = 0;
  /// The others: tells that no thread will ask any more.
  virtual void leave() = 0;
};

}  // namespace kb::cli
