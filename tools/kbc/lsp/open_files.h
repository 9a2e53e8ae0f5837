// The files of this machine, some replaced by the texts that an editor holds.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::lsp {

class OpenFiles final : public source::FileSystem {
 public:
  [[nodiscard]] Result read(std::string_view path) const override {
    const auto at = texts_.find(canonical(path));
    return at != texts_.end() ? Result{at->second, {}} : disk_.read(path);
  }
  [[nodiscard]] std::string canonical(std::string_view path) const override { return disk_.canonical(path); }

  /// By canonical path.
  [[nodiscard]] const std::map<std::string, std::string>& texts() const { return texts_; }
  void put(const std::string& path, std::string text) { texts_[path] = std::move(text); }
  void close(const std::string& path) { texts_.erase(path); }

 private:
  source::RealFileSystem disk_;
  std::map<std::string, std::string> texts_;
};

}  // namespace kb::lsp
