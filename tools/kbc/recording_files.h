// The file system of the session: the files of this machine, and which of them were read.
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "compiler/source/source.h"

namespace kb::cli {

/// Remembers what was read, in order, each file once: the dependencies of what is made, and what no output may take the place of.
/// Threads may share it.
class RecordingFiles final : public source::FileSystem {
 public:
  [[nodiscard]] Result read(std::string_view path) const override;
  [[nodiscard]] std::string canonical(std::string_view path) const override { return files_.canonical(path); }
  /// A file that is read by other means. It is no dependency.
  void note(std::string_view path);
  [[nodiscard]] const std::vector<std::string>& read_so_far() const { return read_; }
  /// `path` leads to a file that was read or noted, by whatever name. Costs a look at the disk for each of them.
  [[nodiscard]] bool is_input(std::string_view path) const;

 private:
  source::RealFileSystem files_;
  mutable std::mutex mutex_;
  mutable std::vector<std::string> read_;
  mutable std::unordered_set<std::string> known_;   // read or noted
};

}  // namespace kb::cli
