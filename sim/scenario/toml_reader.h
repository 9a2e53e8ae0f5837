// TOML for the readers of scenarios: checks types and ranges of values, and reports keys that no reader asks for. Errors are reported at
// their place in the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "sim/scenario/scenario.h"

namespace kb::sim {

/// Converts the places of the TOML library (line and column) to spans.
class TomlPlaces {
 public:
  TomlPlaces(source::FileId file, const source::Sources& sources) : file_(file), sources_(sources) {}
  /// A span in the file that the region names, as set by parse_scenario; in `file` if it names none.
  [[nodiscard]] source::Span span(const toml::source_region& region) const;
  /// Whether it was put in by a setting, and is not written in `file`.
  [[nodiscard]] bool is_set(const toml::source_region& region) const { return span(region).file != file_; }

 private:
  source::FileId file_;
  const source::Sources& sources_;
};

/// The file as a table, with `settings` put in; nothing if a text is not TOML, or a setting has no place (reported).
[[nodiscard]] std::optional<toml::table> parse_scenario(source::FileId file, Settings settings, const TomlPlaces& places,
                                                        diagnostics::Diagnostics& diagnostics);

/// One table. It remembers which keys were read; `done` reports the others.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string what, const TomlPlaces& places, diagnostics::Diagnostics& diagnostics)
      : table_(&table), what_(std::move(what)), places_(&places), diagnostics_(&diagnostics) {}

  /// `of` says what the numbers are where the key does not: `metres of the floor behind the stop line,`.
  struct Range { double low, high; std::string_view of{}; };
  [[nodiscard]] bool has(std::string_view key);
  /// Whether it has the key from a setting of the command line.
  [[nodiscard]] bool is_set(std::string_view key) const;
  /// Nothing if the key is not there, or was reported.
  [[nodiscard]] std::optional<double> number(std::string_view key, Range range);
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// `true` or `false`; false if it is not there.
  [[nodiscard]] bool flag(std::string_view key);
  [[nodiscard]] std::vector<std::string> texts(std::string_view key);
  /// `wanted`: what a message says that the table is, if something else stands there.
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key, std::string_view wanted = "a table");
  /// The same; one without keys where it is not there.
  [[nodiscard]] TomlTable table_or_none(std::string_view key);
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key);
  /// Two numbers in brackets, each in its range.
  struct Pair { double x = 0.0, y = 0.0; };
  [[nodiscard]] std::optional<Pair> pair(std::string_view key, Range x, Range y);
  /// A whole number from 0 to `last`, which is below 2^53.
  [[nodiscard]] std::optional<std::uint64_t> whole(std::string_view key, double last);

  /// The place of a key's value, or of the table if the key has none.
  [[nodiscard]] source::Span span(std::string_view key = {}) const;
  void missing(std::string_view key);
  /// The same; but if there are keys that nobody asked for, one of these may have been meant for it, and they are reported instead.
  void missing_among(std::string_view key);
  /// Says what is suggested for a key that means nothing.
  void call(std::string_view wrong, std::string_view right) { called_.emplace_back(wrong, right); }
  void unknown_name(std::string_view key, std::string_view kind, std::string_view name, std::span<const std::string_view> candidates);
  /// Reports the keys that were not read, each once. `of_inner`: keys of the table `inner` within this one, which may have been meant.
  void done(std::string_view inner = {}, std::span<const std::string> of_inner = {});
  /// The keys that were asked for so far, there or not.
  [[nodiscard]] const std::vector<std::string>& asked() const { return asked_; }
  [[nodiscard]] diagnostics::Diagnostics& diagnostics() const { return *diagnostics_; }

 private:
  [[nodiscard]] bool is_asked(std::string_view key) const;
  [[nodiscard]] const toml::node* get(std::string_view key);
  diagnostics::Builder wrong_type(std::string_view key, const toml::node& node, std::string_view wanted);
  [[nodiscard]] bool in_range(std::string_view key, const toml::node& node, double value, Range range);

  const toml::table* table_;
  std::string what_;
  const TomlPlaces* places_;
  diagnostics::Diagnostics* diagnostics_;
  std::vector<std::string> asked_, reported_;
  std::vector<std::pair<std::string_view, std::string_view>> called_;
};

/// The range for a robot of that size: that of the usual robot, extended by the same range scaled.
[[nodiscard]] inline TomlTable::Range around(TomlTable::Range range, double size) { return {range.low * std::min(size, 1.0), range.high * std::max(size, 1.0)}; }

}  // namespace kb::sim
