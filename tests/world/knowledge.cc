#include "tests/world/knowledge.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "compiler/diagnostics/consumers.h"

namespace kb::world {
namespace {

constexpr std::string_view kLibrary = "stdlib_rules";

/// The standard library, read from disk once.
const source::MemoryFileSystem& library_files() {
  static const source::MemoryFileSystem files = [] {
    source::MemoryFileSystem read;
    const std::string folder = std::string(kLibrary) + "/std";
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(project_path(folder))) {
      if (entry.path().extension() == ".kb") names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) read.add(folder + "/" + name, project_file(folder + "/" + name));
    return read;
  }();
  return files;
}

std::unique_ptr<driver::Compilation> compile(std::string_view path, const source::FileSystem& files,
                                             std::string library) {
  driver::Options options;
  options.library = std::move(library);
  options.analyse = false;
  std::string said;
  auto compilation = driver::compile(path, files, options, diagnostics::ErrorLines::make, &said);
  if (!compilation->ok()) throw DoesNotCompile(said);
  return compilation;
}

std::string_view landmark_name(const model::Model& model, const model::Row& row, std::string_view field) {
  return model.row_in(row, field)->name;
}

}  // namespace

std::string project_path(std::string_view path) { return std::string(KB_PROJECT_ROOT "/").append(path); }

std::string project_file(std::string_view path) {
  std::ifstream in(project_path(path), std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + std::string(path));
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

Knowledge::Knowledge(std::string text, std::unique_ptr<driver::Compilation> compilation)
    : text_(std::move(text)), compilation_(std::move(compilation)) {
  const auto& cells = compilation_->program.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) cells_.emplace(cells[i].name, static_cast<program::CellId>(i));
}

std::shared_ptr<const Knowledge> Knowledge::of_text(std::string_view text) {
  source::MemoryFileSystem files = library_files();
  files.add("mission.kb", std::string(text));
  return std::shared_ptr<const Knowledge>(
      new Knowledge(std::string(text), compile("mission.kb", files, std::string(kLibrary))));
}

std::shared_ptr<const Knowledge> Knowledge::cached(const std::string& text) {
  static std::map<std::string, std::shared_ptr<const Knowledge>> known;
  auto& knowledge = known[text];
  if (!knowledge) knowledge = of_text(text);
  return knowledge;
}

std::shared_ptr<const Knowledge> Knowledge::of_file(std::string_view path) {
  const source::RealFileSystem files;
  return std::shared_ptr<const Knowledge>(
      new Knowledge(project_file(path), compile(project_path(path), files, project_path(kLibrary))));
}

program::CellId Knowledge::find(std::string_view cell_name) const {
  const auto found = cells_.find(cell_name);
  return found == cells_.end() ? program::CellId::kNone : found->second;
}

program::CellId Knowledge::cell(std::string_view cell_name) const {
  const program::CellId found = find(cell_name);
  if (found == program::CellId::kNone) throw std::out_of_range("no cell " + std::string(cell_name));
  return found;
}

std::vector<program::CellId> Knowledge::group(std::string_view group_name, bool own_satellites) const {
  std::vector<program::CellId> cells;
  for (const model::Group& group : model().groups) {
    if (group.name != group_name) continue;
    for (const model::CellId id : group.cells) cells.push_back(cell((own_satellites ? "sat " : "") + std::string(model()[id].name)));
  }
  return cells;
}

std::vector<program::CellId> Knowledge::rows(std::string_view relation) const {
  std::vector<program::CellId> cells;
  for (const model::RowId row : model().rows_of(relation)) {
    if (model()[row].cell != model::CellId::kNone) cells.push_back(cell(model()[model()[row].cell].name));
  }
  return cells;
}

std::string_view Knowledge::name(program::CellId id) const {
  return id == program::CellId::kNone ? std::string_view("-") : std::string_view(program()[id].name);
}

Map map_of(const model::Model& model, double length_m) {
  Map map;
  for (const model::Map& declared : model.maps) {
    for (const model::RowId id : declared.landmarks) map.add_landmark(std::string(model[id].name));
  }
  for (const model::Map& declared : model.maps) {
    for (std::size_t i = 0; i < declared.roads.size(); ++i) {
      const bool second_half = i > 0 && declared.roads[i].road == declared.roads[i - 1].road;
      if (second_half) continue;
      const bool one_way = i + 1 == declared.roads.size() || declared.roads[i + 1].road != declared.roads[i].road;
      const model::Row& row = model[declared.roads[i].row];
      map.add_road(map.landmark(landmark_name(model, row, "from")),
                   find<Direction>(kDirectionNames, model.member_in(row, "exit")).value(),
                   map.landmark(landmark_name(model, row, "to")),
                   find<Direction>(kDirectionNames, model.member_in(row, "approach")).value(), one_way,
                   find<Method>(kMethodNames, model.member_in(row, "by")).value_or(Method::kMark), length_m);
    }
  }
  return map;
}

}  // namespace kb::world
