#include "tools/kbc/trace/test_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>

#include "compiler/source/reason.h"
#include "compiler/source/utf8.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/folders.h"
#include "tools/kbc/trace/glob.h"
#include "tools/kbc/trace/stream.h"

namespace kb::trace {
namespace {

namespace fs = std::filesystem;
using diagnostics::Kind;

constexpr std::string_view kFacts = ".facts.csv", kReadings = ".readings.csv", kTrace = ".trace.jsonl", kProgram = ".kb";

std::string without(const std::string& path, std::string_view ending) {
  return path.substr(0, path.size() - ending.size());
}

bool is_case(const std::string& path) { return path.ends_with(kFacts) || path.ends_with(kReadings); }
std::string name_of_case(const std::string& path) { return without(path, path.ends_with(kFacts) ? kFacts : kReadings); }

// The path that `root` means: for a case named as `kbc test` prints it, its recording.
std::string meant_by(const std::string& root) {
  std::error_code failed;
  for (const std::string_view ending : {std::string_view(), kFacts, kReadings}) {
    if (const std::string path = root + std::string(ending); fs::exists(path, failed)) return path;
  }
  return root;
}

std::vector<std::string> programs_beside(const fs::path& facts) {
  std::vector<std::string> programs;
  std::error_code failed;
  const fs::path folder = facts.has_parent_path() ? facts.parent_path() : fs::path(".");
  for (fs::directory_iterator at(folder, failed); !failed && at != fs::directory_iterator(); at.increment(failed))
    if (at->path().extension() == kProgram) programs.push_back(tidy_path(at->path()));
  std::sort(programs.begin(), programs.end());
  return programs;
}

// The knowledge base of a case: the one that its facts name, the one of the same name, or the only one.
std::string program_of(const std::string& facts, diagnostics::Diagnostics& diagnostics) {
  std::string error;
  if (const auto stream = open_stream(facts, error)) {
    if (const std::string named = peek_options(*stream).program; !named.empty())
      return tidy_path(fs::path(facts).parent_path() / named);
  }
  const std::vector<std::string> programs = programs_beside(facts);
  std::string same = name_of_case(facts) + std::string(kProgram);
  if (std::find(programs.begin(), programs.end(), same) != programs.end()) return same;
  if (programs.size() == 1) return programs.front();
  diagnostics.report(Kind::kTestWhichProgram, {}, {facts, fmt::format("{}", programs.size())});
  return {};
}

// The place where the facts name their knowledge base; unknown if they do not.
source::Span place_of_name(const std::string& facts, source::Sources& sources) {
  std::string error;
  const auto stream = open_stream(facts, error);
  if (!stream) return {};
  source::Span place;
  static_cast<void>(peek_options(*stream, [&](const LineReader::Line& line, const OptionItem& item) {
    if (item.names_program) place = excerpt(sources, facts, line, item.begin, item.end);
  }));
  return place;
}

// Searches the roots and what is below them for cases that a filter names.
struct Search {
  const std::vector<std::string>& filters;
  diagnostics::Diagnostics& diagnostics;
  std::vector<TestCase> cases = {};
  std::vector<std::string> names = {};   // of all cases, also of those that no filter names

  [[nodiscard]] bool wanted(const std::string& name) const {
    return filters.empty() || std::any_of(filters.begin(), filters.end(), [&](const std::string& filter) { return names_case(filter, name); });
  }

  void add_case(const std::string& facts) {
    const std::string name = names.emplace_back(name_of_case(facts));
    if (!wanted(name)) return;
    const std::string program = program_of(facts, diagnostics);
    if (!program.empty()) cases.push_back({name, facts, name + std::string(kTrace), program, facts.ends_with(kReadings)});
  }

  void add_folder(const std::string& root) {
    const auto [files, unreadable, why] = files_below(root);
    if (why) diagnostics.report(Kind::kFolderUnreadable, {}, {unreadable, source::reason(why.value())});
    const auto there = [&files = files](const std::string& path) { return std::binary_search(files.begin(), files.end(), path); };
    const std::size_t before = names.size();
    for (const std::string& file : files) {
      if (is_case(file)) {
        add_case(file);
      } else if (file.ends_with(kTrace) && wanted(without(file, kTrace))) {
        const std::string facts = without(file, kTrace) + std::string(kFacts);
        if (!there(facts) && !there(without(file, kTrace) + std::string(kReadings))) diagnostics.report(Kind::kTestOrphan, {}, {file, facts});
      }
    }
    if (names.size() == before && !why) diagnostics.report(Kind::kTestNoCases, {}, {root});
  }

