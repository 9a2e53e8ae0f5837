#include "tools/kbc/lsp/roots.h"

#include <algorithm>
#include <filesystem>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"

namespace kb::lsp {
namespace {

namespace fs = std::filesystem;

/// A folder with more knowledge bases is a collection and not a project, and nobody would wait until more entries have been read.
constexpr std::size_t kMostNeighbours = 200, kMostEntries = 20'000;

/// False if there are too many files.
bool add_files(const fs::path& folder, bool deep, std::size_t& entries, std::set<std::string>& out) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (++entries > kMostEntries || out.size() > kMostNeighbours) return false;
    if (at->path().extension() == ".kb" && at->is_regular_file(ignored)) out.insert(at->path().string());
    const bool folder_of_project = deep && !at->path().filename().string().starts_with('.') && at->is_directory(ignored) && !at->is_symlink(ignored);
    if (folder_of_project && !add_files(at->path(), deep, entries, out)) return false;
  }
  return out.size() <= kMostNeighbours;
}

/// The lines that may contain an import, each with the next line. The others do not matter here.
std::string lines_of_imports(std::string_view text) {
  std::string out;
  for (std::size_t done = 0, at = text.find("import"); at != std::string_view::npos; at = text.find("import", done)) {
    const std::size_t begin = std::max(done, text.rfind('\n', at) + 1), end = std::min(text.find('\n', at), text.size() - 1);
    done = std::min(text.find('\n', end + 1), text.size());
    out.append(text.substr(begin, done - begin)).append("\n");
  }
  return out;
}

}  // namespace

std::string imported_file(const syntax::Import& import, const std::string& importer, const OpenFiles& files, const std::string& library) {
  if (import.path.empty()) return {};
  if (import.quoted) return files.canonical((fs::path(importer).parent_path() / import.path).string());
  std::string path(import.path);
  std::ranges::replace(path, '.', '/');
  return files.canonical(library + "/" + path + ".kb");
}

const std::set<std::string>& Imports::files_in(const std::string& folder, bool deep) {
  const auto [at, fresh] = files_in_.try_emplace({folder, deep});
  std::size_t entries = 0;
  if (fresh && !add_files(folder, deep, entries, at->second)) at->second.clear();
  return at->second;
}

const std::set<std::string>& Imports::direct(const std::string& path) {
  const auto [at, fresh] = direct_.try_emplace(path);
  const auto read = fresh ? files_.read(path) : source::FileSystem::Result{};
  if (!read.bytes) return at->second;
  source::Sources sources;
  diagnostics::CountingConsumer nobody;
  diagnostics::Diagnostics diagnostics(sources, nobody);
  const syntax::Tree tree = syntax::parse(sources, sources.add(path, lines_of_imports(*read.bytes)), diagnostics);
  for (const syntax::Statement& statement : tree.statements) {
    if (const auto* import = std::get_if<syntax::Import>(&statement.node)) at->second.insert(imported_file(*import, path, files_, library_));
  }
  return at->second;
}

/// All files that it imports, directly or not.
std::set<std::string> Imports::parts_of(const std::string& path) {
  std::set<std::string> out;
  std::vector<std::string> open{path};
  while (!open.empty()) {
    const std::string next = std::move(open.back());
    open.pop_back();
    for (const std::string& part : direct(next)) {
      if (out.insert(part).second) open.push_back(part);
    }
  }
  return out;
}

std::vector<std::string> Imports::roots_of(const std::string& path) {
  std::set<std::string> candidates = known_;
  for (const auto& [open, text] : files_.texts()) candidates.insert(open);
  const fs::path folder = fs::path(path).parent_path();
  for (const std::string& one : {folder.string(), folder.parent_path().string()}) candidates.insert(files_in(one, false).begin(), files_in(one, false).end());
  for (const std::string& one : folders_) {
    if (path.starts_with(one + "/")) candidates.insert(files_in(one, true).begin(), files_in(one, true).end());
  }
  std::map<std::string, std::set<std::string>> importers;
  for (const std::string& other : candidates) {
    std::set<std::string> parts = parts_of(other);
    if (parts.contains(path)) importers[other] = std::move(parts);
  }
  std::vector<std::string> roots;
  for (const auto& importer : importers) {
    const std::string& root = importer.first;
    const bool imported = std::ranges::any_of(importers, [&](const auto& other) { return other.first != root && other.second.contains(root); });
    if (!imported) roots.push_back(root);
  }
  if (roots.empty()) roots.push_back(path);
  return roots;
}

}  // namespace kb::lsp
