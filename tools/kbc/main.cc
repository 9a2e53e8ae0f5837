// kbc, the command line of Waymark. Everything begins in the table of commands (commands.cc).
#include "tools/kbc/command_line.h"

int main(int argc, char** argv) { return kb::cli::run_kbc_guarded(argc, argv); }
