// The explanations as embedded in the program (embed_explanations.cmake describes their form).
#pragma once

#include <span>
#include <string_view>

namespace kb::diagnostics {

/// Sections `== KB0301\n...` and the comments between the families, in no particular order.
[[nodiscard]] std::span<const std::string_view> explanation_pieces();

}  // namespace kb::diagnostics
