#include "compiler/diagnostics/allowed.h"

#include <algorithm>

#include "compiler/source/encoding.h"

namespace kb::diagnostics {
namespace {

constexpr int kMostLines = 1000;   // of a statement: in a long map its head is not looked for
constexpr std::string_view kWord = "allow:";

/// The comment of a line, without its `#`; empty if it has none.
std::string_view comment_of(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return source::trimmed(line.substr(i + 1));
  }
  return {};
}

bool allows(std::string_view line, std::string_view flag, std::string_view code) {
  std::string_view rest = comment_of(line);
  if (!rest.starts_with(kWord)) return false;
  rest.remove_prefix(kWord.size());
  while (true) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view item = source::trimmed(rest.substr(0, comma)), word = item.substr(0, item.find_first_of(" \t;:"));
    if (word == flag || word == code) return true;
    if (comma == rest.size()) return false;
    rest.remove_prefix(comma + 1);
  }
}

bool is_comment(std::string_view line) { return source::trimmed(line).starts_with('#'); }
bool is_indented(std::string_view line) { return line.empty() || line[0] == ' ' || line[0] == '\t' || line[0] == '}' || line[0] == '\r'; }

/// The lines of a file from one upwards.
class Upwards {
 public:
  Upwards(const source::Sources& sources, source::Span at) : sources_(sources), file_(at.file), line_(sources.line_of(at.file, at.begin)) {}
  [[nodiscard]] std::string_view line() const { return line_.text; }
  [[nodiscard]] const source::Sources::Line& here() const { return line_; }
  /// False at the first line.
  bool up() {
    if (line_.begin == 0) return false;
    line_ = sources_.line_of(file_, line_.begin - 1);
    return true;
  }

 private:
  const source::Sources& sources_;
  source::FileId file_;
  source::Sources::Line line_;
};

/// Whether a comment in the lines right above allows it. Ends at the first line that is more than a comment; false if there is none.
bool goes_on(Upwards& lines, std::string_view flag, std::string_view code, bool& allowed) {
  while (lines.up()) {
    if (!is_comment(lines.line())) return true;
    allowed = allowed || allows(lines.line(), flag, code);
  }
  return false;
}

/// Goes to the line where the statement begins. False if that is far away, or there is none.
bool to_statement(Upwards& lines) {
  for (int i = 0; is_indented(lines.line()) || is_comment(lines.line()); ++i) {
    if (i == kMostLines || !lines.up()) return false;
  }
  return true;
}

}  // namespace

bool is_allowed(const source::Sources& sources, source::Span at, std::string_view flag, std::string_view code) {
  if (!at.known()) return false;
  Upwards lines(sources, at);
  bool allowed = allows(lines.line(), flag, code);
  const bool within = is_indented(lines.line());
  if (!goes_on(lines, flag, code, allowed) || allowed || !within) return allowed;
  if (!to_statement(lines)) return false;
  allowed = allows(lines.line(), flag, code);
  static_cast<void>(goes_on(lines, flag, code, allowed));
  return allowed;
}

source::Sources::Line line_to_allow(const source::Sources& sources, source::Span at) {
  Upwards lines(sources, at);
  const source::Sources::Line own = lines.here();
  if (!to_statement(lines)) return own;
  const std::string_view head = lines.line(), code = source::trimmed(head.substr(0, head.find('#')));
  return code.ends_with('{') ? own : lines.here();
}

}  // namespace kb::diagnostics
