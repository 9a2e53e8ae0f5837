// kbc as one function, for the programs that embody kbc.
#pragma once

#include <functional>

namespace kb::cli {

class Ranks;

/// The whole program: reads the command line, runs the command, returns the exit code. `ranks`: see Launch.
[[nodiscard]] int run_kbc(int argc, char** argv, Ranks* ranks = nullptr);
/// The same, `guarded`.
[[nodiscard]] int run_kbc_guarded(int argc, char** argv, Ranks* ranks = nullptr);
/// What `run` returns. Turns exceptions that no command catches into a message and an exit code: kOutOfMemory, or kBug.
[[nodiscard]] int guarded(const std::function<int()>& run);

}  // namespace kb::cli
