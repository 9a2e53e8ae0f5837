// The file system of the session: the files of this machine, with a record of those that were read.
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "compiler/source/source.h"

namespace kb::cli {

/// Remembers the files that were read, in order, each once: they are the dependencies of outputs, and no output may replace them.
/// Threads may share it.
class RecordingFiles final : public source::FileSystem {
 public:
  [[nodiscard]] Result read(std::string_view path) const override;
  [[nodiscard]] std::string canonical(std::string_view path) const override { return files_.canonical(path); }
  /// Notes a file that is read by other means. It is no dependency.
  void note(std::string_view path);
  [[nodiscard]] const std::vector<std::string>& read_so_far() const { return read_; }
  /// Whether `path` leads to a file that was read or noted, under any name. Costs a look at the disk for each of these.
  [[nodiscard]] bool is_input(std::string_view path) const;

 private:
  source::RealFileSystem files_;
  mutable std::mutex mutex_;
  mutable std::vector<std::string> read_;
  mutable std::unordered_set<std::string> known_;   // read or noted
};

}  // namespace kb::cli
