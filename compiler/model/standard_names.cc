#include "compiler/model/standard_names.h"

#include <algorithm>
#include <array>
#include <variant>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/draft.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {

using diagnostics::Kind;

std::span<const std::string_view> standard_files() {
  static constexpr std::array kFiles = std::to_array<std::string_view>({
      "std.basics", "std.route",  "std.mission", "std.detour",  "std.crossing", "std.road",       "std.obstacle",
      "std.search", "std.care", "std.retreat", "std.recover", "std.pause", "std.hall", "std.wait", "std.compass8", "std.go_to_goal"});
  return kFiles;
}

std::optional<std::string_view> StandardNames::file_with(std::string_view name) {
  read();
  const auto found = file_of_.find(name);
  return found == file_of_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string_view> StandardNames::file_with_member(std::string_view set, std::string_view member) {
  return file_with(std::string(set) + "." + std::string(member));
}

void StandardNames::read() {
  if (std::exchange(read_, true)) return;
  for (const std::string_view file : standard_files()) {
    std::string path(file);
    std::replace(path.begin(), path.end(), '.', '/');
    source::FileSystem::Result result = files_.read(library_ + "/" + path + ".kb");
    if (!result.bytes) continue;
    source::Sources sources;
    diagnostics::CountingConsumer nobody;
    diagnostics::Diagnostics diagnostics(sources, nobody);
    const syntax::Tree tree = syntax::parse(sources, sources.add(path, std::move(*result.bytes), true), diagnostics);
    for (const syntax::Statement& statement : tree.statements) take(statement, file);
  }
}

void StandardNames::take(const syntax::Statement& statement, std::string_view file) {
  const auto name = [&](const syntax::Name& one) { file_of_.emplace(one.text, file); };
  const auto members = [&](const syntax::Name& set, const std::vector<syntax::Name>& all) {
    for (const syntax::Name& member : all) file_of_.emplace(std::string(set.text) + "." + std::string(member.text), file);
  };
  if (const auto* set = std::get_if<syntax::NameSet>(&statement.node)) {
    if (!set->more) name(set->name);
    members(set->name, set->members);
  } else if (const auto* cells = std::get_if<syntax::Declaration>(&statement.node)) {
    for (const auto& item : cells->items) {
      name(item.name);
      if (item.shape == syntax::Declaration::Item::Shape::kMembers) members(item.name, item.names);
    }
  } else if (const auto* levels = std::get_if<syntax::Levels>(&statement.node)) {
    for (const syntax::Name& level : levels->names) file_of_.emplace(std::string(kLevels) + "." + std::string(level.text), file);
  } else if (const auto* relation = std::get_if<syntax::Relation>(&statement.node)) {
    name(relation->name);
  } else if (const auto* table = std::get_if<syntax::Table>(&statement.node)) {
    if (!table->more) name(table->name);
  } else if (const auto* fuzzy = std::get_if<syntax::Fuzzy>(&statement.node)) {
    name(fuzzy->name);
  }
}

namespace {

void finish(diagnostics::Builder& message, std::optional<std::string_view> file, std::optional<std::string> nearest) {
  if (file) message.note(Kind::kImportBrings, {}, {*file});
  else message.suggest(std::move(nearest));
}

}  // namespace

void report_unknown(Draft& draft, Kind kind, const syntax::Name& name, std::optional<std::string> nearest) {
  const bool may = draft.library != nullptr && draft.names.find(name.text) == nullptr;
  auto message = draft.diagnostics.report(kind, name.span, {name.text});
  finish(message, may ? draft.library->file_with(name.text) : std::nullopt, std::move(nearest));
}

void report_unknown_member(Draft& draft, Kind kind, const syntax::Name& name, const MembersOf& of, const Variables& variables) {
  std::optional<std::string> nearest = draft.diagnostics.nearest_of(name.text, [&](auto& candidates) {
    candidates.assign(of.set.members.begin(), of.set.members.end());
    candidates.insert(candidates.end(), variables.names.begin(), variables.names.end());
  });
  if (!nearest && !variables.unused.empty()) nearest = variables.unused;
  const auto file = draft.library != nullptr ? draft.library->file_with_member(of.set.name, name.text) : std::nullopt;
  auto message = draft.diagnostics.report(kind, name.span, {name.text, of.name});
  if (of.declared.known()) message.note(Kind::kNameDeclaredHere, of.declared, {of.name});
  if (!nearest && !file && !variables.rule.empty()) message.note(Kind::kVariableBehindName, {}, {variables.rule, name.text, of.name});
  finish(message, file, std::move(nearest));
}

}  // namespace kb::model
