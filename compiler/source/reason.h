// What the operating system means by a refusal.
#pragma once

#include <string>

namespace kb::source {

/// Why a call failed that left `error` in errno, in words that do not change with the locale (as strerror's do).
[[nodiscard]] std::string reason(int error);

}  // namespace kb::source
