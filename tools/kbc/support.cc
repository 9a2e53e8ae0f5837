#include "tools/kbc/support.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <stdexcept>

#include "compiler/source/reason.h"
#include "sim/mind/control_words.h"
#include "tools/kbc/fleet_dealer.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/library_folder.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/stream.h"

namespace kb::cli {

using diagnostics::Diagnostic;
using diagnostics::Kind;

void add_shared_options(CLI::App& app, SharedOptions& options, Shared which) {
  const auto group = [](CLI::Option* option) { option->group("Shared options"); };
  if (which == Shared::kCompiles) {
    group(app.add_option("--library", options.library, "The folder that holds the standard library `std`")->type_name("DIR"));
  }
  if (takes_warnings(which)) {
    group(app.add_option("-W", options.warnings,
                         "-Wname, -Wno-name, -Werror, -Werror=name, -Wno-error=name, -Wstandard-library, -Wallowed: which warnings "
                         "are shown, and which are errors (`kbc explain --list` names them)")
              ->type_name("WARNING")
              ->allow_extra_args(false));
    group(app.add_flag("-w", options.no_warnings, "No warnings at all"));
  }
  if (which != Shared::kNone) {
    group(app.add_option("--diagnostics-format", options.format, "How messages are written to standard error")
              ->check(CLI::IsMember({"text", "json", "sarif"}))
              ->capture_default_str());
  }
  group(app.add_option("--color", options.color, "Colours in messages; auto: on a terminal, unless NO_COLOR is set")
            ->check(CLI::IsMember({"auto", "always", "never"}))
            ->capture_default_str());
  group(app.add_flag("-q,--quiet", options.quiet, "On standard error only errors and warnings"));
}

namespace {

bool wants_color(const std::string& option) {
  if (option != "auto") return option == "always";
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && is_terminal(STDERR_FILENO);
}

}  // namespace

bool is_terminal(int file) {
  const char* term = std::getenv("TERM");
  return ::isatty(file) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

// Counts messages, drops those that were said before (several knowledge bases may import one file), and passes the others on.
class Session::Outlet final : public diagnostics::Consumer {
 public:
  Outlet(Session& session, const source::Sources& sources, std::unique_ptr<Consumer> inner)
      : session_(session), sources_(sources), inner_(std::move(inner)) {}

  void consume(const Diagnostic& d) override {
    if (d.severity == diagnostics::Severity::kError) session_.last_error_ = (d.span.known() ? sources_.describe(d.span) + ": " : "") + d.message;
    if (!session_.said_.insert(diagnostics::code_text(d.kind) + " " + sources_.describe(d.span) + " " + d.message).second) return;
    if (d.severity == diagnostics::Severity::kError) ++session_.errors_;
    if (d.severity == diagnostics::Severity::kWarning) ++session_.warning_count_;
    inner_->consume(d);
  }

 private:
  Session& session_;
  const source::Sources& sources_;
  std::unique_ptr<Consumer> inner_;
};

Session::Session(SharedOptions options, Launch launch)
    : options_(std::move(options)), launch_(launch), library_(find_library(options_.library)), color_(wants_color(options_.color)) {
  if (options_.format == "sarif") sarif_ = std::make_unique<diagnostics::SarifLog>(KB_VERSION);
  if (launch_.ranks != nullptr && launch_.ranks->rank() != 0) options_.quiet = options_.no_warnings = true;   // rank 0 says it once
  warnings_.none = options_.no_warnings;
}

Session::~Session() = default;

bool Session::take_warning_options() {
  bool known = true;
  for (const std::string& option : options_.warnings) {
    if (warnings_.apply(option)) continue;
    known = false;
    std::string_view name = option;
    for (const std::string_view prefix : {"error=", "no-error=", "no-"}) {
      if (name.starts_with(prefix)) { name.remove_prefix(prefix.size()); break; }
    }
    auto messages = diagnostics(no_sources_);
    messages.report(Kind::kUnknownWarning, {}, {name}).suggest(diagnostics::closest(name, diagnostics::flags()));
  }
  return known;
}

void Session::tell(std::string_view text) {
  flush_output();   // so that both streams appear in order if they go to the same place
  const bool told = std::fwrite(text.data(), 1, text.size(), stderr) == text.size();
  untold_ = untold_ || (!told && (errno == ENOSPC || errno == EFBIG || errno == EDQUOT));
}

std::unique_ptr<diagnostics::Consumer> Session::make_consumer(const source::Sources& sources) {
  std::unique_ptr<diagnostics::Consumer> inner;
  const auto sink = [this](std::string_view text) { tell(text); };
  if (sarif_) inner = std::make_unique<diagnostics::SarifConsumer>(sources, *sarif_);
  else if (options_.format == "json") inner = std::make_unique<diagnostics::JsonConsumer>(sources, sink);
  else inner = std::make_unique<diagnostics::TextConsumer>(sources, sink, color_);
  return std::make_unique<Outlet>(*this, sources, std::move(inner));
}

diagnostics::Diagnostics Session::diagnostics(const source::Sources& sources) {
  consumers_.push_back(make_consumer(sources));
  return {sources, *consumers_.back(), warnings_};
}

namespace {

bool is_image_path(std::string_view path) { return path.ends_with(".kbt"); }

std::unique_ptr<driver::Compilation> failed_compilation() {
  auto nothing = std::make_unique<driver::Compilation>();
  nothing->errors = 1;
  return nothing;
}

}  // namespace

std::unique_ptr<driver::Compilation> Session::load(std::string_view path, driver::Stage until) {
  if (!is_image_path(path)) return compile(path, until);
  const auto bytes = read_image_file(std::string(path));
  if (!bytes) return failed_compilation();
  auto result = std::make_unique<driver::Compilation>();
  result->image = std::make_unique<tables::LoadedImage>(*bytes);
  if (const mts::ImageStatus status = result->image->status(); status != mts::ImageStatus::kOk) {
    report(Kind::kImageRefused, {path, mts::text(status)});
    return failed_compilation();
  }
  result->tables = tables::recall_tables(*result->image);
  result->program = tables::recall_program(*result->image, result->tables);
  return result;
}

std::string Session::make_image(const driver::Compilation& compiled) {
  std::string image = tables::write_image(compiled.tables, compiled.program);
  if (refuse_image(image)) return {};
  return image;
}

bool Session::refuse_image(std::string_view image) {
  if (image.empty()) report(Kind::kImageTooLarge, {std::to_string(mts::kMaxImageBytes >> 20)});
  return image.empty();
}

void Session::require_sound_image(std::string_view image) {
  const mts::ImageStatus status = tables::verify_image(image);
  if (status != mts::ImageStatus::kOk) throw std::logic_error(std::string("the image is not sound: ") + mts::text(status));
}

std::optional<std::string> Session::read_image_file(const std::string& path) {
  note_input(path);
  std::string error;
  auto bytes = trace::read_all(path, mts::kMaxImageBytes, error);
  if (bytes) return bytes;
  if (error.empty()) report(Kind::kImageTooLarge, {std::to_string(mts::kMaxImageBytes >> 20)});
  else report(Kind::kCannotRead, {path, error});
  return std::nullopt;
}

bool Session::is_source(std::string_view path) {
  if (!is_image_path(path)) return true;
  report(Kind::kImageNotSource, {path});
  return false;
}

bool Session::refuses(std::string_view path, diagnostics::Diagnostics messages) const {
  if (is_image_path(path)) messages.report(Kind::kImageNotSource, {}, {path});
  else if (!named_library(options_.library).empty() && !is_library(library_)) messages.report(Kind::kLibraryNotFound, {}, {library_}).suggest(library_above(library_));
  return messages.failed();
}

driver::Options Session::how_to_compile(driver::Stage until, bool analyse) const {
  return {.library = library_, .warnings = warnings_, .known = sim::controller_arguments(), .until = until, .analyse = analyse, .keep_model = !analyse};
}

std::unique_ptr<driver::Compilation> Session::compile(std::string_view path, driver::Stage until, bool analyse, bool keep_model) {
  driver::Options how = how_to_compile(until, analyse);
  how.keep_model = how.keep_model || keep_model;
  return compile_from(files_, path, how);
}

std::unique_ptr<driver::Compilation> Session::compile_text(std::string_view path, std::string_view text, const source::FileSystem& files, std::size_t first_leg) {
  driver::Options how = how_to_compile(driver::Stage::kTables, false);
  how.first_leg = first_leg;
  return compile_from(source::OneFileMore(path, text, files), path, how);
}

std::unique_ptr<driver::Compilation> Session::compile_from(const source::FileSystem& files, std::string_view path, const driver::Options& how) {
  if (refuses(path, diagnostics(no_sources_))) return failed_compilation();
  const auto consumer = [](const source::Sources& sources, void* self) { return static_cast<Session*>(self)->make_consumer(sources); };
  return driver::compile(path, files, how, consumer, this);
}

std::unique_ptr<driver::Compilation> Session::compile_unheard(std::string_view path, driver::Stage until, std::vector<Diagnostic>& unheard) const {
  diagnostics::Keeping keeping(unheard);
  if (refuses(path, {no_sources_, keeping, warnings_})) return failed_compilation();
  return driver::compile(path, files_, how_to_compile(until, false), diagnostics::Keeping::make, &unheard);
}

void Session::pass_on(const source::Sources& sources, const std::vector<Diagnostic>& unheard) {
  const auto consumer = make_consumer(sources);
  for (const Diagnostic& diagnostic : unheard) consumer->consume(diagnostic);
}

std::optional<source::FileId> Session::open(const std::string& path, source::Sources& sources) {
  const bool standard_input = path == "-";
  source::FileSystem::Result result;
  if (standard_input) {
    result.bytes = trace::read_all(path, source::kMaxFileBytes, result.error);
    result.too_large = !result.bytes && result.error.empty();
  } else {
    result = files_.read(path);
  }
  if (result.bytes) return sources.add(standard_input ? "standard input" : path, std::move(*result.bytes));
  if (result.too_large) report(Kind::kFileTooLarge, {path, std::to_string(source::kMaxFileBytes >> 20)});
  else report(Kind::kCannotRead, {path, result.error});
  return std::nullopt;
}

void Session::report(Kind kind, std::initializer_list<std::string_view> arguments) {
  diagnostics(no_sources_).report(kind, {}, arguments);
}

void Session::print(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole && output_error_ == 0) output_error_ = errno;
}

// What a flush could not write is lost, and later flushes do not fail because of it.
void Session::flush_output() {
  if (std::fflush(stdout) != 0 && output_error_ == 0) output_error_ = errno;
}

void Session::remark(std::string_view text) {
  if (!options_.quiet) tell(std::string(text) + "\n");
}

void Session::announce(std::string_view text) { tell(std::string(text) + "\n"); }

namespace {

/// Verifies a file that is to be written. A large file that is first written under another name is verified meanwhile; it may get its name
/// when the result is there.
std::future<void> begin_verification(const Session::OutputFile& file, bool stays_beside) {
  constexpr std::size_t kLarge = std::size_t{1} << 20;
  if (file.verify == nullptr) return {};
  if (stays_beside && file.bytes.size() >= kLarge) return std::async(std::launch::async, file.verify, std::string_view(file.bytes));
  file.verify(file.bytes);
  return {};
}

}  // namespace

bool Session::may_write(const std::string& path) {
  const bool may = !files_.is_input(path);
  if (!may) report(Kind::kOutputIsInput, {path});
  return may;
}

bool Session::open_output(trace::OutputFile& file, const std::string& path) {
  if (!may_write(path)) return false;
  const bool opened = file.open(path);
  if (!opened) report(Kind::kCannotWrite, {path, file.error()});
  return opened;
}

bool Session::write_files(const std::vector<OutputFile>& files) {
  std::optional<Interrupts> interrupts;   // so that no file under another name is left behind
  if (!Interrupts::are_held()) interrupts.emplace();
  const bool written = write_all_or_none(files);
  const int ended_by = interrupts ? Interrupts::which() : 0;
  interrupts.reset();
  if (ended_by != 0) {
    std::signal(ended_by, SIG_DFL);   // a shell lets its jobs in the background ignore SIGINT
    std::raise(ended_by);
  }
  return written;
}

bool Session::write_each(const std::vector<OutputFile>& files) {
  bool written = true;
  for (const OutputFile& file : files) written = write_files({file}) && written;
  return written;
}

bool Session::write_all_or_none(const std::vector<OutputFile>& files) {
  std::vector<trace::OutputFile> staged(files.size());
  const auto taken = [&](std::size_t i, bool ok) {
    const bool broken_off = staged[i].error() == source::reason(EINTR);   // while it waited for a reader: `write_files` ends the program
    if (!ok && !broken_off) report(Kind::kCannotWrite, {files[i].path, staged[i].error()});
    return ok;
  };
  for (const OutputFile& file : files) {
    if (!file.in_place && !may_write(file.path)) return false;
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    const bool printed = files[i].path == "-";
    if (!printed && !taken(i, staged[i].open(files[i].path))) return false;
    std::future<void> verified = begin_verification(files[i], staged[i].stays_beside());
    if (printed) continue;
    staged[i].write(files[i].bytes);
    if (!taken(i, staged[i].stage())) return false;
    if (verified.valid()) verified.get();
  }
  bool printed = false;
  for (const OutputFile& file : files) {
    if (file.path != "-") continue;
    print(file.bytes);
    printed = true;
  }
  flush_output();
  if (printed && output_error_ != 0 && output_error_ != EPIPE) return false;   // reported by `finish`
  const auto refused = trace::OutputFile::commit_all(staged);
  return !refused || taken(*refused, false);
}

int Session::deliver(const std::string& output, std::string bytes) {
  if (output.empty()) print(bytes);
  else if (!write_files({{output, std::move(bytes)}})) return kErrors;
  return exit_code();
}

int Session::finish(int code) {
  flush_output();
  if (output_error_ != 0 && output_error_ != EPIPE) {
    report(Kind::kCannotWrite, {"standard output", source::reason(output_error_)});
    code = kErrors;
  }
  if (sarif_) tell(sarif_->print());
  const std::string counts = diagnostics::summary(errors_, warning_count_);
  if (!counts.empty() && says_text()) remark(counts);
  if (code == kClean && untold_) return kErrors;   // who reads messages from a file must not take a full disk for a clean run
  return code == kClean ? exit_code() : code;
}

namespace {
constexpr auto kFirst = std::chrono::milliseconds(500), kNext = std::chrono::milliseconds(100);
constexpr auto kInLog = std::chrono::minutes(1);
}

Progress::Progress(const Session& session, std::string_view what)
    : what_(what), terminal_(is_terminal(STDERR_FILENO)), on_(!session.quiet() && (terminal_ || session.says_text())), next_(began_ + (terminal_ ? std::chrono::milliseconds(kFirst) : kInLog)) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

std::string Progress::time_left(std::uint64_t done, std::uint64_t total) const {
  if (done <= before_ || done >= total) return {};
  const double gone_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  const auto left_s = static_cast<std::uint64_t>(gone_s / static_cast<double>(done - before_) * static_cast<double>(total - done)) + 1;
  return left_s < 90 ? ", " + std::to_string(left_s) + " s left" : ", " + std::to_string((left_s + 30) / 60) + " min left";
}

void Progress::show(std::uint64_t done, std::uint64_t total) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_ || now < next_) return;
  next_ = now + (terminal_ ? std::chrono::milliseconds(kNext) : kInLog);
  shown_ = terminal_;
  const std::string of = total == 0 ? "" : " of " + std::to_string(total);
  std::fprintf(stderr, "%s%llu%s %s%s%s", terminal_ ? "\r\x1b[K" : "", static_cast<unsigned long long>(done), of.c_str(), what_.c_str(), time_left(done, total).c_str(),
               terminal_ ? "" : "\n");
  std::fflush(stderr);
}

void Progress::update(std::uint64_t done) {
  if ((++calls_ & 0xFFu) == 0) show(done);
}

}  // namespace kb::cli
