// The file system of the session: the files of this machine, and which of them were read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::cli {

/// Remembers what was read, in order, each file once: the dependencies of what is made.
class RecordingFiles final : public source::FileSystem {
 public:
  [[nodiscard]] Result read(std::string_view path) const override;
  [[nodiscard]] std::string canonical(std::string_view path) const override { return files_.canonical(path); }
  [[nodiscard]] const std::vector<std::string>& read_so_far() const { return read_; }

 private:
  source::RealFileSystem files_;
  mutable std::vector<std::string> read_;
};

}  // namespace kb::cli
