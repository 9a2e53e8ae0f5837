#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/explanations.h"

namespace kb::diagnostics {
namespace {

struct Declared { std::string_view family, name; unsigned code; std::string_view text; };

// Every kind with the file that it stands in.
const std::vector<Declared>& all() {
  static const std::vector<Declared> kinds = {
#define KB_NOTE(name, text) {kFamily, #name, 0, text},
#define KB_ERROR(name, code, text) {kFamily, #name, code, text},
#define KB_WARNING(name, code, flag, text) {kFamily, #name, code, text},
#define kFamily "lexis"
#include "compiler/diagnostics/kinds_lexis.def"
#undef kFamily
#define kFamily "syntax"
#include "compiler/diagnostics/kinds_syntax.def"
#undef kFamily
#define kFamily "model"
#include "compiler/diagnostics/kinds_model.def"
#undef kFamily
#define kFamily "fuzzy"
#include "compiler/diagnostics/kinds_fuzzy.def"
#undef kFamily
#define kFamily "perception"
#include "compiler/diagnostics/kinds_perception.def"
#undef kFamily
#define kFamily "analysis"
#include "compiler/diagnostics/kinds_analysis.def"
#undef kFamily
#define kFamily "files"
#include "compiler/diagnostics/kinds_files.def"
#undef kFamily
#define kFamily "traces"
#include "compiler/diagnostics/kinds_traces.def"
#undef kFamily
#define kFamily "plans"
#include "compiler/diagnostics/kinds_plans.def"
#undef kFamily
#define kFamily "sim"
#include "compiler/diagnostics/kinds_sim.def"
#undef kFamily
#define kFamily "layouts"
#include "compiler/diagnostics/kinds_layouts.def"
#undef kFamily
#undef KB_NOTE
#undef KB_ERROR
#undef KB_WARNING
  };
  return kinds;
}

struct Range { unsigned first, last; };
// See kinds.def. Limits (KB08xx) may stand in any family.
const std::multimap<std::string_view, Range> kRanges = {
    {"lexis", {100, 199}},  {"syntax", {200, 299}},     {"model", {300, 799}}, {"model", {912, 919}},
    {"model", {1050, 1089}}, {"analysis", {1000, 1049}}, {"analysis", {1090, 1099}}, {"fuzzy", {1100, 1159}}, {"perception", {1160, 1199}},
    {"files", {900, 920}}, {"files", {990, 999}}, {"traces", {921, 989}}, {"plans", {1200, 1299}}, {"sim", {1300, 1399}}, {"sim", {1500, 1599}},
    {"layouts", {1400, 1499}}};

bool in_range(const Declared& kind) {
  if (kind.code >= 800 && kind.code <= 899) return true;
  const auto [begin, end] = kRanges.equal_range(kind.family);
  return std::any_of(begin, end, [&](const auto& r) { return kind.code >= r.second.first && kind.code <= r.second.last; });
}

TEST(Kinds, have_a_code_of_their_own_in_the_range_of_their_family) {
  std::map<unsigned, std::string_view> seen;
  for (const Declared& kind : all()) {
    if (kind.code == 0) continue;
    EXPECT_TRUE(in_range(kind)) << kind.name << " " << kind.code << " does not belong to kinds_" << kind.family << ".def";
    const auto [at, fresh] = seen.emplace(kind.code, kind.name);
    EXPECT_TRUE(fresh) << kind.name << " has the code " << kind.code << " of " << at->second;
  }
  EXPECT_EQ(all().size(), static_cast<std::size_t>(Kind::kCount_)) << "kinds.def includes a family that this test does not know";
  EXPECT_GE(seen.size(), 80u);
}

TEST(Kinds, are_worded_in_one_manner) {
  for (const Declared& kind : all()) {
    ASSERT_FALSE(kind.text.empty()) << kind.name;
    const char first = kind.text.front(), last = kind.text.back();
    const bool name = kind.text.size() > 1 && kind.text[1] >= 'A' && kind.text[1] <= 'Z';   // "NUL", "UTF-8"
    EXPECT_FALSE(first >= 'A' && first <= 'Z' && !name) << kind.name << " begins with a capital: " << kind.text;
    EXPECT_FALSE(last == '.' || last == '!' || last == ' ') << kind.name << " ends like a sentence: " << kind.text;
    for (const std::string_view word : {"illegal", "invalid", "Illegal", "Invalid", "please", "  "}) {
      EXPECT_EQ(kind.text.find(word), std::string_view::npos) << kind.name << " says `" << word << "`: " << kind.text;
    }
    EXPECT_EQ(std::count(kind.text.begin(), kind.text.end(), '`') % 2, 0) << kind.name << ": " << kind.text;
  }
}

TEST(Kinds, are_found_by_code_and_by_flag) {
  EXPECT_EQ(find_code("KB0901"), Kind::kCannotRead);
  EXPECT_EQ(find_code("kb901"), Kind::kCannotRead);
  EXPECT_EQ(find_code("0901"), Kind::kCannotRead);
  EXPECT_EQ(find_code("KB"), std::nullopt);
  EXPECT_EQ(find_code("KB0"), std::nullopt) << "notes have no code";
  EXPECT_EQ(find_code("KB0901x"), std::nullopt);
  EXPECT_EQ(find_code(""), std::nullopt);
  EXPECT_EQ(find_flag("never-read"), Kind::kNeverRead);
  EXPECT_EQ(find_flag(""), std::nullopt);
  EXPECT_EQ(code_text(Kind::kCannotRead), "KB0901");
}

TEST(Kinds, name_their_flags_in_lower_case_with_hyphens) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(Kind::kCount_); ++i) {
    const KindInfo& kind = info(static_cast<Kind>(i));
    EXPECT_EQ(kind.flag.empty(), kind.severity != Severity::kWarning) << kind.name;
    EXPECT_EQ(kind.flag.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string_view::npos) << kind.name;
    EXPECT_FALSE(kind.flag.starts_with("no-") && find_flag(kind.flag.substr(3))) << kind.name;
    EXPECT_FALSE(kind.flag.starts_with("error")) << kind.name;
  }
}

