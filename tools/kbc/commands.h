// The subcommands of kbc: one static table (commands.cc), from which the command line, `--help`, the completion and the
// man pages are all made.
//
// A command is one file, cmd_NAME.cc, that defines one function, declared below:
//
//   namespace kb::cli {
//   namespace {
//   struct GreetOptions {
//     std::string file;
//     bool loud = false;
//   };
//
//   int greet(const GreetOptions& options, Session& session) {
//     const auto compiled = session.compile(options.file, driver::Stage::kProgram);   // reports as the user wishes
//     if (!compiled->ok()) return kErrors;
//     session.print(options.loud ? "HELLO\n" : "hello\n");
//     return session.exit_code();                                                     // kErrors if anything was reported
//   }
//   }  // namespace
//
//   Run setup_greet(CLI::App& app) {
//     auto options = std::make_shared<GreetOptions>();
//     app.add_option("FILE", options->file, "The knowledge base")->required();
//     app.add_flag("--loud", options->loud, "In capital letters");
//     return [options](Session& session) { return greet(*options, session); };
//   }
//   }  // namespace kb::cli
//
// Rules:
// - A positional is written in capitals (the completion knows `FILE`, `DIR` and the words in completion.cc); its help
//   begins with a capital and has no full stop.
// - Everything is printed through the session (support.h).
// - Options that all commands share are not declared here but chosen in the table (`Shared`).
// - Only the .cc includes CLI11.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace CLI { class App; }

namespace kb::cli {

class Session;

/// What a command does when the command line has been read. Returns the exit code.
using Run = std::function<int(Session&)>;

/// The exit codes of the process.
enum ExitCode : int {
  kClean = 0,
  kErrors = 1,   ///< errors were reported
  kUsage = 2,    ///< the command line cannot be understood
  kBug = 70,     ///< a bug of kbc
  kOutOfMemory = 71,    ///< the system gave no more memory; what was to be written is as before
  kInterrupted = 130,   ///< an orderly end by Ctrl-C or SIGTERM; the code that shells give for SIGINT
};

/// Which of the shared options a command takes (see add_shared_options in support.h).
enum class Shared : std::uint8_t {
  kNone,       ///< --color, --quiet
  kMessages,   ///< and --diagnostics-format
  kWarns,      ///< and -W..., -w
  kCompiles,   ///< and --library
};
[[nodiscard]] constexpr bool takes_warnings(Shared shared) { return shared >= Shared::kWarns; }

struct Command {
  std::string_view name;
  std::string_view help;        ///< one line: a capital first, no full stop
  std::string_view about;       ///< a paragraph or more for `--help` and the man page; may be empty
  std::string_view examples;    ///< lines `kbc ...`, each with a `#` comment on what it does
  Shared shared;
  Run (*setup)(CLI::App& app);  ///< declares the options; the result keeps them alive
};

/// All subcommands, in the order in which they are listed.
[[nodiscard]] std::span<const Command> commands();

Run setup_compile(CLI::App& app);
Run setup_check(CLI::App& app);
Run setup_run(CLI::App& app);
Run setup_tidy(CLI::App& app);
Run setup_test(CLI::App& app);
Run setup_why(CLI::App& app);
Run setup_diff(CLI::App& app);
Run setup_drive(CLI::App& app);
Run setup_experiment(CLI::App& app);
Run setup_explain(CLI::App& app);
Run setup_expand(CLI::App& app);
Run setup_dump(CLI::App& app);
Run setup_budget(CLI::App& app);
Run setup_export(CLI::App& app);
Run setup_graph(CLI::App& app);
Run setup_import(CLI::App& app);
Run setup_lsp(CLI::App& app);
Run setup_plot(CLI::App& app);
Run setup_fmt(CLI::App& app);
Run setup_new(CLI::App& app);
Run setup_completion(CLI::App& app);
Run setup_man(CLI::App& app);
Run setup_plan(CLI::App& app);
Run setup_sim(CLI::App& app);
Run setup_fleet(CLI::App& app);
Run setup_compare(CLI::App& app);

}  // namespace kb::cli
