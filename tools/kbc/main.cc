// kbc, the command line of Waymark. Everything begins in the table of commands (commands.cc).
#include "tools/kbc/run_kbc.h"

int main(int argc, char** argv) { return kb::cli::run_kbc_guarded(argc, argv); }
