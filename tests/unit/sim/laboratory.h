// A knowledge base, its floor, and drives on it, for tests.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "compiler/driver/compile.h"
#include "sim/drive/drive.h"

namespace kb::sim::testing {

class Laboratory {
 public:
  /// Compiles `text` over the standard library and lays it out. Throws with the messages if that fails.
  static std::unique_ptr<Laboratory> of_text(std::string_view text, const LayoutOptions& layout = {});
  /// The same with a file of the project.
  static std::unique_ptr<Laboratory> of_file(std::string_view path, const LayoutOptions& layout = {});

  /// The scenario in TOML `text`. Throws with the messages if it has mistakes.
  [[nodiscard]] Scenario scenario(std::string_view text);
  /// The drive in which nothing goes wrong.
  [[nodiscard]] Scenario plain();
  /// Drives to the end; writes it down if asked to.
  [[nodiscard]] Summary drive(const Scenario& scenario, Recording* recording = nullptr) const;
  /// The trace as JSON lines.
  [[nodiscard]] std::string trace(const Scenario& scenario) const;

  std::unique_ptr<driver::Compilation> compiled;
  std::optional<Labyrinth> labyrinth;
  std::optional<Knowledge> knowledge;

 private:
  void lay_out_all(const LayoutOptions& layout);
  std::string said_;
};

/// A file of the project's tree.
[[nodiscard]] std::string project_file(std::string_view path);

}  // namespace kb::sim::testing
