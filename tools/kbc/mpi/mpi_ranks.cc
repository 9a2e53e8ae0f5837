#include "tools/kbc/mpi/mpi_ranks.h"

#include <chrono>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace kb::cli {
namespace {

// Tags of messages. An answer to thread t has the tag kAnswer + t.
enum Tag : int { kAsk = 1, kRows = 2, kLeave = 3, kAnswer = 16 };

constexpr std::int64_t kNothing = -1;
constexpr auto kPause = std::chrono::milliseconds(1);

}  // namespace

/// Asks rank 0. The mutex allows one call of MPI at a time, as MPI_THREAD_SERIALIZED demands.
class MpiRanks::Asking final : public Dealer {
 public:
  [[nodiscard]] std::optional<std::size_t> next(unsigned thread) override {
    const auto number = static_cast<std::int64_t>(thread);
    {
      const std::lock_guard lock(mutex_);
      MPI_Send(&number, sizeof number, MPI_BYTE, 0, kAsk, MPI_COMM_WORLD);
    }
    const int tag = kAnswer + static_cast<int>(thread);
    for (;; std::this_thread::sleep_for(kPause)) {
      const std::lock_guard lock(mutex_);
      int there = 0;
      MPI_Iprobe(0, tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
      if (there == 0) continue;
      std::int64_t shard = kNothing;
      MPI_Recv(&shard, 1, MPI_INT64_T, 0, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      return shard == kNothing ? std::nullopt : std::optional(static_cast<std::size_t>(shard));
    }
  }
  /// The message is the number of the shard, in eight bytes, and its rows.
  void take(std::size_t shard, const std::string& rows) override {
    const auto number = static_cast<std::int64_t>(shard);
    std::vector<char> message(sizeof number + rows.size());
    if (message.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw std::runtime_error("a shard is too large for one message");
    std::memcpy(message.data(), &number, sizeof number);
    std::memcpy(message.data() + sizeof number, rows.data(), rows.size());
    const std::lock_guard lock(mutex_);
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_BYTE, 0, kRows, MPI_COMM_WORLD);
  }

 private:
  std::mutex mutex_;
};

MpiRanks::MpiRanks() : asking_(std::make_unique<Asking>()) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiRanks::~MpiRanks() = default;

void MpiRanks::announce(const std::string& fingerprint) {
  announced_ = true;
  std::uint64_t size = fingerprint.size();
  std::string bytes = fingerprint;
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
}

std::string MpiRanks::hear() {
  announced_ = true;
  std::uint64_t size = 0;
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
  return bytes;
}

void MpiRanks::settle() {
  if (announced_) return;
  if (rank_ == 0) announce("");
  else static_cast<void>(hear());
}

void MpiRanks::serve(Dealer& dealer) {
  for (auto left = static_cast<std::size_t>(size_ - 1); left > 0;) {
    int there = 0;
    MPI_Status about{};
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &about);
    if (there == 0) std::this_thread::sleep_for(kPause);
    else answer(dealer, about, left);
  }
}

void MpiRanks::answer(Dealer& dealer, const MPI_Status& about, std::size_t& left) {
  int bytes = 0;
  MPI_Get_count(&about, MPI_BYTE, &bytes);
  std::vector<char> message(static_cast<std::size_t>(bytes));
  MPI_Recv(message.data(), bytes, MPI_BYTE, about.MPI_SOURCE, about.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::int64_t number = 0;
  if (message.size() >= sizeof number) std::memcpy(&number, message.data(), sizeof number);
  switch (about.MPI_TAG) {
    case kAsk: {
      const auto shard = dealer.next(0);
      const std::int64_t answer = shard ? static_cast<std::int64_t>(*shard) : kNothing;
      MPI_Send(&answer, 1, MPI_INT64_T, about.MPI_SOURCE, kAnswer + static_cast<int>(number), MPI_COMM_WORLD);
      break;
    }
    case kRows: dealer.take(static_cast<std::size_t>(number), std::string(message.begin() + sizeof number, message.end())); break;
    default: --left;   // kLeave
  }
}

Dealer& MpiRanks::dealer() { return *asking_; }

void MpiRanks::leave() {
  const std::int64_t nothing = 0;
  MPI_Send(&nothing, sizeof nothing, MPI_BYTE, 0, kLeave, MPI_COMM_WORLD);
}

}  // namespace kb::cli
