// Finds the file that was probably meant when a file does not exist.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::model {

/// An existing file whose name differs little from `path`: a missing `.kb`, or one letter left out, added, changed or swapped in
/// the last part. A `FileSystem` cannot list files, so candidate names are tried, with at most about 1,500 reads.
[[nodiscard]] std::optional<std::string> near_file(std::string_view path, const source::FileSystem& files);

}  // namespace kb::model
