// A batch on disk: a file a shard, and in the end one file of all.
//
// note [a shard is a file]
// A shard's file appears whole or not at all, under a name that is its number. Whoever is killed loses the shards that he had
// in hand and nothing else, and nothing has to be locked: two who do the same shard write the same bytes. The first line says
// which batch it is of; runs.csv, which takes the place of all shards, begins with the same words.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/batch.h"
#include "tools/kbc/support.h"

namespace kb::cli {

class BatchFiles {
 public:
  /// `batch` must outlive it. `fingerprint`: what must be the same for runs to belong together.
  BatchFiles(std::string folder, const sim::batch::Batch& batch, std::string fingerprint);

  /// Looks at what is there; of the shards at those that `wanted` names. Makes the folder for them if runs are missing. False
  /// (reported, with the place) if something is of another batch, is damaged, or cannot be read or made.
  [[nodiscard]] bool open(Session& session, const std::vector<std::size_t>& wanted);
  /// Those of the wanted shards that are not there, in order.
  [[nodiscard]] const std::vector<std::size_t>& missing() const { return missing_; }
  /// Writes a shard's rows, each with its end of line. Empty, or why it cannot be done.
  [[nodiscard]] std::string write(std::size_t shard, const std::string& rows) const;
  /// Puts all shards together: runs.csv, summary.md, which it also returns. All shards must be there. Nothing if that fails
  /// (reported); the shards are removed if not.
  [[nodiscard]] std::optional<std::string> merge(Session& session) const;

  [[nodiscard]] std::string path(std::string_view name) const;
  [[nodiscard]] std::string shard_path(std::size_t shard) const;

 private:
  struct Text;
  [[nodiscard]] std::string shard_head(std::size_t shard) const;
  [[nodiscard]] bool read(Text& file, const std::string& head, sim::batch::Batch::Block block, std::vector<sim::batch::Run>* runs, Session& session) const;
  std::string folder_;
  const sim::batch::Batch& batch_;
  std::string head_;               // the first line of runs.csv
  bool complete_ = false;          // runs.csv holds the whole batch
  std::vector<std::size_t> missing_;
};

}  // namespace kb::cli
