// What an emitted name must not be, although it has the form of one.
#pragma once

#include <string_view>

namespace kb::emit {

/// Whether `name` means something else to a C++ compiler: a keyword of C++20 to C++26 or of GNU's C++, a macro of a header of the C++
/// standard, another number of an error or signal or clock of POSIX, a macro that GNU compilers define by themselves, or a name that emitted
/// code needs at the outermost level.
[[nodiscard]] bool is_reserved(std::string_view name);

}  // namespace kb::emit
