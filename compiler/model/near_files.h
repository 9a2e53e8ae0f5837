// A file that may be meant when one is not there.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::model {

/// An existing file whose name differs from `path` by little: a missing `.kb`, or one letter left out, added, changed or
/// swapped in the last part. A `FileSystem` lists nothing, so the names are tried; at most about 1,500 reads.
[[nodiscard]] std::optional<std::string> near_file(std::string_view path, const source::FileSystem& files);

}  // namespace kb::model
