// Which facts robots of random fleets are usually told: what the profile of these fleets is made of.
#pragma once

#include <cstdint>

namespace kb::emitted {

inline bool is_usual(std::uint32_t fact) { return fact % 2 == 0; }

}  // namespace kb::emitted
