// kbc as one function, for the programs that are kbc.
#pragma once

namespace kb::cli {

class Ranks;

/// The whole program: reads the command line, runs the command, returns the exit code. `ranks`: see Launch.
[[nodiscard]] int run_kbc(int argc, char** argv, Ranks* ranks = nullptr);
/// The same, and what no command catches becomes a message: a bug of ours, or no memory.
[[nodiscard]] int run_kbc_guarded(int argc, char** argv, Ranks* ranks = nullptr);

}  // namespace kb::cli
