// A name in all knowledge bases that it is part of, open or not.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

/// A knowledge base in which the name stands.
struct Standing {
  std::string root, path;            ///< `path`: a file of it in which the name stands
  std::uint32_t begin = 0;           ///< there
  std::unique_ptr<Knowledge> own;    ///< unless it is the workspace's
  const Knowledge* knowledge = nullptr;
  std::vector<Use> uses;
};

/// All places of what begins at a byte of a file; none if nothing does.
[[nodiscard]] std::vector<Use> same_at(const Knowledge& knowledge, const std::string& path, std::uint32_t begin);

/// From one of its places on. A file may be part of knowledge bases that the one before it is not. `workspace` is compiled.
/// `anew`: all are compiled, for who must know what is on the disk whoever tells of it or not; else those that are not open.
[[nodiscard]] std::deque<Standing> everywhere(const Workspace& workspace, const std::string& path, std::uint32_t begin, bool anew);

}  // namespace kb::lsp
