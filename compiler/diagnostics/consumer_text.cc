#include <fmt/format.h>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/display.h"

namespace kb::diagnostics {
namespace {

// ANSI: bold, and a bold colour for each severity.
constexpr std::string_view kBold = "\x1b[1m", kPlain = "\x1b[0m", kGreen = "\x1b[1;32m";

std::string_view paint(Severity severity) {
  switch (severity) {
    case Severity::kError: return "\x1b[1;31m";
    case Severity::kWarning: return "\x1b[1;35m";
    case Severity::kNote: return "\x1b[1;36m";
  }
  return kPlain;
}

class Printer {
 public:
  Printer(const source::Sources& sources, bool color) : sources_(sources), color_(color) {}

  void head(Severity severity, source::Span at, std::string_view message, std::string_view tag) {
    const std::string place = at.known() ? visible(sources_.describe(at)) : "kbc";
    out_ += on(kBold);
    fmt::format_to(std::back_inserter(out_), "{}: {}{}{}: {}", place, on(paint(severity)), word(severity), on(kPlain),
                   on(kBold));
    out_ += visible(message);
    out_ += on(kPlain);
    if (!tag.empty()) fmt::format_to(std::back_inserter(out_), " [{}{}{}]", on(paint(severity)), tag, on(kPlain));
    out_ += '\n';
  }

  // The source line with the place underlined; the first line if there are several.
  void excerpt_of(Severity severity, source::Span at) {
    if (!at.known()) return;
    const source::Sources::Line line = sources_.line_of(at.file, at.begin);
    const Excerpt shown = excerpt(line.text, at.begin - line.begin, at.end - line.begin);
    fmt::format_to(std::back_inserter(out_), "{:>5} | {}\n", sources_.locate(at.file, at.begin).line, shown.text);
    fmt::format_to(std::back_inserter(out_), "      | {:{}}{}^{:~<{}}{}\n", "", shown.column, on(paint(severity)), "",
                   shown.columns - 1, on(kPlain));
  }

  void suggestion(std::string_view better) {
    if (better.empty()) return;
    fmt::format_to(std::back_inserter(out_), "      = did you mean `{}{}{}`?\n", on(kGreen), visible(better), on(kPlain));
  }

  // A note without a place is about the place of the message.
  void remark(std::string_view note) { fmt::format_to(std::back_inserter(out_), "      = {}\n", visible(note)); }

  [[nodiscard]] const std::string& text() const { return out_; }

 private:
  [[nodiscard]] std::string_view on(std::string_view code) const { return color_ ? code : std::string_view(); }
  const source::Sources& sources_;
  bool color_;
  std::string out_;
};

std::string tag(const Diagnostic& d) {
  const KindInfo& kind = info(d.kind);
  if (kind.code == 0) return {};
  if (kind.severity != Severity::kWarning) return code_text(d.kind);
  return fmt::format("-W{}{} {}", d.severity == Severity::kError ? "error=" : "", kind.flag, code_text(d.kind));
}

}  // namespace

void TextConsumer::consume(const Diagnostic& d) {
  Printer printer(sources_, color_);
  printer.head(d.severity, d.span, d.message, tag(d));
  printer.excerpt_of(d.severity, d.span);
  printer.suggestion(d.suggestion);
  for (const Note& note : d.notes) {
    if (!note.span.known()) printer.remark(note.text);
  }
  for (const Note& note : d.notes) {
    if (!note.span.known()) continue;
    printer.head(Severity::kNote, note.span, note.text, {});
    printer.excerpt_of(Severity::kNote, note.span);
  }
  sink_(printer.text());
}

void ErrorLines::consume(const Diagnostic& diagnostic) {
  if (diagnostic.severity == Severity::kError) lines_ += sources_.describe(diagnostic.span) + ": " + diagnostic.message + "\n";
}

std::unique_ptr<Consumer> ErrorLines::make(const source::Sources& sources, void* lines) {
  return std::make_unique<ErrorLines>(sources, *static_cast<std::string*>(lines));
}

bool CollectingConsumer::has(Kind kind) const {
  for (const Diagnostic& d : all) {
    if (d.kind == kind) return true;
  }
  return false;
}


std::string summary(std::size_t errors, std::size_t warnings) {
  if (errors > 0 && warnings > 0) return counted(errors, "error") + " and " + counted(warnings, "warning");
  if (errors > 0) return counted(errors, "error");
  return warnings > 0 ? counted(warnings, "warning") : std::string();
}

}  // namespace kb::diagnostics