// The fenced block that follows a line `title` alone; empty if there is none.
std::string_view example(std::string_view text, std::string_view title) {
  auto at = text.find("\n" + std::string(title) + "\n```");
  if (at == std::string_view::npos) return {};
  at = text.find('\n', at + 1) + 1;
  const auto begin = text.find('\n', at) + 1;
  const auto end = text.find("\n```", begin);
  return end == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin);
}

TEST(Explanations, of_every_error_and_warning_have_a_wrong_and_a_right_example) {
  for (const Declared& declared : all()) {
    if (declared.code == 0) continue;
    const Kind kind = *find_code(std::to_string(declared.code));
    const std::string_view text = explanation(kind);
    if (text.empty()) {
      ADD_FAILURE() << code_text(kind) << " " << declared.name << ": no section in explanations/" << declared.family << ".txt";
      continue;
    }
    EXPECT_FALSE(example(text, "Wrong:").empty()) << code_text(kind) << ": no `Wrong:` with a fenced block";
    EXPECT_FALSE(example(text, "Right:").empty()) << code_text(kind) << ": no `Right:` with a fenced block";
    EXPECT_GT(text.find("Wrong:"), 20u) << code_text(kind) << ": nothing is explained before the examples";
  }
}

TEST(Explanations, belong_to_a_message_that_there_is) {
  std::set<std::string_view> seen;
  for (const std::string_view piece : explanation_pieces()) {
    if (!piece.starts_with("== ")) continue;
    const std::string_view code = piece.substr(3, piece.find('\n') - 3);
    const auto kind = find_code(code);
    EXPECT_TRUE(kind && code_text(*kind) == code) << "`== " << code << "` explains nothing";
    EXPECT_TRUE(seen.insert(code).second) << code << " is explained twice";
  }
}

TEST(Explanations, make_a_page_with_an_entry_for_each_message) {
  const std::string page = print_markdown();
  for (const Declared& kind : all()) {
    if (kind.code == 0) continue;
    EXPECT_NE(page.find("\n### " + code_text(*find_code(std::to_string(kind.code))) + "\n"), std::string::npos) << kind.name;
  }
}

}  // namespace
}  // namespace kb::diagnostics
