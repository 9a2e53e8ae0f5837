// kbc tidy: mends a recording so that it can be played.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "compiler/diagnostics/display.h"
#include "compiler/source/source.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/stream.h"
#include "tools/kbc/trace/tidy.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct TidyCommand {
  std::string file, output, clock = "drop", duplicates = "keep", last = "drop";

  [[nodiscard]] trace::TidyOptions how() const {
    using enum trace::TidyOptions::Clock;
    return {clock == "shift" ? kShift : clock == "sort" ? kSort : kDrop, duplicates == "drop", last == "drop"};
  }
};

std::string lines_text(const trace::TidyChange& change) {
  return fmt::format("{}: line{} {}{}", diagnostics::counted(change.rows, "row"), change.rows == 1 ? "" : "s", fmt::join(change.lines, ", "),
                     change.rows > change.lines.size() ? ", ..." : "");
}

void report(const std::string& file, const trace::Tidied& tidied, Session& session) {
  using Fault = trace::Tidied::Fault;
  if (tidied.fault == Fault::kNoHeader) return session.report(Kind::kFactsNoHeader, {file});
  source::Sources sources;
  const source::Span place = trace::excerpt(sources, file, {.text = tidied.text, .number = tidied.line}, 0, 1);
  auto messages = session.diagnostics(sources);
  if (tidied.fault == Fault::kTooLong) messages.report(Kind::kFactsLineTooLong, place, {std::to_string(trace::LineReader::kMaxLineBytes)});
  else if (tidied.fault == Fault::kNeeded) messages.report(Kind::kTidyNeeded, place, {});
  else messages.report(Kind::kTidyTooFar, place, {std::to_string(trace::kMostSorted >> 20)});
}

int run(const TidyCommand& options, Session& session) {
  std::optional<Interrupts> interrupts(std::in_place);   // so that no half of the output is left behind
  const auto failed = [&](Kind kind, const std::string& name, const std::string& error) {
    session.report(kind, {name, error});
    return kErrors;
  };
  std::string error;
  const auto bytes = trace::open_stream(options.file, error, Interrupts::came);
  if (!bytes) return failed(Kind::kCannotRead, options.file, error);
  if (options.file != "-") session.note_input(options.file);
  trace::OutputFile file;
  if (!session.open_output(file, options.output.empty() ? "-" : options.output)) return kErrors;
  if (!file.stays_beside()) interrupts.reset();
  const trace::Tidied tidied = trace::mend(*bytes, options.how(), [&](std::string_view text) { return file.write(text), !file.failed(); });
  if (Interrupts::came()) return kInterrupted;
  const auto cannot_write = [&] { return failed(Kind::kCannotWrite, options.output.empty() ? "standard output" : options.output, file.error()); };
  if (file.failed()) return cannot_write();
  if (!bytes->error().empty()) return failed(Kind::kCannotRead, options.file, bytes->error());
  if (tidied.fault != trace::Tidied::Fault::kNone) {
    report(options.file, tidied, session);
    return kErrors;
  }
  for (const trace::TidyChange& change : tidied.changes) session.report(Kind::kTidyChanged, {change.what, lines_text(change)});
  if (!file.commit()) return cannot_write();
  session.remark(fmt::format("{} of {}{}{}", tidied.kept, diagnostics::counted(tidied.rows, "row"), tidied.changes.empty() ? ", as they were" : "",
                             tidied.timed ? "" : " (without a column `t`, so there is no clock to mend)"));
  return session.exit_code();
}

}  // namespace

Run setup_tidy(CLI::App& app) {
  auto options = std::make_shared<TidyCommand>();
  app.add_option("RECORDING", options->file, "Facts or readings, CSV, or JSON lines of `kbc drive`; - for standard input")->required();
  app.add_option("-o,--output", options->output, "Write to this file, not to standard output")->type_name("FILE");
  app.add_option("--clock", options->clock, "A row that is earlier than one before it: leave it out (drop), make it and all after it later (shift), put it where its time belongs (sort)")
      ->check(CLI::IsMember({"drop", "shift", "sort"}))->capture_default_str();
  app.add_option("--duplicates", options->duplicates, "A row with the same bytes as the one before it: keep, drop")->check(CLI::IsMember({"keep", "drop"}))->capture_default_str();
  app.add_option("--last-row", options->last, "A last row that is half written, or has no line end: keep, drop")->check(CLI::IsMember({"keep", "drop"}))->capture_default_str();
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
