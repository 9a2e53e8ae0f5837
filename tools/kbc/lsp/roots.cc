#include "tools/kbc/lsp/roots.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/model.h"

namespace kb::lsp {
namespace {

namespace fs = std::filesystem;

/// Folders of more knowledge bases are collections, not projects.
constexpr std::size_t kMostNeighbours = 200;

void add_folder(const fs::path& folder, std::set<std::string>& out) {
  std::error_code error;
  std::vector<std::string> found;
  for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (at->path().extension() == ".kb" && at->is_regular_file(ignored)) found.push_back(at->path().string());
    if (found.size() > kMostNeighbours) return;
  }
  out.insert(found.begin(), found.end());
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

/// Those in whose text the name of `path` stands, or that of another such file.
std::vector<std::string> may_import(const std::string& path, const std::set<std::string>& candidates, const OpenFiles& files) {
  std::map<std::string, std::string> others;
  for (const std::string& other : candidates) {
    if (auto read = files.read(other); read.bytes && other != path) others[other] = std::move(*read.bytes);
  }
  std::vector<std::string> out, names{file_name(path)};
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::erase_if(others, [&](const auto& other) {
      if (other.second.find(names[i]) == std::string::npos) return false;
      out.push_back(other.first);
      names.push_back(file_name(other.first));
      return true;
    });
  }
  return out;
}

/// The file and all that it imports.
std::set<std::string> parts_of(const std::string& path, const OpenFiles& files, const std::string& library) {
  source::Sources sources;
  diagnostics::CountingConsumer nobody;
  diagnostics::Diagnostics diagnostics(sources, nobody);
  static_cast<void>(model::load(path, library, files, sources, diagnostics));
  std::set<std::string> out;
  for (std::size_t i = 0; i < sources.size(); ++i) out.insert(files.canonical(sources.path(source::FileId{static_cast<std::uint32_t>(i)})));
  return out;
}

}  // namespace

std::vector<std::string> roots_of(const std::string& path, const OpenFiles& files, const std::string& library) {
  std::set<std::string> candidates;
  for (const auto& [open, text] : files.texts()) candidates.insert(open);
  const fs::path folder = fs::path(path).parent_path();
  add_folder(folder, candidates);
  add_folder(folder.parent_path(), candidates);

  std::map<std::string, std::set<std::string>> importers;
  for (const std::string& other : may_import(path, candidates, files)) {
    std::set<std::string> parts = parts_of(other, files, library);
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
