// Error numbers of the operating system in words.
#pragma once

#include <string>

namespace kb::source {

/// Why a call failed that left `error` in errno. Unlike strerror's, the words do not change with the locale.
[[nodiscard]] std::string reason(int error);

}  // namespace kb::source
