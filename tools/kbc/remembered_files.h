// Files as they were when first read.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::cli {

/// For compiling the same files repeatedly while a robot drives: edits made meanwhile are not seen, so none is seen in part. For one thread.
class RememberedFiles final : public source::FileSystem {
 public:
  /// `files` must outlive it.
  explicit RememberedFiles(const source::FileSystem& files) : files_(files) {}

  [[nodiscard]] Result read(std::string_view path) const override {
    const auto [known, fresh] = read_.try_emplace(std::string(path));
    if (fresh) known->second = files_.read(path);
    return known->second;
  }
  [[nodiscard]] std::string canonical(std::string_view path) const override {
    const auto [known, fresh] = canonical_.try_emplace(std::string(path));
    if (fresh) known->second = files_.canonical(path);
    return known->second;
  }

 private:
  const source::FileSystem& files_;
  mutable std::map<std::string, Result> read_;
  mutable std::map<std::string, std::string> canonical_;
};

}  // namespace kb::cli
