// kbc as one function, for the programs that embody kbc.
#pragma once

namespace kb::cli {

class Ranks;

/// The whole program: reads the command line, runs the command, returns the exit code. `ranks`: see Launch.
[[nodiscard]] int run_kbc(int argc, char** argv, Ranks* ranks = nullptr);
/// The same, and turns exceptions that no command catches into a message: a bug of kbc, or memory exhausted.
[[nodiscard]] int run_kbc_guarded(int argc, char** argv, Ranks* ranks = nullptr);

}  // namespace kb::cli
