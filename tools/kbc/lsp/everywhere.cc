#include "tools/kbc/lsp/everywhere.h"

#include <algorithm>
#include <set>

namespace kb::lsp {

std::vector<Use> same_at(const Knowledge& knowledge, const std::string& path, std::uint32_t begin) {
  const auto file = knowledge.file(path);
  const Use* const use = file ? knowledge.use_at(*file, begin) : nullptr;
  return use == nullptr || use->span.begin != begin ? std::vector<Use>() : knowledge.same(*use);
}

std::deque<Standing> everywhere(const Workspace& workspace, const std::string& path, std::uint32_t begin, bool anew) {
  std::deque<Standing> out;   // does not move when one is added
  std::set<std::string> seen;
  Imports imports = workspace.imports();
  const auto add_roots = [&](const std::string& file, std::uint32_t at) {
    if (!seen.insert(file).second) return;
    for (const std::string& root : imports.roots_of(file)) {
      if (std::ranges::find(out, root, &Standing::root) == out.end()) out.push_back({root, file, at, nullptr, nullptr, {}});
    }
  };
  add_roots(path, begin);
  for (std::size_t i = 0; i < out.size(); ++i) {
    Standing& one = out[i];
    const auto known = workspace.all().find(one.root);
    if (anew || known == workspace.all().end()) one.own = std::make_unique<Knowledge>(workspace.compiled(one.root, workspace.files()));
    one.knowledge = one.own ? one.own.get() : &known->second;
    one.uses = same_at(*one.knowledge, one.path, one.begin);
    for (const Use& use : one.uses) add_roots(one.knowledge->path(use.span.file), use.span.begin);
  }
  return out;
}

}  // namespace kb::lsp