  void add(const std::string& root) {
    std::error_code failed;
    if (fs::is_directory(root, failed)) {
      add_folder(root);
    } else if (!fs::exists(root, failed)) {
      diagnostics.report(Kind::kCannotRead, {}, {root, "no such file or folder"});
    } else if (is_case(root)) {
      add_case(tidy_path(root));
    } else {
      diagnostics.report(Kind::kTestNoCases, {}, {root});
    }
  }

  // With a filter that names no case, a run would succeed although it tests less than was meant.
  void report_vain_filters() const {
    for (const std::string& filter : filters) {
      const auto named_by = [&](const std::string& pattern) {
        return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return names_case(pattern, name); });
      };
      if (names.empty() || named_by(filter)) continue;
      auto report = diagnostics.report(Kind::kTestNoneNamed, {}, {filter});
      if (const std::string wider = "*" + filter + "*"; named_by(wider)) report.suggest(wider);
      else report.suggest(diagnostics::closest(filter, last_names()));
    }
  }

 private:
  // A pattern matches a whole name, or the part after one of its `/`.
  static bool names_case(std::string_view pattern, std::string_view name) {
    for (;;) {
      if (matches_glob(pattern, name)) return true;
      const std::size_t slash = name.find('/');
      if (slash == std::string_view::npos) return false;
      name.remove_prefix(slash + 1);
    }
  }
  [[nodiscard]] std::vector<std::string_view> last_names() const {
    std::vector<std::string_view> last;
    for (const std::string_view name : names) last.push_back(name.substr(name.rfind('/') + 1));
    return last;
  }
};

// A case that is named twice is run once. Of two recordings with the same name, which would share a trace, only the first is run (reported).
void take_each_once(std::vector<TestCase>& cases, diagnostics::Diagnostics& diagnostics) {
  std::map<std::string, std::string> facts_of;   // by the trace
  std::erase_if(cases, [&](const TestCase& test) {
    const auto [known, fresh] = facts_of.emplace(test.trace, test.facts);
    if (known->second != test.facts) diagnostics.report(Kind::kTestOneTrace, {}, {known->second, test.facts, test.trace});
    return !fresh;
  });
}

}  // namespace

std::vector<TestCase> find_cases(const std::vector<std::string>& roots, const std::vector<std::string>& filters, diagnostics::Diagnostics& diagnostics) {
  Search search{filters, diagnostics};
  for (const std::string& root : roots) search.add(meant_by(root));
  search.report_vain_filters();
  std::vector<TestCase> cases = std::move(search.cases);
  const auto order = [](const TestCase& test) { return std::tie(test.program, test.name, test.facts); };
  std::sort(cases.begin(), cases.end(), [&](const TestCase& a, const TestCase& b) { return order(a) < order(b); });
  take_each_once(cases, diagnostics);
  return cases;
}

bool program_is_there(const TestCase& test, source::Sources& sources, diagnostics::Diagnostics& diagnostics) {
  std::string error;
  if (open_stream(test.program, error)) return true;
  const source::Span named = place_of_name(test.facts, sources);
  auto report = diagnostics.report(Kind::kCannotRead, named, {test.program, error});
  if (named.known()) report.note(Kind::kTestProgramNamed, {});
  return false;
}

std::string print_junit(const std::vector<TestCase>& cases, const std::vector<CaseResult>& results) {
  std::size_t failures = 0, errors = 0;
  std::string body;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const fs::path path(cases[i].name);
    body +=
        fmt::format("    <testcase classname=\"{}\" name=\"{}\"", source::escape_markup(path.parent_path().generic_string()),
                    source::escape_markup(path.filename().generic_string()));
    if (results[i].outcome == CaseResult::Outcome::kFailed) {
      ++failures;
      body += fmt::format(">\n      <failure message=\"the trace differs\">{}</failure>\n    </testcase>\n",
                          source::escape_markup(results[i].report));
    } else if (results[i].outcome == CaseResult::Outcome::kBroken) {
      ++errors;
      body += fmt::format(">\n      <error message=\"the case could not be run\">{}</error>\n    </testcase>\n",
                          source::escape_markup(results[i].report));
    } else {
      body += "/>\n";
    }
  }
  const std::string counts = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", cases.size(), failures, errors);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite name=\"kbc test\" {0}>\n{1}  "
      "</testsuite>\n</testsuites>\n",
      counts, body);
}

}  // namespace kb::trace
