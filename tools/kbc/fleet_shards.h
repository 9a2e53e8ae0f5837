// A batch on disk: one file for each shard, and in the end one file for all.
//
// note [a shard is a file]
// A shard's file appears whole or not at all, under its number as a name. A process that is killed loses only the shards in hand. Two
// processes that do the same shard write the same bytes, so locks serve only to save work, and to keep one process from removing what
// another is merging. A shard in hand is a locked byte of `shards/.claims`, which the kernel unlocks however the process ends. The first
// line of a shard names its batch; runs.csv, which replaces all shards, begins with the same words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/batch/batch.h"
#include "tools/kbc/support.h"

namespace kb::cli {

/// Numbers locked by this process for as long as this object lives.
class Claims {
 public:
  Claims() = default;
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;
  ~Claims();
  /// False if another process holds the number in the file at `path`; the file is made, and has to be the same each time. True also if
  /// files cannot be locked here.
  [[nodiscard]] bool take(const std::string& path, std::size_t number);
  /// Whether files can be locked here, so that what was taken is held by no other process.
  [[nodiscard]] bool locks() const { return locks_; }

 private:
  int file_ = -1;
  bool locks_ = true;
};

/// What runs that belong together have in common: names, and values without a comma. The results tell by these in what a batch differs.
using BatchParts = std::vector<std::pair<std::string, std::string>>;
/// A number made of all of them.
[[nodiscard]] std::string fingerprint_of(const BatchParts& parts);

class BatchFiles {
 public:
  /// `batch` must outlive it.
  BatchFiles(std::string folder, const sim::batch::Batch& batch, BatchParts parts);

  /// Looks at the files there: at the shards in `wanted`, which ascend, and at the beginning of one of the others. False (reported, with the
  /// place) if one belongs to another batch, is damaged, or cannot be read.
  [[nodiscard]] bool open(Session& session, const std::vector<std::size_t>& wanted);
  /// The wanted shards that are missing, in order.
  [[nodiscard]] const std::vector<std::size_t>& missing() const { return missing_; }
  /// Whether the batch is merged already.
  [[nodiscard]] bool complete() const { return complete_; }
  /// The runs that are there, in order: of the whole batch, or of the wanted shards that `open` found. Nothing (reported) if one cannot be
  /// read.
  [[nodiscard]] std::optional<std::vector<sim::batch::Run>> runs(Session& session) const;
  /// How many shards of the whole batch are there.
  [[nodiscard]] std::size_t done() const;
  /// Makes the folder of shards, and drops from the missing ones those that another process has in hand or has written by now.
  /// Of the others it removes what processes left that were killed while they wrote. False (reported) if the folder cannot be made.
  [[nodiscard]] bool claim(Session& session);
  /// Whether `claim` got all missing shards; false (reported) if another process has some in hand.
  [[nodiscard]] bool claimed_all(Session& session) const { return elsewhere_.empty() || refuse(elsewhere_, session); }
  /// Writes a shard's rows, each with its end of line. Empty, or why it failed.
  [[nodiscard]] std::string write(std::size_t shard, const std::string& rows) const;
  struct Merged { std::string summary; std::vector<sim::batch::Run> runs; };
  /// Merges all shards, which must be there, into runs.csv and summary.md; returns the summary's text and all runs. The shards are then
  /// removed. Nothing if that fails (reported).
  [[nodiscard]] std::optional<Merged> merge(Session& session);

  [[nodiscard]] std::string path(std::string_view name) const;
  [[nodiscard]] std::string shard_path(std::size_t shard) const;

 private:
  struct Text;
  void remove_left() const;
  /// Takes a batch that another command has finished since it was opened for finished. Call it when a lock has been taken: whoever finishes a
  /// batch removes the locks only then.
  void look_again();
  [[nodiscard]] static bool refuse(const std::string& path, Session& session);
  [[nodiscard]] std::string shard_head(std::size_t shard) const;
  [[nodiscard]] std::string differs(std::string_view there) const;
  [[nodiscard]] bool read_head(Text& file, const std::string& head, Session& session) const;
  [[nodiscard]] bool read(Text& file, const std::string& head, sim::batch::Batch::Block block, std::vector<sim::batch::Run>* runs, Session& session) const;
  std::string folder_;
  const sim::batch::Batch& batch_;
  BatchParts parts_;
  std::string head_;               // the first line of runs.csv
  bool complete_ = false;          // runs.csv holds the whole batch
  std::vector<std::size_t> there_; // the wanted shards that were found
  std::vector<std::size_t> missing_;
  std::string elsewhere_;          // the first shard that another process has in hand; empty: there is none
  Claims claims_;
};

}  // namespace kb::cli
