// What all commands of kbc share: the options, where messages go, compiling, writing files, progress.
#pragma once

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/driver/compile.h"
#include "compiler/source/source.h"
#include "tools/kbc/commands.h"
#include "tools/kbc/recording_files.h"

namespace kb::trace { class OutputFile; }

namespace kb::cli {

/// The shared options as given on the command line.
struct SharedOptions {
  std::vector<std::string> warnings = {};   ///< what stood after each -W
  bool no_warnings = false;            ///< -w
  bool quiet = false;
  std::string color = "auto";          ///< auto, always, never
  std::string format = "text";         ///< text, json, sarif
  std::string library = {};            ///< the folder that holds `std/`; empty: see `find_library`
};

/// Declares the shared options that `which` asks for.
void add_shared_options(CLI::App& app, SharedOptions& options, Shared which);

/// The folder of the standard library: what was asked for, else $WAYMARK_LIBRARY, else ../share/waymark/stdlib_rules
/// beside the program's folder. (A build folder has a link of that name to the source tree.) The last one that was tried,
/// if there is none.
[[nodiscard]] std::string find_library(std::string_view asked);

class Ranks;

/// How this process was started.
struct Launch {
  char** argv = nullptr;        ///< the whole command line, for a program that is to take its place
  Ranks* ranks = nullptr;       ///< the MPI job that it is part of, if it is (fleet_dealer.h); not owned
};

/// One run of kbc. Messages go to standard error in the format asked for, what a command makes goes to standard output.
class Session {
 public:
  explicit Session(SharedOptions options, Launch launch = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const source::FileSystem& files() const { return files_; }
  /// Paths of all files that were read through `files` in this session, as they were opened.
  [[nodiscard]] const std::vector<std::string>& files_read() const { return files_.read_so_far(); }
  /// Says that this run reads a file by other means than `files`.
  void note_input(std::string_view path) { files_.note(path); }
  [[nodiscard]] const std::string& library() const { return library_; }
  [[nodiscard]] bool quiet() const { return options_.quiet; }
  [[nodiscard]] const Launch& launch() const { return launch_; }
  /// Takes the -W options. False if one names no warning (reported; the command line is wrong then).
  [[nodiscard]] bool take_warning_options();

  /// Compiles `path` with the shared options, reporting as the user wishes. Never null. With `analyse` the user is told all
  /// that can be told, and the model is gone afterwards.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile(std::string_view path, driver::Stage until,
                                                             bool analyse = false);
  /// As `compile`, without analysis; any thread may call it. What is to be said goes into `unheard`, for `pass_on`.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_unheard(std::string_view path, driver::Stage until, std::vector<diagnostics::Diagnostic>& unheard) const;
  /// The same of a text that is in no file, under the name `path`; what it imports is in `files`. All forms, no analysis. `first_leg`: see
  /// driver::Options.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_text(std::string_view path, std::string_view text, const source::FileSystem& files, std::size_t first_leg = 0);
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_text(std::string_view path, std::string_view text) { return compile_text(path, text, files_); }
  /// As `compile`, or, if `path` ends in `.kbt`, what an image holds: program and tables, whatever `until` says, and `image`.
  [[nodiscard]] std::unique_ptr<driver::Compilation> load(std::string_view path, driver::Stage until);
  /// The image of what was compiled, not verified; empty if it is too large (reported).
  [[nodiscard]] std::string make_image(const driver::Compilation& compiled);
  /// Throws std::logic_error if an image that was made would not pass the verification that every reader makes: a bug of ours.
  static void require_sound_image(std::string_view image);
  /// False (reported) if `path` is that of an image, where what an image is made of is needed.
  [[nodiscard]] bool is_source(std::string_view path);
  /// Reads one file into `sources`, alone; `-` is standard input. Nothing if it cannot be read (reported).
  [[nodiscard]] std::optional<source::FileId> open(const std::string& path, source::Sources& sources);
  /// For further messages about files in `sources` (a compilation's, or the command's own), which must outlive them.
  [[nodiscard]] diagnostics::Diagnostics diagnostics(const source::Sources& sources);
  /// Says what was collected, about files in `sources`.
  void pass_on(const source::Sources& sources, const std::vector<diagnostics::Diagnostic>& unheard);
  /// Which warnings the user wants.
  [[nodiscard]] const diagnostics::WarningOptions& warnings() const { return warnings_; }
  /// A message without a place.
  void report(diagnostics::Kind kind, std::initializer_list<std::string_view> arguments);

