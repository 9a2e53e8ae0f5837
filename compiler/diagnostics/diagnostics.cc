#include "compiler/diagnostics/diagnostics.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/diagnostics/look_alike.h"

namespace kb::diagnostics {
namespace {

std::string fill(Kind kind, std::initializer_list<std::string_view> arguments) {
  const std::string_view text = info(kind).text;
  std::vector<std::string> filled(arguments.begin(), arguments.end());
  std::size_t automatic = 0;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    if (text[at] != '{' || text[++at] == '{') continue;
    const std::size_t n = text[at] == '}' ? automatic++ : static_cast<std::size_t>(text[at] - '0');
    const std::size_t end = text.find('}', at);
    const bool code = at > 1 && text[at - 2] == '`' && text.substr(end + 1).starts_with('`');
    if (code && n < filled.size()) filled[n] = between_backticks(arguments.begin()[n]);
  }
  fmt::dynamic_format_arg_store<fmt::format_context> store;
  for (const std::string& argument : filled) store.push_back(argument);
  return fmt::vformat(text, store);
}

bool holds(const std::vector<bool>& set, Kind kind) {
  const auto i = static_cast<std::size_t>(kind);
  return i < set.size() && set[i];
}

void mark(std::vector<bool>& set, Kind kind, bool value) {
  set.resize(static_cast<std::size_t>(Kind::kCount_), false);
  set[static_cast<std::size_t>(kind)] = value;
}

/// Whether messages of the kind say that something named nowhere is known. A misspelt name mostly stands in many places.
bool says_unknown(Kind kind) {
  switch (kind) {
    case Kind::kUnknownSet:
    case Kind::kUnknownMember:
    case Kind::kUnknownField:
    case Kind::kRoadUnknownLandmark:
    case Kind::kUnknownExit:
    case Kind::kUnknownMethod:
    case Kind::kUnknownMap:
    case Kind::kUnknownCommand:
    case Kind::kUnknownLandmark:
    case Kind::kUnknownLevel:
    case Kind::kUnknownRelation: return true;
    default: return false;
  }
}

}  // namespace

bool WarningOptions::apply(std::string_view option) {
  const auto take = [&option](std::string_view prefix) {
    if (!option.starts_with(prefix)) return false;
    option.remove_prefix(prefix.size());
    return true;
  };
  if (option == "error") return all_errors = true;
  if (option == "no-error") return !(all_errors = false);
  if (option == "standard-library") return standard_library = true;
  if (option == "no-standard-library") return !(standard_library = false);
  if (option == "allowed") return allowed = true;
  if (option == "no-allowed") return !(allowed = false);
  const bool as_error = take("error=");
  const bool not_error = !as_error && take("no-error=");
  const bool disabled = !as_error && !not_error && take("no-");
  const std::optional<Kind> kind = find_flag(option);
  if (!kind) return false;
  if (as_error || not_error) {
    mark(error, *kind, as_error);
    mark(never_error, *kind, not_error);
  }
  if (!not_error) mark(off, *kind, disabled);
  return true;
}

Builder& Builder::note(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
  diagnostic_.notes.push_back({kind, at, fill(kind, arguments)});
  return *this;
}

Builder& Builder::suggest(std::optional<std::string> better) {
  if (!better) return *this;
  diagnostic_.suggestion = std::move(*better);
  if (!diagnostic_.span.known()) return *this;
  // "did you mean `Cafe`?" helps nobody who sees the same letters.
  const std::string_view written = owner_.sources_.text(diagnostic_.span);
  if (look_alike(written, diagnostic_.suggestion)) note(Kind::kLooksAlike, {}, {difference(written, diagnostic_.suggestion)});
  return *this;
}

Builder::~Builder() { owner_.finish(std::move(diagnostic_)); }

Builder Diagnostics::report(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
  return {*this, {kind, info(kind).severity, at, fill(kind, arguments), {}, {}}};
}

// False if the user does not want to see the message. Turns a warning into an error if the user wants that.
bool Diagnostics::wanted(Diagnostic& d) {
  if (d.severity != Severity::kWarning) return true;
  if (hides(d.kind, d.span) || std::any_of(d.notes.begin(), d.notes.end(), [&](const Note& note) { return allowed_by_source(d.kind, note.span); })) return false;
  if (raised(d.kind)) d.severity = Severity::kError;
  return true;
}

bool Diagnostics::raised(Kind warning) const {
  return holds(options_.error, warning) || (options_.all_errors && !holds(options_.never_error, warning));
}

bool Diagnostics::hides(Kind warning, source::Span at, source::Span other) {
  const bool library = at.known() && sources_.standard(at.file) && !options_.standard_library;
  return options_.none || library || holds(options_.off, warning) || allowed_by_source(warning, at) || allowed_by_source(warning, other);
}

bool Diagnostics::allowed_by_source(Kind warning, source::Span at) {
  return !options_.allowed && allowed_.allow(sources_, at, info(warning).flag, code_text(warning));
}

// The first that is not handed on counts as well: it says that there are more.
bool Diagnostics::full(Kind warning) const {
  return options_.none || holds(options_.off, warning) || (raised(warning) ? errors_ : warnings_) > kMaxErrors;
}

void Diagnostics::finish(Diagnostic&& d) {
  if (!wanted(d) || (filter_ && !filter_(d))) return;
  // Messages without a place differ in their words: two files that cannot be read are two messages.
  const bool by_words = !d.span.known() || says_unknown(d.kind);
  const source::Span place = by_words ? source::Span{} : d.span, other = by_words || d.notes.empty() ? source::Span{} : d.notes.front().span;
  const bool several = by_words || d.kind == Kind::kLayoutAdapted;   // one part of a layout may be adapted in several ways
  if (!said_.insert({d.kind, place, other, several ? d.message : std::string()}).second) return;
  const bool error = d.severity == Severity::kError;
  broken_ = broken_ || info(d.kind).severity == Severity::kError;
  const std::size_t nth = error ? ++errors_ : ++warnings_;
  if (nth <= kMaxErrors) return consumer_.consume(d);
  if (nth > kMaxErrors + 1) return;
  const std::string most = fmt::format("{}", kMaxErrors);
  consumer_.consume({Kind::kTooManyMessages, Severity::kNote, {},
                     fill(Kind::kTooManyMessages, {most, error ? "errors" : "warnings"}), {}, {}});
}

bool Diagnostics::Said::operator<(const Said& that) const {
  const auto key = [](const Said& s) {
    return std::tie(s.kind, s.span.file, s.span.begin, s.span.end, s.other.file, s.other.begin, s.other.end, s.message);
  };
  return key(*this) < key(that);
}

std::optional<source::FileId> open_file(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                        Diagnostics& diagnostics) {
  auto read = files.read(path);
  if (read.bytes) return sources.add(path, std::move(*read.bytes));
  if (read.too_large) diagnostics.report(Kind::kFileTooLarge, {}, {path, std::to_string(source::kMaxFileBytes >> 20)});
  else diagnostics.report(Kind::kCannotRead, {}, {path, read.error});
  return std::nullopt;
}

}  // namespace kb::diagnostics
