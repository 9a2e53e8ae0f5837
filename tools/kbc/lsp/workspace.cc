#include "tools/kbc/lsp/workspace.h"

#include <algorithm>

#include "compiler/diagnostics/place.h"
#include "sim/mind/control_words.h"
#include "tools/kbc/lsp/roots.h"

namespace kb::lsp {
namespace {

using Messages = std::vector<diagnostics::Diagnostic>;

class Keeper final : public diagnostics::Consumer {
 public:
  explicit Keeper(Messages& to) : to_(to) {}
  void consume(const diagnostics::Diagnostic& diagnostic) override { to_.push_back(diagnostic); }
  [[nodiscard]] static std::unique_ptr<Consumer> make(const source::Sources&, void* to) { return std::make_unique<Keeper>(*static_cast<Messages*>(to)); }

 private:
  Messages& to_;
};

}  // namespace

std::optional<source::FileId> Knowledge::file(std::string_view path) const {
  const auto at = std::ranges::find(paths, path);
  return at == paths.end() ? std::nullopt : std::optional(source::FileId{static_cast<std::uint32_t>(at - paths.begin())});
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
  for (const auto& [path, text] : files_.texts()) {
    roots_[path] = roots_of(path, files_, library_);
    stale_.insert(roots_[path].begin(), roots_[path].end());
  }
  forget_unused();
}

/// All knowledge bases that the file is part of, or was when they were compiled.
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
  std::erase_if(named_, [&](const auto& one) { return unused(one.first); });
  std::erase_if(stale_, unused);
}

void Workspace::compile() {
  for (const std::string& root : std::exchange(stale_, {})) {
    if (const auto before = now_.find(root); before != now_.end() && !before->second.names.empty()) named_[root] = std::move(before->second);
    now_[root] = compiled(root, files_);
    if (!now_[root].names.empty()) named_.erase(root);
  }
}

std::string Workspace::uri(const std::string& path) const {
  const auto open = uris_.find(path);
  return open == uris_.end() ? diagnostics::uri(path) : open->second;
}

const Knowledge* Workspace::of(const std::string& path) const {
  const auto open = roots_.find(path);
  if (open == roots_.end()) return nullptr;
  for (const auto* known : {&now_, &named_}) {
    const auto at = known->find(open->second.front());
    if (at != known->end() && !at->second.names.empty()) return &at->second;
  }
  return nullptr;
}

std::optional<std::int64_t> Workspace::version(const std::string& path) const {
  const auto open = versions_.find(path);
  return open == versions_.end() ? std::nullopt : std::optional(open->second);
}

std::vector<std::string> Workspace::roots(const std::string& path) const { return roots_of(path, files_, library_); }

Knowledge Workspace::compiled(const std::string& path, const OpenFiles& files) const {
  Knowledge out;
  const driver::Options options{.library = library_, .warnings = warnings_, .known = sim::controller_arguments(), .until = driver::Stage::kAnalysis};
  out.compiled = driver::compile(path, files, options, &Keeper::make, &out.messages);
  const source::Sources& sources = out.compiled->sources;
  for (std::uint32_t i = 0; i < sources.size(); ++i) out.paths.push_back(files.canonical(sources.path(source::FileId{i})));
  if (out.compiled->ok()) {   // as `kbc check` does
    Keeper keeper(out.messages);
    diagnostics::Diagnostics messages(sources, keeper, warnings_);
    sim::check_controls(out.compiled->program, messages);
  }
  out.names = model::known_names(out.compiled->model);
  return out;
}

}  // namespace kb::lsp
