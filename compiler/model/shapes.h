// Turns shapes as written into fuzzy::Shape, and checks units, ranges and the order of corners.
#pragma once

#include <optional>
#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/fuzzy/shape.h"
#include "compiler/syntax/tree.h"

namespace kb::model {

/// The quantity that a shape speaks of: `0..50 cm`, `-180..180 deg circular`.
struct Domain {
  std::string name;             ///< of the input or sensor, for messages
  double low = 0.0, high = 0.0; ///< SI (degrees kept); low < high
  std::string unit;             ///< SI unit, empty if there is none
  std::string written_unit;     ///< the unit of numbers without one: that of the range as written
  bool circular = false;        ///< `high` is `low` again
  source::Span declared;
};

/// A range as a domain; a beginning without a unit takes that of the end. Nothing if a unit is unknown, the two disagree or the
/// range is empty, which is reported.
[[nodiscard]] std::optional<Domain> resolve_range(const syntax::Number& low, const syntax::Number& high, std::string name,
                                                  bool circular, diagnostics::Diagnostics& diagnostics);

/// The shape on a domain. Numbers without a unit are in the domain's; a unit of another dimension is an error. Nothing if
/// anything was reported.
[[nodiscard]] std::optional<fuzzy::Shape> resolve_shape(const syntax::Shape& shape, const Domain& domain,
                                                        diagnostics::Diagnostics& diagnostics);

/// Checks what can be checked of a shape before it meets a domain, as in `prototype`: name, number and form of its arguments, units
/// that exist and agree, order of corners and sign of spreads where units do not matter. False if anything was reported.
bool check_shape(const syntax::Shape& shape, diagnostics::Diagnostics& diagnostics);

/// True if the robot can compute in floats with `value`, which is `number` in SI, and with products of such values: 0, or a size
/// from 1e-18 to 1e18. Otherwise that is reported.
[[nodiscard]] bool in_reach(const syntax::Number& number, double value, diagnostics::Diagnostics& diagnostics);

/// A number of the domain's quantity, in SI: `0.25 m`, or a bare number in the domain's own unit. Nothing if
/// the unit does not fit, which is reported.
[[nodiscard]] std::optional<double> resolve_number(const syntax::Number& number, const Domain& domain,
                                                   diagnostics::Diagnostics& diagnostics);

}  // namespace kb::model