  /// To standard output. A failure (a full disk, a closed pipe) is told by `finish`.
  void print(std::string_view text);
  /// A line to standard error without which what was asked for cannot be used (the address of a page).
  void announce(std::string_view text);
  /// A line to standard error, unless --quiet ("wrote mission.kb.h").
  void remark(std::string_view text);

  /// No output takes the place of a file that this run has read: false (reported) if `path` would. `open_output` and `write_files`
  /// ask; a command that works long before it writes asks at once.
  [[nodiscard]] bool may_write(const std::string& path);
  /// Opens a file that is written as it comes. False if it may not or cannot be written (reported).
  [[nodiscard]] bool open_output(trace::OutputFile& file, const std::string& path);

  struct OutputFile {
    std::string path;
    std::string bytes;
    /// Throws if the bytes must not become that file. Called before they are written, or, if they are many, meanwhile.
    void (*verify)(std::string_view bytes) = nullptr;
    bool in_place = false;   ///< made of the file whose place it takes, and asked for
  };
  /// Writes files so that either all of them are new or none is: each is written beside its place, brought to disk, and
  /// moved there when all are complete (see note [two phases of writing]). Reports what fails (KB0904) and returns false
  /// then, or throws what the verification of one throws; old files are untouched. The path `-` is standard output: printed when
  /// all else is complete; if it takes no more no file is new (unless its reader has gone, who wants no more).
  bool write_files(const std::vector<OutputFile>& files);

  /// What a command makes, to the file that `-o` names, or to standard output if it names none. Returns the exit code.
  [[nodiscard]] int deliver(const std::string& output, std::string bytes);

  /// The error that was reported last, with its place; empty if there was none.
  [[nodiscard]] const std::string& last_error() const { return last_error_; }
  /// kErrors if anything was reported as an error in this session, else kClean.
  [[nodiscard]] int exit_code() const { return errors_ > 0 ? kErrors : kClean; }
  /// Prints what is left to print (the summary, the SARIF document) and returns the final exit code.
  [[nodiscard]] int finish(int code);

  [[nodiscard]] bool color() const { return color_; }

 private:
  class Outlet;
  void tell(std::string_view text);
  void flush_output();
  bool write_all_or_none(const std::vector<OutputFile>& files);
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_from(const source::FileSystem& files, std::string_view path, driver::Stage until, bool analyse, std::size_t first_leg = 0);
  /// True (reported) if nothing can be compiled under this name, or with this library.
  [[nodiscard]] bool refuses(std::string_view path, diagnostics::Diagnostics messages) const;
  [[nodiscard]] driver::Options how_to_compile(driver::Stage until, bool analyse, std::size_t first_leg) const;
  [[nodiscard]] std::optional<std::string> read_image_file(const std::string& path);
  [[nodiscard]] std::unique_ptr<diagnostics::Consumer> make_consumer(const source::Sources& sources);
  SharedOptions options_;
  Launch launch_;
  RecordingFiles files_;
  source::Sources no_sources_;
  diagnostics::WarningOptions warnings_;
  std::string library_;
  bool color_ = false;
  int output_error_ = 0;   // of the first write to standard output that failed
  std::size_t errors_ = 0, warning_count_ = 0;
  std::string last_error_;
  std::set<std::string> said_;   // what was said of imported files is not said again
  std::unique_ptr<diagnostics::SarifLog> sarif_;
  std::vector<std::unique_ptr<diagnostics::Consumer>> consumers_;
};

/// `name` can be the namespace of generated C++: an identifier, no keyword, and not one that the runtime has; or several, with `::`
/// between them.
[[nodiscard]] bool is_namespace(std::string_view name);

/// The file descriptor leads to a terminal that can show colours and progress.
[[nodiscard]] bool is_terminal(int file);

/// A line on the terminal that says how far a long command is; nothing if standard error is no terminal, with --quiet, or
/// during the first half second. Gone when it dies.
class Progress {
 public:
  Progress(const Session& session, std::string_view what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Cheap: looks at the clock every 256th time.
  void update(std::uint64_t done);
  /// For steps that take long: looks at the clock each time, and says how long the rest will take. `total` 0: unknown.
  void show(std::uint64_t done, std::uint64_t total = 0);
  /// So much was done before it began.
  void begin_at(std::uint64_t done) { before_ = done; }

 private:
  [[nodiscard]] std::string time_left(std::uint64_t done, std::uint64_t total) const;
  std::uint64_t before_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::string what_;
  bool on_;
  bool shown_ = false;
  std::uint32_t calls_ = 0;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace kb::cli
