#include "tools/kbc/lsp/workspace.h"

#include <algorithm>
#include <iterator>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/place.h"
#include "sim/mind/control_words.h"

namespace kb::lsp {
std::optional<source::FileId> Knowledge::file(std::string_view path) const {
  const auto at = std::ranges::find(paths, path);
  return at == paths.end() ? std::nullopt : std::optional(source::FileId{static_cast<std::uint32_t>(at - paths.begin())});
}

const syntax::Tree* Knowledge::tree(source::FileId file) const {
  const auto tree = std::ranges::find(compiled->forest.trees, file, &syntax::Tree::file);
  return tree == compiled->forest.trees.end() ? nullptr : &*tree;
}

std::span<const syntax::Statement> Knowledge::statements(source::FileId file) const {
  const syntax::Tree* const read = tree(file);
  return read == nullptr ? std::span<const syntax::Statement>() : read->statements;
}

const Use* Knowledge::use_at(source::FileId file, std::uint32_t offset) const {
  const auto begin = [](const Use& use) { return std::pair(use.span.file, use.span.begin); };
  const auto behind = std::ranges::upper_bound(uses, std::pair(file, offset), {}, begin);
  const Use* const use = behind == uses.begin() ? nullptr : &*std::prev(behind);
  return use != nullptr && use->span.file == file && offset <= use->span.end ? use : nullptr;
}

std::vector<Use> Knowledge::same(const Use& use) const {
  const source::Sources& sources = compiled->sources;
  std::vector<Use> out;
  std::ranges::copy_if(uses, std::back_inserter(out), [&](const Use& other) { return other.meaning == use.meaning && sources.text(other.span) == sources.text(use.span); });
  return out;
}

void Workspace::open(const std::string& path, std::string uri, std::string text) {
  uris_[path] = std::move(uri);
  files_.put(path, std::move(text));
  look_again();
}

void Workspace::change(const std::string& path, std::string text) {
  if (!roots_.contains(path)) return;
  files_.put(path, std::move(text));
  mark(path);
}

void Workspace::close(const std::string& path) {
  files_.close(path);
  uris_.erase(path);
  versions_.erase(path);
  roots_.erase(path);
  look_again();
}

void Workspace::look_again() {
  Imports imports(files_, library_, folders_, {});
  for (const auto& [path, text] : files_.texts()) {
    roots_[path] = imports.roots_of(path);
    stale_.insert(roots_[path].begin(), roots_[path].end());
  }
  forget_unused();
}

/// Marks all knowledge bases that contain the file, or contained it when they were compiled.
void Workspace::mark(const std::string& path) {
  stale_.insert(roots_[path].begin(), roots_[path].end());
  for (const auto& [root, knowledge] : now_) {
    if (knowledge.file(path)) stale_.insert(root);
  }
}

void Workspace::forget_unused() {
  const auto unused = [&](const std::string& root) {
    return std::ranges::none_of(roots_, [&](const auto& open) { return std::ranges::find(open.second, root) != open.second.end(); });
  };
  std::erase_if(now_, [&](const auto& one) { return unused(one.first); });
  std::erase_if(stale_, unused);
}

void Workspace::compile() {
  while (!stale_.empty()) {
    const std::string root = *stale_.begin();
    stale_.erase(stale_.begin());
    now_[root] = compiled(root, files_);
    if (stale_.empty()) settle();
  }
  forget_unused();
}

/// Imports may have been added or removed, so open files may belong to other knowledge bases now.
void Workspace::settle() {
  Imports imports = this->imports();
  for (auto& open : roots_) {
    const std::string& path = open.first;
    std::vector<std::string>& roots = open.second;
    const bool settled = std::ranges::all_of(now_, [&](const auto& one) { return one.second.file(path).has_value() == (std::ranges::find(roots, one.first) != roots.end()); });
    if (settled) continue;
    roots = imports.roots_of(path);
    std::erase_if(roots, [&](const std::string& root) { return now_.contains(root) && !now_.at(root).file(path); });   // an import that leads nowhere
    if (roots.empty()) roots.push_back(path);
    std::ranges::copy_if(roots, std::inserter(stale_, stale_.end()), [&](const std::string& root) { return !now_.contains(root); });
  }
}

std::string Workspace::uri(const std::string& path) const {
  const auto open = uris_.find(path);
  return open == uris_.end() ? diagnostics::uri(path) : open->second;
}

const Knowledge* Workspace::of(const std::string& path) const {
  const auto open = roots_.find(path);
  return open == roots_.end() ? nullptr : &now_.at(open->second.front());
}

std::optional<std::int64_t> Workspace::version(const std::string& path) const {
  const auto open = versions_.find(path);
  return open == versions_.end() ? std::nullopt : std::optional(open->second);
}

Imports Workspace::imports() const {
  std::set<std::string> known;
  for (const auto& [root, knowledge] : now_) known.insert(root);
  return {files_, library_, folders_, std::move(known)};
}

Knowledge Workspace::compiled(const std::string& path, const OpenFiles& files) const {
  Knowledge out;
  const driver::Options options{.library = library_, .warnings = warnings_, .known = sim::controller_arguments(), .until = driver::Stage::kAnalysis};
  out.compiled = driver::compile(path, files, options, diagnostics::Keeping::make, &out.messages);
  const source::Sources& sources = out.compiled->sources;
  for (std::uint32_t i = 0; i < sources.size(); ++i) out.paths.push_back(files.canonical(sources.path(source::FileId{i})));
  out.places = Places(sources);
  if (out.compiled->ok()) {   // as `kbc check` does
    diagnostics::Keeping keeping(out.messages);
    diagnostics::Diagnostics messages(sources, keeping, warnings_);
    sim::check_controls(out.compiled->program, messages);
  }
  out.names = model::known_names(out.compiled->model);
  out.uses = lsp::uses(*out.compiled, out.names);
  return out;
}

}  // namespace kb::lsp
