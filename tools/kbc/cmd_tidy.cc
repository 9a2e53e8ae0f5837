// kbc tidy: mends a recording so that it can be played.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

#include "compiler/diagnostics/display.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/stream.h"
#include "tools/kbc/trace/tidy.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kMostLines = 5;   // that a message names

struct TidyCommand {
  std::string file, output, clock = "drop", duplicates = "keep", last = "drop";

  [[nodiscard]] trace::TidyOptions how() const {
    using enum trace::TidyOptions::Clock;
    return {clock == "shift" ? kShift : clock == "sort" ? kSort : kDrop, duplicates == "drop", last == "drop"};
  }
};

std::string lines_text(const trace::TidyChange& change) {
  std::string text = fmt::format("{}: line{} ", diagnostics::counted(change.lines.size(), "row"), change.lines.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(change.lines.size(), kMostLines); ++i) text += fmt::format("{}{}", i == 0 ? "" : ", ", change.lines[i]);
  return text + (change.lines.size() > kMostLines ? ", ..." : "");
}

int run(const TidyCommand& options, Session& session) {
  std::string error;
  const auto bytes = trace::read_all(options.file, kMostBytes, error);
  if (!bytes) {
    session.report(Kind::kCannotRead, {options.file, error.empty() ? "is too large" : error});
    return kErrors;
  }
  if (options.file != "-") session.note_input(options.file);
  const auto tidied = trace::tidied(*bytes, options.how());
  if (!tidied) {
    session.report(Kind::kFactsNoHeader, {options.file});
    return kErrors;
  }
  if (tidied->needed) {
    session.report(Kind::kTidyNeeded, {options.file, std::to_string(*tidied->needed)});
    return kErrors;
  }
  for (const trace::TidyChange& change : tidied->changes) session.report(Kind::kTidyChanged, {change.what, lines_text(change)});
  const int code = session.deliver(options.output, tidied->bytes);
  if (code == kClean) session.remark(fmt::format("{} of {}{}{}", tidied->kept, diagnostics::counted(tidied->rows, "row"), tidied->changes.empty() ? ", as they were" : "",
                                            tidied->timed ? "" : " (without a column `t`, so there is no clock to mend)"));
  return code;
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
