// Text in columns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "compiler/diagnostics/display.h"

namespace kb::trace {

/// Lines of text, built column by column, so that each column is as wide as its widest entry on a terminal.
class Grid {
 public:
  explicit Grid(std::size_t lines) : lines_(lines) {}
  /// An entry for each line.
  void add_column(const std::vector<std::string>& entries, bool left) {
    std::size_t widest = 0;
    for (const std::string& entry : entries) widest = std::max(widest, diagnostics::columns(entry));
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const std::string gap(widest - diagnostics::columns(entries[i]), ' ');
      lines_[i] += (lines_[i].empty() ? "" : "  ") + (left ? entries[i] + gap : gap + entries[i]);
    }
  }
  [[nodiscard]] std::string text() const {
    std::string out;
    for (const std::string& line : lines_) out.append(line, 0, line.find_last_not_of(' ') + 1).append("\n");
    return out;
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace kb::trace
