// A batch on disk: a file a shard, and in the end one file of all.
//
// note [a shard is a file]
// A shard's file appears whole or not at all, under a name that is its number. Whoever is killed loses the shards that he had
// in hand and nothing else. Two who do the same shard write the same bytes, so locks are there only to save the work, and to keep one
// process from removing what another puts together: a shard in hand is a byte of `shards/.claims` that is locked, which the kernel undoes
// however a process ends. The first line says which batch it is of; runs.csv, which takes the place of all shards, begins with the
// same words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/batch.h"
#include "tools/kbc/support.h"

namespace kb::cli {

/// Numbers of which this process holds a lock as long as this lives.
class Claims {
 public:
  Claims() = default;
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;
  ~Claims();
  /// False if another process holds the number in the file at `path`, which is made and has to be the same each time. True also where
  /// files cannot be locked.
  [[nodiscard]] bool take(const std::string& path, std::size_t number);

 private:
  int file_ = -1;
};

class BatchFiles {
 public:
  /// `batch` must outlive it. `fingerprint`: what must be the same for runs to belong together.
  BatchFiles(std::string folder, const sim::batch::Batch& batch, std::string fingerprint);

  /// Looks at what is there; of the shards at those that `wanted` names. False (reported, with the place) if something is of another
  /// batch, is damaged, or cannot be read.
  [[nodiscard]] bool open(Session& session, const std::vector<std::size_t>& wanted);
  /// Those of the wanted shards that are not there, in order.
  [[nodiscard]] const std::vector<std::size_t>& missing() const { return missing_; }
  /// Makes the folder of shards, and leaves of the missing ones those that no other process has in hand. False (reported) if it
  /// cannot be made.
  [[nodiscard]] bool claim(Session& session);
  /// Whether those that were left are all; false (reported) if another process has some in hand.
  [[nodiscard]] bool claimed_all(Session& session) const { return elsewhere_.empty() || refuse(elsewhere_, session); }
  /// Writes a shard's rows, each with its end of line. Empty, or why it cannot be done.
  [[nodiscard]] std::string write(std::size_t shard, const std::string& rows) const;
  struct Merged { std::string summary; std::vector<sim::batch::Run> runs; };
  /// Puts all shards together: runs.csv, and summary.md, whose text it also returns, with all runs. All shards must be there. Nothing if
  /// that fails (reported); the shards are removed if not.
  [[nodiscard]] std::optional<Merged> merge(Session& session);

  [[nodiscard]] std::string path(std::string_view name) const;
  [[nodiscard]] std::string shard_path(std::size_t shard) const;

 private:
  struct Text;
  [[nodiscard]] static bool refuse(const std::string& path, Session& session);
  [[nodiscard]] std::string shard_head(std::size_t shard) const;
  [[nodiscard]] bool read(Text& file, const std::string& head, sim::batch::Batch::Block block, std::vector<sim::batch::Run>* runs, Session& session) const;
  std::string folder_;
  const sim::batch::Batch& batch_;
  std::string head_;               // the first line of runs.csv
  bool complete_ = false;          // runs.csv holds the whole batch
  std::vector<std::size_t> missing_;
  std::string elsewhere_;          // the first shard that another process has in hand; empty: there is none
  Claims claims_;
};

}  // namespace kb::cli
