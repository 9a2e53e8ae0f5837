#include "tools/kbc/trace/cell_names.h"

#include <algorithm>

#include "compiler/diagnostics/diagnostics.h"
#include "tools/kbc/trace/glob.h"

namespace kb::trace {
namespace {

using program::CellId;
using program::RuleId;

/// The patterns, which blanks separate. A blank after `sat` does not end a pattern, because `sat X` is one.
std::vector<std::string_view> patterns_of(std::string_view pattern) {
  std::vector<std::string_view> patterns;
  while (!pattern.empty()) {
    std::size_t end = 0;
    while (end < pattern.size() && (pattern[end] != ' ' || pattern.substr(0, end) == "sat")) ++end;
    if (end > 0) patterns.push_back(pattern.substr(0, end));
    pattern.remove_prefix(std::min(end + 1, pattern.size()));
  }
  return patterns;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string out;
  out.reserve(name.size());
  for (const char c : name) {
    if (c == ']') continue;
    if (c == ' ' && (out.empty() || out.back() == '.' || out.back() == ' ')) continue;
    if (c == '[' || c == ',') {
      while (!out.empty() && out.back() == ' ') out.pop_back();
      out += '.';
    } else {
      out += c;
    }
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

CellNames::CellNames(const program::Program& program) : program_(program) {
  cells_.reserve(program.cells.size());
  for (std::size_t i = 0; i < program.cells.size(); ++i)
    cells_.try_emplace(plain_name(program.cells[i].name), static_cast<CellId>(i));
}

CellId CellNames::find(std::string_view name) const {
  const auto found = cells_.find(plain_name(name));
  return found == cells_.end() ? CellId::kNone : found->second;
}

std::optional<std::string> CellNames::closest(std::string_view name, std::optional<program::CellKind> kind) const {
  if (const auto among = members(name, kind); !among.empty()) return std::string(among.front());
  std::vector<std::string_view> candidates;
  for (const program::Cell& cell : program_.cells) {
    if (!kind || cell.kind == *kind) candidates.push_back(cell.name);
  }
  return diagnostics::closest(name, candidates);
}

std::vector<std::string_view> CellNames::members(std::string_view name, std::optional<program::CellKind> kind) const {
  std::vector<std::string_view> found;
  const std::string group = plain_name(name) + ".";
  for (const program::Cell& cell : program_.cells) {
    if (kind && cell.kind != *kind) continue;
    if (plain_name(cell.name).starts_with(group) || matches(name, cell.name)) found.push_back(cell.name);
  }
  return found;
}

std::vector<CellId> find_cells(const program::Program& program, std::string_view names, std::vector<std::string>* vain) {
  const CellNames known(program);
  if (const CellId cell = known.find(names); cell != CellId::kNone) return {cell};   // its name may have blanks: `Near[left, far]`
  std::vector<CellId> found;
  for (const std::string_view one : patterns_of(names)) {
    const CellId cell = known.find(one);
    const std::size_t before = found.size();
    if (cell != CellId::kNone) found.push_back(cell);
    else for (const std::string_view member : known.members(one)) found.push_back(known.find(member));
    if (found.size() == before && vain != nullptr) vain->emplace_back(one);
  }
  source::sort_unique(found);
  return found;
}

std::vector<RuleId> find_rules(const program::Program& program, std::string_view name) {
  const std::string plain = plain_name(name);
  std::vector<RuleId> found;
  for (std::size_t i = 0; i < program.rules.size(); ++i) {
    const program::Rule& rule = program.rules[i];
    if (rule.tmpl() == name || plain_name(rule.name) == plain) found.push_back(static_cast<RuleId>(i));
  }
  return found;
}

std::optional<std::string> closest_rule(const program::Program& program, std::string_view name) {
  std::vector<std::string_view> candidates;
  for (const program::Rule& rule : program.rules) candidates.push_back(rule.tmpl());
  source::sort_unique(candidates);
  if (name.find_first_of("[.") != std::string_view::npos)
    for (const program::Rule& rule : program.rules) candidates.push_back(rule.name);
  return diagnostics::closest(name, candidates);
}

bool matches(std::string_view pattern, std::string_view name) {
  const std::string plain = plain_name(name);
  const std::vector<std::string_view> patterns = patterns_of(pattern);
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](std::string_view one) { return matches_glob(one, name) || matches_glob(plain_name(one), plain); });
}

bool is_named(std::string_view pattern, std::string_view name) {
  const std::string plain = plain_name(name);
  const std::vector<std::string_view> patterns = patterns_of(pattern);
  return std::any_of(patterns.begin(), patterns.end(), [&](std::string_view one) { return plain_name(one) == plain; });
}

std::vector<std::string> vain_patterns(const program::Program& program, std::string_view pattern) {
  std::vector<std::string> vain;
  const std::vector<std::string_view> patterns = patterns_of(pattern);
  if (patterns.empty() && !pattern.empty()) vain.emplace_back(pattern);   // nothing but blanks
  for (const std::string_view one : patterns) {
    if (std::none_of(program.cells.begin(), program.cells.end(), [&](const program::Cell& cell) { return matches(one, cell.name); })) vain.emplace_back(one);
  }
  return vain;
}

std::optional<std::string> meant_by(const program::Program& program, const std::string& pattern) {
  if (const std::string members = pattern + ".*"; vain_patterns(program, members).empty()) return members;
  std::string blanks = pattern;
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  if (blanks != pattern && vain_patterns(program, blanks).empty()) return blanks;
  return CellNames(program).closest(pattern);
}

}  // namespace kb::trace
