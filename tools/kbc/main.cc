// kbc, the command line of Waymark. Everything begins in the table of commands (commands.cc).
#include <cstdio>
#include <exception>
#include <new>

#include "tools/kbc/command_line.h"

int main(int argc, char** argv) {
  try {
    return kb::cli::run_kbc(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("kbc: error: out of memory\n", stderr);
  } catch (const std::exception& bug) {
    std::fprintf(stderr,
                 "kbc: a bug of kbc " KB_VERSION ": %s\n"
                 "This is no mistake of yours. Please report it, with the command line and the files that it names.\n",
                 bug.what());
  }
  return kb::cli::kBug;
}
