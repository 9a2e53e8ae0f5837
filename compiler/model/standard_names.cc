#include "compiler/model/standard_names.h"

#include <algorithm>
#include <array>
#include <variant>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/draft.h"
#include "compiler/source/encoding.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {

using diagnostics::Kind;

namespace {

/// Calls `use` with each statement of a file, if it can be read. What is wrong in it is not told here.
template <class Use>
void each_statement(const source::FileSystem& files, const std::string& path, Use use) {
  source::FileSystem::Result result = files.read(path);
  if (!result.bytes) return;
  source::Sources sources;
  diagnostics::CountingConsumer nobody;
  diagnostics::Diagnostics diagnostics(sources, nobody);
  const syntax::Tree tree = syntax::parse(sources, sources.add(path, std::move(*result.bytes), true), diagnostics);
  for (const syntax::Statement& statement : tree.statements) use(statement);
}

}  // namespace

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
    each_statement(files_, path_of(file), [&](const syntax::Statement& statement) { take(statement, file); });
  }
}

std::string StandardNames::path_of(std::string_view file) const {
  std::string path(file);
  std::replace(path.begin(), path.end(), '.', '/');
  return library_ + "/" + path + ".kb";
}

bool StandardNames::navigation_brings(std::string_view file) {
  if (navigation_.empty()) add_imports("std.navigation");
  return navigation_.contains(file);
}

void StandardNames::add_imports(std::string_view file) {
  if (!navigation_.emplace(file).second) return;
  each_statement(files_, path_of(file), [&](const syntax::Statement& statement) {
    const auto* import = std::get_if<syntax::Import>(&statement.node);
    if (import != nullptr && !import->quoted) add_imports(import->path);
  });
}

std::optional<std::string> StandardNames::map_beside(std::string_view path, std::string_view name) {
  const std::string folder(path.substr(0, path.rfind('/') + 1));   // npos + 1 is 0
  const std::string map = folder + std::string(kMapFile);
  if (map == path) return std::nullopt;
  const auto [names, first] = beside_.try_emplace(folder);
  auto& known = names->second;
  if (first) {
    each_statement(files_, map, [&known](const syntax::Statement& statement) {
      const auto* found = std::get_if<syntax::Map>(&statement.node);
      if (found == nullptr) return;
      known.emplace(found->name.text);
      for (const syntax::Landmark& landmark : found->landmarks) known.emplace(landmark.name.text);
    });
  }
  if (!known.contains(name)) return std::nullopt;
  return "\"" + std::string(kMapFile) + "\"";
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

/// `N` for `North`, if the exits have such short names.
std::optional<std::string> abbreviated_direction(std::string_view written, const std::vector<std::string>& members) {
  constexpr std::string_view kDirections[] = {"north", "east", "south", "west"};
  if (std::ranges::count(kDirections, source::lower(std::string(written))) == 0) return std::nullopt;
  const auto short_name = std::ranges::find_if(members, [&](const std::string& member) {
    return member.size() == 1 && source::lower(member.front()) == source::lower(written.front());
  });
  return short_name == members.end() ? std::nullopt : std::optional(*short_name);
}

}  // namespace

void report_unknown(Draft& draft, Kind kind, const syntax::Name& name, std::optional<std::string> nearest) {
  const bool may = draft.library != nullptr && draft.names.find(name.text) == nullptr;
  const auto file = may ? draft.library->file_with(name.text) : std::nullopt;
  if (file && draft.library_missing && draft.library->navigation_brings(*file)) return;   // and that import was asked for
  const auto beside = may && !file ? draft.library->map_beside(draft.diagnostics.sources().path(name.span.file), name.text) : std::nullopt;
  auto message = draft.diagnostics.report(kind, name.span, {name.text});
  if (beside) message.note(Kind::kImportBrings, {}, {*beside});
  else finish(message, file, std::move(nearest));
}

void report_unknown_member(Draft& draft, Kind kind, const syntax::Name& name, const MembersOf& of, const Variables& variables) {
  std::optional<std::string> nearest = draft.diagnostics.nearest_of(name.text, [&](auto& candidates) {
    candidates.assign(of.set.members.begin(), of.set.members.end());
    candidates.insert(candidates.end(), variables.names.begin(), variables.names.end());
  });
  if (!nearest && !variables.unused.empty()) nearest = variables.unused;
  const auto file = draft.library != nullptr ? draft.library->file_with_member(of.set.name, name.text) : std::nullopt;
  if (!nearest && !file) nearest = abbreviated_direction(name.text, of.set.members);
  auto message = draft.diagnostics.report(kind, name.span, {name.text, of.name});
  if (of.declared.known()) message.note(Kind::kNameDeclaredHere, of.declared, {of.name});
  if (!nearest && !file && !variables.rule.empty()) message.note(Kind::kVariableBehindName, {}, {variables.rule, name.text, of.name});
  finish(message, file, std::move(nearest));
}

}  // namespace kb::model
