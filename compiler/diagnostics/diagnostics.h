// What the compiler says: messages that are declared once (kinds.def), carried as values, printed by consumers.
//
//   diagnostics.report(Kind::kUnknownName, span, {name})
//       .note(Kind::kNameDeclaredHere, first_span, {name})
//       .suggest("LM13");
//
// A message is complete when the builder dies (at the end of the statement); it then goes to the consumer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/allowed.h"
#include "compiler/source/source.h"

namespace kb::diagnostics {

enum class Severity : std::uint8_t { kNote, kWarning, kError };
/// `error`, `warning`, `note`.
[[nodiscard]] constexpr std::string_view word(Severity severity) {
  return severity == Severity::kError ? "error" : severity == Severity::kWarning ? "warning" : "note";
}

/// Every message there is. Declared in kinds.def (which includes one `kinds_*.def` a family).
enum class Kind : std::uint16_t {
#define KB_ERROR(name, code, text) k##name,
#define KB_WARNING(name, code, flag, text) k##name,
#define KB_NOTE(name, text) k##name,
#include "compiler/diagnostics/kinds.def"
#undef KB_ERROR
#undef KB_WARNING
#undef KB_NOTE
  kCount_
};

/// What kinds.def says of one kind. `code` is 0 for notes; `flag` is the name after -W, empty for errors and notes.
struct KindInfo {
  std::string_view name;
  std::uint16_t code;
  Severity severity;
  std::string_view flag;
  std::string_view text;
};
[[nodiscard]] const KindInfo& info(Kind kind);
/// The kind with this code ("KB0301", "kb301", "301"), if there is one.
[[nodiscard]] std::optional<Kind> find_code(std::string_view code);
[[nodiscard]] std::optional<Kind> find_flag(std::string_view flag);
/// The names of all warnings.
[[nodiscard]] std::vector<std::string_view> flags();
/// "KB0301".
[[nodiscard]] std::string code_text(Kind kind);
/// What the message says with nothing filled in, for people: `A is declared twice`, a letter for each name, `...` for words.
[[nodiscard]] std::string general_text(Kind kind);
/// The long explanation of an error or warning (Markdown, with a wrong and a right example); empty for notes.
[[nodiscard]] std::string_view explanation(Kind kind);

struct Note {
  Kind kind;
  source::Span span;
  std::string text;
};

struct Diagnostic {
  Kind kind;
  Severity severity;         ///< after -Werror; kNote only for the note that says there are more messages
  source::Span span;
  std::string message;       ///< arguments filled in; lower case, no full stop
  std::vector<Note> notes;
  std::string suggestion;    ///< "did you mean `...`?"; empty if there is none
};

/// Where messages go: text with carets, JSON, SARIF, or a list (consumers.h).
class Consumer {
 public:
  virtual ~Consumer() = default;
  virtual void consume(const Diagnostic& diagnostic) = 0;
};

/// Which warnings are shown, and which count as errors: -W…, -Wno-…, -Werror, -Werror=…, -w, -Wstandard-library, -Wallowed.
struct WarningOptions {
  std::vector<bool> off;      ///< by Kind; empty: all on
  std::vector<bool> error;    ///< by Kind; empty: none
  std::vector<bool> never_error;  ///< by Kind; empty: none. -Wno-error=…, which outlasts -Werror
  bool all_errors = false;    ///< -Werror
  bool none = false;          ///< -w
  bool standard_library = false;  ///< also warnings whose place is in a file of the standard library
  bool allowed = false;       ///< also warnings that the source allows: see note [allowed warnings]
  /// Takes what stood after -W ("no-never-read", "error", "error=never-read", "never-read"). False if it names no warning.
  [[nodiscard]] bool apply(std::string_view option);
};

class Diagnostics;

/// A message under way. Lives until the end of the statement that began it.
class Builder {
 public:
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;
  ~Builder();
  Builder& note(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments = {});
  Builder& suggest(std::optional<std::string> better);

