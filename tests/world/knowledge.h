// A knowledge base for tests: `.kb` text in memory over the real standard library, compiled once.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/driver/compile.h"
#include "compiler/program/program.h"
#include "tests/world/map.h"

namespace kb::world {

/// The text does not compile; what() holds the messages.
class DoesNotCompile : public std::runtime_error { using std::runtime_error::runtime_error; };

class Knowledge {
 public:
  /// Compiles `text` as the file `mission.kb` (warnings are not asked for). Throws DoesNotCompile.
  [[nodiscard]] static std::shared_ptr<const Knowledge> of_text(std::string_view text);
  /// As of_text, but a text that was compiled before in this process is not compiled again.
  [[nodiscard]] static std::shared_ptr<const Knowledge> cached(const std::string& text);
  /// Compiles a file of the project's tree; `path` is relative to its root.
  [[nodiscard]] static std::shared_ptr<const Knowledge> of_file(std::string_view path);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const program::Program& program() const { return compilation_->program; }
  [[nodiscard]] const tables::Tables& tables() const { return compilation_->tables; }
  [[nodiscard]] const model::Model& model() const { return compilation_->model; }

  /// The cell of this name, or kNone.
  [[nodiscard]] program::CellId find(std::string_view name) const;
  /// As find; throws std::out_of_range for a name that is not there (a mistake in a test).
  [[nodiscard]] program::CellId cell(std::string_view name) const;
  /// The cells of a group (`Out`, `Cross`); with `own_satellites`, the `sat X` of each. Empty if there is no such
  /// group.
  [[nodiscard]] std::vector<program::CellId> group(std::string_view name, bool own_satellites = false) const;
  /// The satellites of a relation's rows (`Leg`, `Route`). Empty if there is no such relation.
  [[nodiscard]] std::vector<program::CellId> rows(std::string_view relation) const;
  /// The name of a cell; "-" for kNone.
  [[nodiscard]] std::string_view name(program::CellId cell) const;

 private:
  Knowledge(std::string text, std::unique_ptr<driver::Compilation> compilation);
  std::string text_;
  std::unique_ptr<driver::Compilation> compilation_;
  std::unordered_map<std::string_view, program::CellId> cells_;  // looked up, never iterated
};

/// The map that the knowledge base declares, all roads `length_m` long.
[[nodiscard]] Map map_of(const model::Model& model, double length_m);

/// A file of the project's tree; `path` is relative to its root. Throws std::runtime_error if it cannot be read.
[[nodiscard]] std::string project_file(std::string_view path);
/// The absolute path of a file or folder in the project's tree.
[[nodiscard]] std::string project_path(std::string_view path);

}  // namespace kb::world
