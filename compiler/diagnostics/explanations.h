// The explanations as they were embedded (see embed_explanations.cmake for their form).
#pragma once

#include <span>
#include <string_view>

namespace kb::diagnostics {

/// Sections `== KB0301\n...` and the comments between the families, in no particular order.
[[nodiscard]] std::span<const std::string_view> explanation_pieces();

}  // namespace kb::diagnostics
