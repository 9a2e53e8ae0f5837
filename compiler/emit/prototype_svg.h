// Pictures of how certainly a reading fits a prototype, as SVG: printing only; the values come from the oracle of compiler/fuzzy.
#pragma once

#include <string>

#include "compiler/fuzzy/shape.h"

namespace kb::emit {

/// One sensor against one prototype. Numbers in SI units, degrees kept.
struct PrototypePicture {
  std::string sensor, prototype, unit;
  double low = 0.0, high = 1.0;    ///< the range of the sensor
  double noise = 0.0;              ///< the spread of a fresh reading
  double stale_s = 0.0;            ///< 0: its readings do not age
  double growth = 0.0;             ///< how much the square of the spread grows a second
};

/// Three pictures: the membership function; the certainty over the reading, fresh and as it ages; the certainty over the age, for
/// three readings. Same arguments, same bytes.
[[nodiscard]] std::string print_prototype_svg(const fuzzy::Shape& shape, const PrototypePicture& picture);

}  // namespace kb::emit
