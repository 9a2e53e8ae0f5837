// The ranks of an MPI job. See fleet_dealer.h.
//
// note [ranks ask, rank 0 deals]
// A free thread asks rank 0 for a shard and hands in the rows of the last one. Only rank 0 touches the folder of results. So nothing is
// planned ahead, and a slow machine does less. Waiting is done by polling with pauses, as MPI's own waiting would burn the core that
// rank 0 drives on. A rank that dies takes the job with it, which is MPI's default; the shards handed in are files by then.
#pragma once

#include <mpi.h>

#include <memory>
#include <mutex>
#include <string>

#include "tools/kbc/fleet_dealer.h"

namespace kb::cli {

class MpiRanks final : public Ranks {
 public:
  /// MPI must have been initialised, with MPI_THREAD_SERIALIZED at least.
  MpiRanks();
  ~MpiRanks() override;
  [[nodiscard]] unsigned rank() const override { return static_cast<unsigned>(rank_); }
  void announce(const std::string& fingerprint) override;
  [[nodiscard]] std::string hear() override;
  void serve(Dealer& dealer) override;
  [[nodiscard]] Dealer& dealer() override;
  void leave() override;
  /// Called at the end of the process: rank 0 tells ranks that still wait for a batch that there is none; the others hear it.
  void settle();

 private:
  class Asking;
  void answer(Dealer& dealer, const MPI_Status& about, std::size_t& left);
  int rank_ = 0, size_ = 1;
  bool announced_ = false;
  std::unique_ptr<Asking> asking_;
};

}  // namespace kb::cli
