// Shared by all commands of kbc: options, messages, compiling, writing files, progress.
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
  std::vector<std::string> warnings = {};   ///< the text after each -W
  bool no_warnings = false;            ///< -w
  bool quiet = false;
  std::string color = "auto";          ///< auto, always, never
  std::string format = "text";         ///< text, json, sarif
  std::string library = {};            ///< the folder that holds `std/`; empty: see `find_library`
};

/// Declares the shared options that `which` asks for.
void add_shared_options(CLI::App& app, SharedOptions& options, Shared which);

class Ranks;

/// How this process was started.
struct Launch {
  char** argv = nullptr;        ///< the whole command line, for a program that is to replace this process
  Ranks* ranks = nullptr;       ///< the MPI job that it is part of, if any (fleet_dealer.h); not owned
};

/// One run of kbc. Messages go to standard error in the format asked for; products of commands go to standard output.
class Session {
 public:
  explicit Session(SharedOptions options, Launch launch = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const source::FileSystem& files() const { return files_; }
  /// Paths of all files that were read through `files` in this session, as they were opened.
  [[nodiscard]] const std::vector<std::string>& files_read() const { return files_.read_so_far(); }
  /// Notes that this run reads a file by other means than `files`.
  void note_input(std::string_view path) { files_.note(path); }
  [[nodiscard]] const std::string& library() const { return library_; }
  [[nodiscard]] bool quiet() const { return options_.quiet; }
  /// Whether messages are text for people: other formats must not be mixed with it.
  [[nodiscard]] bool says_text() const { return options_.format == "text"; }
  [[nodiscard]] const Launch& launch() const { return launch_; }
  /// Takes the -W options. False if one names no warning (reported), which is an error of the command line.
  [[nodiscard]] bool take_warning_options();

  /// Compiles `path` with the shared options, reporting as the user wishes. Never null. With `analyse` all messages
  /// are given, and the model is freed afterwards, unless it is kept.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile(std::string_view path, driver::Stage until,
                                                             bool analyse = false, bool keep_model = false);
  /// Like `compile`, without analysis; any thread may call it. Messages are collected in `unheard`, for `pass_on`.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_unheard(std::string_view path, driver::Stage until, std::vector<diagnostics::Diagnostic>& unheard) const;
  /// The same for a text that is in no file, under the name `path`; its imports are read from `files`. All forms, no analysis. `first_leg`:
  /// see driver::Options.
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_text(std::string_view path, std::string_view text, const source::FileSystem& files, std::size_t first_leg = 0);
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_text(std::string_view path, std::string_view text) { return compile_text(path, text, files_); }
  /// Like `compile`; but if `path` ends in `.kbt`, what an image holds: program, tables and `image`, whatever `until` is.
  [[nodiscard]] std::unique_ptr<driver::Compilation> load(std::string_view path, driver::Stage until);
  /// The image of what was compiled, not verified; empty if it is too large (reported).
  [[nodiscard]] std::string make_image(const driver::Compilation& compiled);
  /// True (reported) if an image was too large to be written, and so is empty.
  [[nodiscard]] bool refuse_image(std::string_view image);
  /// Throws std::logic_error if an image made here would fail the verification that every reader makes, which is a bug of kbc.
  static void require_sound_image(std::string_view image);
  /// False (reported) if `path` is an image, for commands that need the source.
  [[nodiscard]] bool is_source(std::string_view path);
  /// Reads one file into `sources`, alone; `-` is standard input. Nothing if it cannot be read (reported).
  [[nodiscard]] std::optional<source::FileId> open(const std::string& path, source::Sources& sources);
  /// A receiver of further messages about files in `sources` (a compilation's, or the command's own), which must outlive it.
  [[nodiscard]] diagnostics::Diagnostics diagnostics(const source::Sources& sources);
  /// Reports messages that were collected, about files in `sources`.
  void pass_on(const source::Sources& sources, const std::vector<diagnostics::Diagnostic>& unheard);
  /// The warnings that the user wants.
  [[nodiscard]] const diagnostics::WarningOptions& warnings() const { return warnings_; }
  /// A message without a place.
  void report(diagnostics::Kind kind, std::initializer_list<std::string_view> arguments);

  /// To standard output. A failure (a full disk, a closed pipe) is reported by `finish`.
  void print(std::string_view text);
  /// Lets out at once what was printed; for a command that goes on for long.
  void flush_output();
  /// A line to standard error without which the result cannot be used (the address of a page).
  void announce(std::string_view text);
  /// A line to standard error, unless --quiet ("wrote mission.kb.h").
  void remark(std::string_view text);

