// Numbers with units.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/syntax/tree.h"

namespace kb::model {

/// A number in SI units (degrees kept) and the unit it is then in.
struct Quantity { double value = 0.0; std::string_view unit; };

/// Nothing if there is no such unit, which is reported. A number without a unit stays as it is.
[[nodiscard]] std::optional<Quantity> to_si(const syntax::Number& number, diagnostics::Diagnostics& diagnostics);

/// All units, as they are written.
[[nodiscard]] std::vector<std::string_view> unit_names();

/// Whether both are the same quantity, in whatever units. Unknown units must be the same text.
[[nodiscard]] bool same_quantity(const syntax::Number& a, const syntax::Number& b);

/// A time in microseconds. Nothing if it has no unit of time, is negative, shorter than a microsecond (except 0) or longer than
/// 2^32 - 1 microseconds (1 h 11 min 34 s), which is reported.
[[nodiscard]] std::optional<std::uint32_t> to_microseconds(const syntax::Number& number,
                                                           diagnostics::Diagnostics& diagnostics);

}  // namespace kb::model
