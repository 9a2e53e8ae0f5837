// Finds a name in all knowledge bases that contain it, open or not.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

/// A knowledge base that contains the name.
struct Standing {
  std::string root, path;            ///< `path`: a file of it in which the name stands
  std::uint32_t begin = 0;           ///< of the name in that file
  std::unique_ptr<Knowledge> own;    ///< null if the workspace's own is used
  const Knowledge* knowledge = nullptr;
  std::vector<Use> uses;
};

/// All places of the name that begins at a byte of a file; none if no name begins there.
[[nodiscard]] std::vector<Use> same_at(const Knowledge& knowledge, const std::string& path, std::uint32_t begin);

/// Searches from one place of the name: a file found on the way may be part of further knowledge bases. `workspace` must be compiled.
/// `anew`: compiles all, for callers that need the state of the disk even if the editor reported no change; else only those not open.
[[nodiscard]] std::deque<Standing> everywhere(const Workspace& workspace, const std::string& path, std::uint32_t begin, bool anew);

}  // namespace kb::lsp