  /// Whether an output may be written to `path`: false (reported) if that would replace a file that this run has read. `open_output` and
  /// `write_files` check this; a command that works for long before it writes checks at once.
  [[nodiscard]] bool may_write(const std::string& path);
  /// Opens a file for output as it is produced. False if it may not or cannot be written (reported).
  [[nodiscard]] bool open_output(trace::OutputFile& file, const std::string& path);

  struct OutputFile {
    std::string path;
    std::string bytes;
    /// Throws if the bytes must not become that file. Called before they are written or, if they are many, while they are.
    void (*verify)(std::string_view bytes) = nullptr;
    bool in_place = false;   ///< it replaces the file that it was made from, as the user asked
  };
  /// Writes files so that either all of them are new or none is: each is written beside its place, brought to disk, and
  /// moved there when all are complete (see note [two phases of writing]). On failure it reports what failed (KB0904)
  /// and returns false, or throws what a verification throws; old files are then untouched. The path `-` is standard output, printed when all
  /// else is complete. If that fails, no file is new either, unless the reader of standard output has gone.
  bool write_files(const std::vector<OutputFile>& files);
  /// Writes each by itself: a disk that is full for one may have room for another. False (reported) if one was not written.
  bool write_each(const std::vector<OutputFile>& files);

  /// Writes the product of a command to the file of `-o`, or to standard output if there is none. Returns the exit code.
  [[nodiscard]] int deliver(const std::string& output, std::string bytes);

  /// The error that was reported last, with its place; empty if there was none.
  [[nodiscard]] const std::string& last_error() const { return last_error_; }
  /// kErrors if anything was reported as an error in this session, else kClean.
  [[nodiscard]] int exit_code() const { return errors_ > 0 ? kErrors : kClean; }
  /// Prints what is left to print (the summary, the SARIF document) and returns the final exit code.
  [[nodiscard]] int finish(int code);

 private:
  class Outlet;
  void tell(std::string_view text);
  bool write_all_or_none(const std::vector<OutputFile>& files);
  [[nodiscard]] std::unique_ptr<driver::Compilation> compile_from(const source::FileSystem& files, std::string_view path, const driver::Options& how);
  /// True (reported) if nothing can be compiled under this name, or with this library.
  [[nodiscard]] bool refuses(std::string_view path, diagnostics::Diagnostics messages) const;
  [[nodiscard]] driver::Options how_to_compile(driver::Stage until, bool analyse) const;
  [[nodiscard]] std::optional<std::string> read_image_file(const std::string& path);
  [[nodiscard]] std::unique_ptr<diagnostics::Consumer> make_consumer(const source::Sources& sources);
  SharedOptions options_;
  Launch launch_;
  RecordingFiles files_;
  source::Sources no_sources_;
  diagnostics::WarningOptions warnings_;
  std::string library_;
  bool color_ = false;
  int output_error_ = 0;   // errno of the first failed write to standard output
  bool untold_ = false;    // a message was lost for want of room
  std::size_t errors_ = 0, warning_count_ = 0;
  std::string last_error_;
  std::set<std::string> said_;   // messages about imported files, which are not repeated
  std::unique_ptr<diagnostics::SarifLog> sarif_;
  std::vector<std::unique_ptr<diagnostics::Consumer>> consumers_;
};

/// Whether `name` can be the namespace of generated C++: an identifier that is no keyword and no namespace of the runtime, or several joined
/// by `::`.
[[nodiscard]] bool is_namespace(std::string_view name);

/// Whether the file descriptor is a terminal that can show colours and progress.
[[nodiscard]] bool is_terminal(int file);

/// A line on the terminal that shows the progress of a long command, from the first half second on; the destructor removes it. If standard
/// error is no terminal, a line a minute for its log, unless messages have another format than text. Nothing with --quiet.
class Progress {
 public:
  Progress(const Session& session, std::string_view what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Cheap: looks at the clock every 256th time.
  void update(std::uint64_t done);
  /// For steps that take long: looks at the clock each time, and shows how long the rest will take. `total` 0: unknown.
  void show(std::uint64_t done, std::uint64_t total = 0);
  /// How much was done before the command began.
  void begin_at(std::uint64_t done) { before_ = done; }

 private:
  [[nodiscard]] std::string time_left(std::uint64_t done, std::uint64_t total) const;
  std::uint64_t before_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::string what_;
  bool terminal_, on_;
  bool shown_ = false;
  std::uint32_t calls_ = 0;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace kb::cli
