#include <fmt/format.h>

#include <algorithm>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/explanations.h"
#include "compiler/source/encoding.h"

namespace kb::diagnostics {
namespace {

/// All kinds with a code, in the order of the codes.
std::vector<Kind> coded_kinds() {
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Kind::kCount_); ++i) {
    if (info(static_cast<Kind>(i)).code != 0) kinds.push_back(static_cast<Kind>(i));
  }
  std::sort(kinds.begin(), kinds.end(), [](Kind a, Kind b) { return info(a).code < info(b).code; });
  return kinds;
}

struct Family { std::uint16_t first; std::string_view title; };
constexpr Family kFamilies[] = {
    {100, "Bytes and tokens"},
    {200, "Syntax"},
    {300, "Names and declarations"},
    {400, "References and conditions"},
    {500, "Maps and routes"},
    {600, "Rules and effects"},
    {700, "Levels, settings, tables, control"},
    {800, "Limits"},
    {900, "Files, imports, the command line, facts and traces"},
    {1000, "Warnings"},
    {1100, "Perception and fuzzy control"},
    {1200, "Maps and scenarios of planners"},
    {1300, "The simulator"},
    {1400, "Layouts of plants, imported"},
};

}  // namespace

std::string general_text(Kind kind) {
  const std::string_view text = info(kind).text;
  std::string out;
  std::vector<std::string> letters;   // what the placeholders in code are called, by number
  std::size_t automatic = 0, named = 0;
  bool code = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    code = code != (text[at] == '`');
    const bool brace = text[at] == '{' || text[at] == '}';
    const bool placeholder = text[at] == '{' && at + 1 < text.size() && text[at + 1] != '{';
    if (!placeholder) {
      out += text[at];
      at += brace ? 1 : 0;   // it is written twice
      continue;
    }
    const std::size_t end = text.find('}', at);
    const std::size_t number = end == at + 1 ? automatic++ : static_cast<std::size_t>(text[at + 1] - '0');
    letters.resize(std::max(letters.size(), number + 1));
    const bool sign = code && end + 1 < text.size() && text[end + 1] >= 'a' && text[end + 1] <= 'z';   // `{2}sat A`: it may be missing
    if (code && !sign && letters[number].empty()) letters[number] = static_cast<char>('A' + named++);
    if (code) out += letters[number];
    else if (!out.ends_with("...")) out += "...";   // one stand-in for words that follow each other
    at = end;
  }
  return out;
}

std::string_view explanation(Kind kind) {
  if (info(kind).code == 0) return {};
  const std::string title = "== " + code_text(kind) + "\n";
  for (const std::string_view piece : explanation_pieces()) {
    if (piece.starts_with(title)) return source::trimmed(piece.substr(title.size()));
  }
  return {};
}

std::string print_markdown() {
  std::string out =
      "# What kbc says\n\n"
      "Every error and warning of the compiler, by code. This page is printed by `kbc explain --markdown`; `kbc explain "
      "KB0301`\nshows one entry. A warning `-Wname` is switched off by `-Wno-name` and made an error by `-Werror=name`.\n";
  const Family* next = kFamilies;
  for (const Kind kind : coded_kinds()) {
    const KindInfo& about = info(kind);
    const Family* family = nullptr;
    for (; next != std::end(kFamilies) && about.code >= next->first; ++next) family = next;
    if (family != nullptr) fmt::format_to(std::back_inserter(out), "\n## {}\n", family->title);
    fmt::format_to(std::back_inserter(out), "\n### {}\n\n**{}**: {}\n", code_text(kind), word(about.severity), general_text(kind));
    if (!about.flag.empty()) fmt::format_to(std::back_inserter(out), "\nFlag: `-W{}`\n", about.flag);
    const std::string_view text = explanation(kind);
    if (!text.empty()) fmt::format_to(std::back_inserter(out), "\n{}\n", text);
  }
  return out;
}

std::string print_list() {
  std::string out;
  for (const Kind kind : coded_kinds()) {
    const KindInfo& about = info(kind);
    const std::string flag = about.flag.empty() ? "" : fmt::format("  [-W{}]", about.flag);
    fmt::format_to(std::back_inserter(out), "{}  {:<7}  {}{}\n", code_text(kind), word(about.severity), general_text(kind), flag);
  }
  return out;
}

}  // namespace kb::diagnostics
