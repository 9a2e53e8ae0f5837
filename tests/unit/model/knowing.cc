#include "tests/unit/model/knowing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tests/unit/whole_file.h"

namespace kb::model::testing {
namespace {

const std::vector<std::pair<std::string, std::string>>& library() {
  static const auto files = [] {
    std::vector<std::pair<std::string, std::string>> read;
    for (const auto& entry : std::filesystem::directory_iterator(KB_PROJECT_ROOT "/stdlib_rules/std")) {
      read.emplace_back("library/std/" + entry.path().filename().string(), whole_file(entry.path()));
    }
    return read;
  }();
  return files;
}

template <class Items, class Name>
auto find(const Items& items, Name name) -> decltype(&items.front()) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::string labyrinth() { return whole_file(KB_PROJECT_ROOT "/examples/01_route1/labyrinth.kb"); }

void Listener::consume(const diagnostics::Diagnostic& diagnostic) {
  kinds_.push_back(diagnostic.kind);
  said_ += fmt::format("{}: {} {}", sources_.describe(diagnostic.span), diagnostics::code_text(diagnostic.kind), diagnostic.message);
  if (!diagnostic.suggestion.empty()) said_ += " -> " + diagnostic.suggestion;
  said_ += '\n';
  for (const diagnostics::Note& note : diagnostic.notes) said_ += fmt::format("  {}: {}\n", sources_.describe(note.span), note.text);
}

Known::Known(std::string text, std::vector<std::pair<std::string, std::string>> others) {
  source::MemoryFileSystem files;
  for (const auto& [name, bytes] : library()) files.add(name, bytes);
  for (auto& [name, bytes] : others) files.add(name, std::move(bytes));
  files.add("main.kb", std::move(text));
  diagnostics::Diagnostics diagnostics(sources_, listener_);
  forest_ = load("main.kb", "library", files, sources_, diagnostics);
  model_ = resolve(forest_, diagnostics);
}

bool Known::said(diagnostics::Kind kind) const {
  return std::find(listener_.kinds().begin(), listener_.kinds().end(), kind) != listener_.kinds().end();
}

bool Known::said_only(diagnostics::Kind kind) const {
  return !listener_.kinds().empty() && std::all_of(listener_.kinds().begin(), listener_.kinds().end(), [kind](auto k) { return k == kind; });
}

const Cell* Known::cell(std::string_view name) const { return find(model_.cells, name); }
const Rule* Known::rule(std::string_view name) const { return find(model_.rules, name); }
const Row* Known::row(std::string_view name) const { return find(model_.rows, name); }

std::vector<std::string> Known::rows(std::string_view relation) const {
  std::vector<std::string> out;
  if (const Relation* found = find(model_.relations, relation)) {
    for (const RowId id : found->rows) out.emplace_back(model_[id].name);
  }
  return out;
}

std::size_t Known::instances(std::string_view rule) const {
  return static_cast<std::size_t>(std::count_if(model_.rules.begin(), model_.rules.end(), [&](const Rule& one) {
    return model_.templates[index(one.tmpl)].name == rule;
  }));
}

std::string Known::names(std::span<const CellId> cells) const {
  std::string out;
  for (const CellId id : cells) out.append(out.empty() ? "" : " ").append(model_[id].name);
  return out;
}

std::string Known::words(CondId id) const {
  const Cond& cond = model_[id];
  std::string parts;
  for (const CondId child : cond.children) parts += (parts.empty() ? "" : " ") + words(child);
  switch (cond.op) {
    case Cond::Op::kAnd: return "and(" + parts + ")";
    case Cond::Op::kOr: return "or(" + parts + ")";
    case Cond::Op::kNot: return "not(" + parts + ")";
    case Cond::Op::kFor: return fmt::format("for({} {})", parts, cond.duration_us);
    case Cond::Op::kEvent: return "event:" + std::string(model_[cond.cell].name);
    case Cond::Op::kLost: return "lost:" + std::string(model_[cond.cell].name);
    case Cond::Op::kSeen: return "seen:" + std::string(model_[cond.cell].name);
    case Cond::Op::kIs: break;
  }
  const std::string term = cond.term == syntax::Term::kHigh ? "" : cond.term == syntax::Term::kLow ? ":low" : ":zero";
  return std::string(model_[cond.cell].name) + term;
}

std::string Known::condition(std::string_view name) const {
  const Rule* found = rule(name);
  return found == nullptr ? "no such rule" : words(found->condition);
}

std::string Known::effects(std::string_view name) const {
  const Rule* found = rule(name);
  if (found == nullptr) return "no such rule";
  std::string out;
  for (const Write& write : found->effects) {
    out += out.empty() ? "" : ", ";
    out += write.reset ? std::string("reset") : fmt::format("{}={}", model_[write.cell].name, write.value);
  }
  return out;
}

std::string Known::field(std::string_view row_name, std::string_view name) const {
  const Row* found = row(row_name);
  if (found == nullptr) return "no such row";
  const Value* value = model_.field(*found, name);
  if (value == nullptr) return "no such field";
  if (const auto* other = std::get_if<RowId>(value)) return std::string(model_[*other].name);
  if (const auto* of = std::get_if<CellId>(value)) return std::string(model_[*of].name);
  if (const auto* member = std::get_if<Member>(value)) return model_.sets[index(member->set)].members[member->index];
  if (const auto* kept = std::get_if<KeptId>(value)) return model_[*kept].is_resolved ? words(model_[*kept].resolved) : "unresolved";
  if (const auto* point = std::get_if<PointId>(value)) return fmt::format("({}, {})", model_[*point].x, model_[*point].y);
  return "missing";
}

}  // namespace kb::model::testing
