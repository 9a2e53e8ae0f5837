// Which sources this program was built from.
#pragma once

namespace kb::cli {

/// 16 hexadecimal digits: another simulator, controller or judge gives other ones, also within a version. The same in kbc and in the program of
/// its MPI ranks. Defined by a file that cmake/SourcePrint.cmake makes.
[[nodiscard]] const char* source_print();

}  // namespace kb::cli
