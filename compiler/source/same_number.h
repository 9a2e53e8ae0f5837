// For enumerations of two modules that list the same things: asserted where one is taken for the other by its number.
#pragma once

namespace kb::source {

template <class A, class B>
[[nodiscard]] constexpr bool same_number(A a, B b) { return static_cast<int>(a) == static_cast<int>(b); }

}  // namespace kb::source