 private:
  friend class Diagnostics;
  Builder(Diagnostics& owner, Diagnostic diagnostic) : owner_(owner), diagnostic_(std::move(diagnostic)) {}
  Diagnostics& owner_;
  Diagnostic diagnostic_;
};

/// The candidate that was probably meant by `word`:
/// 1. the one that looks like it (look_alike.h); else
/// 2. the nearest by edit distance (a transposition counts one, ASCII case nothing), if the distance is <= 1 + length/4 and less
///    than half of the longer word; of several equally near, the first; else
/// 3. the shortest that begins with `word`, or ends with it after a `.`.
/// Nothing for words of more than 128 bytes.
[[nodiscard]] std::optional<std::string> closest(std::string_view word, std::span<const std::string_view> candidates);

/// Hands messages on to one consumer, counts them, and stops an avalanche: at most `kMaxErrors` errors and as many warnings
/// are handed on (a last note without a place says so), no two messages of one kind at one place, and only one that says that a certain
/// name is unknown.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxErrors = 200;

  Diagnostics(const source::Sources& sources, Consumer& consumer, WarningOptions options = {})
      : sources_(sources), consumer_(consumer), options_(std::move(options)) {}

  /// From now on only messages that `filter` takes are handed on and counted.
  void limit(std::function<bool(const Diagnostic&)> filter) { filter_ = std::move(filter); }

  /// The places where the statements of a file begin, ascending: see note [allowed warnings].
  void know_statements(source::FileId file, std::span<const std::uint32_t> begins) { allowed_.know(sources_, file, begins); }

  /// `{}` or `{0}` in the kind's text are filled with `arguments`.
  Builder report(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments = {});

  /// True once no further error is handed on. Costly work that serves only the wording of an error can then be skipped.
  [[nodiscard]] bool full() const { return errors_ >= kMaxErrors; }
  /// True once no further warning of this kind is handed on: it is off, all warnings are, or enough were reported.
  [[nodiscard]] bool full(Kind warning) const;
  /// Whether nobody wants to see a warning of this kind at this place: its kind is off, it is about the standard library, or a comment allows it
  /// there or at the other place.
  [[nodiscard]] bool hides(Kind warning, source::Span at, source::Span other = {});
  /// `closest`, for an error about to be reported; nothing if `full`. The cost is linear in the candidates, and if the file that
  /// declares them is missing or the wrong one, there are as many errors as names. `name` makes a candidate a view of something that
  /// lives on; what it makes empty is no candidate.
  template <class Candidates, class Name = std::identity>
  [[nodiscard]] std::optional<std::string> nearest(std::string_view word, const Candidates& candidates, Name name = {}) const {
    return nearest_of(word, [&](std::vector<std::string_view>& views) {
      for (const auto& one : candidates) views.emplace_back(std::invoke(name, one));
    });
  }
  /// The same; `list` appends the candidates to the vector that it is given.
  template <class List>
  [[nodiscard]] std::optional<std::string> nearest_of(std::string_view word, List list) const {
    if (full()) return std::nullopt;
    std::vector<std::string_view> views;
    list(views);
    return closest(word, views);
  }

  [[nodiscard]] std::size_t errors() const { return errors_; }
  [[nodiscard]] std::size_t warnings() const { return warnings_; }
  [[nodiscard]] bool failed() const { return errors_ > 0; }
  /// A true error was reported, not just a warning raised by -Werror: what was made so far is incomplete.
  [[nodiscard]] bool broken() const { return broken_; }
  [[nodiscard]] const source::Sources& sources() const { return sources_; }
  [[nodiscard]] const WarningOptions& options() const { return options_; }

 private:
  friend class Builder;
  void finish(Diagnostic&& diagnostic);
  bool wanted(Diagnostic& diagnostic);
  [[nodiscard]] bool allowed_by_source(Kind warning, source::Span at);
  [[nodiscard]] bool raised(Kind warning) const;   // to an error
  const source::Sources& sources_;
  Consumer& consumer_;
  WarningOptions options_;
  AllowancesOfFiles allowed_;
  std::function<bool(const Diagnostic&)> filter_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  bool broken_ = false;
  struct Said {
    Kind kind;
    source::Span span;
    source::Span other;    // of the first note: one rule can disagree with several others
    std::string message;   // only where no span is known, or the place does not matter
    bool operator<(const Said& that) const;
  };
  std::set<Said> said_;
};

/// Whether `written` is `meant` with one slip: a letter added, missing or replaced, or two letters swapped. More than one makes it
/// another name: `follow_rail` is not a misspelt `follow_wall`. Names of less than four letters are never taken for slips.
[[nodiscard]] bool is_slip_of(std::string_view written, std::string_view meant);

/// Reads a file into `sources`. If it cannot be read, reports that and returns nothing.
[[nodiscard]] std::optional<source::FileId> open_file(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                                      Diagnostics& diagnostics);

}  // namespace kb::diagnostics
