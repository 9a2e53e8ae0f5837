// Where messages go: text for people, JSON and SARIF for programs, a list or two numbers for tests.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"

namespace kb::diagnostics {

/// Takes text as it is made; never called with nothing.
using Sink = std::function<void(std::string_view)>;

/// For people:
///
///     route1.kb:8:25: error: no landmark is called `LM33` [KB0406]
///         8 |     LM5 -> LM2 -> LM33 -> LM6
///           |                   ^~~~
///           = did you mean `LM3`?
///     labyrinth.kb:19:14: note: the map is declared here
///        19 | map Labyrinth {
///           |     ^~~~~~~~~
///
/// A warning ends in `[-Wnever-read KB1021]`. The underline stands under the place on a terminal that shows each code point
/// in its usual width (two columns for Han and the like, none for combining marks); tabs become blanks, bytes that no
/// terminal should see become `<1B>`. A long line is cut to the part round the place.
class TextConsumer final : public Consumer {
 public:
  /// `sources` must outlive it. `color`: ANSI colours.
  TextConsumer(const source::Sources& sources, Sink sink, bool color = false)
      : sources_(sources), sink_(std::move(sink)), color_(color) {}
  void consume(const Diagnostic& diagnostic) override;

 private:
  const source::Sources& sources_;
  Sink sink_;
  bool color_;
};

/// For programs: one JSON object a line, so that a reader can begin before the compiler ends.
///
///     {"severity":"error","code":"KB0406","flag":"","message":"...","suggestion":"LM3","place":PLACE,
///      "notes":[{"message":"...","place":PLACE}]}
///
/// `flag` is what stands after -W for a warning; `code` and `flag` are empty if the message has none. PLACE is null or
/// `{"file":"route1.kb","line":8,"column":25,"end_line":8,"end_column":29,"begin":311,"end":315}`: lines and columns begin
/// at 1, columns count code points, `end_column` and `end` are those after the last; `begin` and `end` count bytes from 0.
class JsonConsumer final : public Consumer {
 public:
  JsonConsumer(const source::Sources& sources, Sink sink) : sources_(sources), sink_(std::move(sink)) {}
  void consume(const Diagnostic& diagnostic) override;

 private:
  const source::Sources& sources_;
  Sink sink_;
};

/// One SARIF 2.1.0 document (OASIS) for any number of compilations; code hosts and editors read this format.
class SarifLog {
 public:
  /// `version` of the tool, as in "0.1.0".
  explicit SarifLog(std::string version);
  ~SarifLog();
  void add(const source::Sources& sources, const Diagnostic& diagnostic);
  /// The whole document, with a SARIF rule for each kind of message in it.
  [[nodiscard]] std::string print() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class SarifConsumer final : public Consumer {
 public:
  /// Both must outlive it.
  SarifConsumer(const source::Sources& sources, SarifLog& log) : sources_(sources), log_(log) {}
  void consume(const Diagnostic& diagnostic) override { log_.add(sources_, diagnostic); }

 private:
  const source::Sources& sources_;
  SarifLog& log_;
};

/// Keeps all messages; for tests.
class CollectingConsumer final : public Consumer {
 public:
  void consume(const Diagnostic& diagnostic) override { all.push_back(diagnostic); }
  [[nodiscard]] bool has(Kind kind) const;
  std::vector<Diagnostic> all;
};

/// Appends each error to a string, one a line: `file:line:col: text`. For programs that compile text they wrote themselves.
class ErrorLines final : public Consumer {
 public:
  ErrorLines(const source::Sources& sources, std::string& lines) : sources_(sources), lines_(lines) {}
  void consume(const Diagnostic& diagnostic) override;
  /// For driver::compile; `lines` is a std::string.
  [[nodiscard]] static std::unique_ptr<Consumer> make(const source::Sources& sources, void* lines);

 private:
  const source::Sources& sources_;
  std::string& lines_;
};

/// Appends each message to a list, for callers that report later or not at all.
class Keeping final : public Consumer {
 public:
  explicit Keeping(std::vector<Diagnostic>& list) : list_(list) {}
  void consume(const Diagnostic& diagnostic) override { list_.push_back(diagnostic); }
  /// For driver::compile; `list` is a std::vector<Diagnostic>.
  [[nodiscard]] static std::unique_ptr<Consumer> make(const source::Sources&, void* list) { return std::make_unique<Keeping>(*static_cast<std::vector<Diagnostic>*>(list)); }

 private:
  std::vector<Diagnostic>& list_;
};

/// Drops messages, and counts errors and warnings.
class CountingConsumer final : public Consumer {
 public:
  /// For driver::compile.
  [[nodiscard]] static std::unique_ptr<Consumer> make(const source::Sources&, void*) { return std::make_unique<CountingConsumer>(); }
  void consume(const Diagnostic& diagnostic) override {
    if (diagnostic.severity == Severity::kError) ++errors;
    if (diagnostic.severity == Severity::kWarning) ++warnings;
  }
  std::size_t errors = 0, warnings = 0;
};

/// "2 errors and 1 warning"; empty if there are none.
[[nodiscard]] std::string summary(std::size_t errors, std::size_t warnings);

/// All messages with their explanations as one Markdown page: docs/diagnostics.md.
[[nodiscard]] std::string print_markdown();
/// One line for each message that has a code: `KB0301  error    unknown-name ...`.
[[nodiscard]] std::string print_list();

}  // namespace kb::diagnostics
