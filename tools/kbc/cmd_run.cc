// kbc run: facts in, decisions out.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "compiler/diagnostics/display.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/recorded_input.h"
#include "tools/kbc/recorded_page.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/conflict_tally.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/facts_csv.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/senses.h"
#include "tools/kbc/trace/table.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct RunOptions {
  std::string file;
  RecordedOptions recorded;
  std::string trace, html;
  bool table = false, conflicts = false;
  trace::TableOptions shown;
  std::string ticks;
  std::string engine = "tables";
};

// Something that should not happen: how often it happened, and at which tick first.
struct Faults {
  std::uint64_t count = 0, tick = 0;
  std::int64_t time_us = 0;
  std::string what;   // the first of them, if that is known

  void add(std::uint64_t more, const program::Tick& at) {
    if (count == 0) {
      tick = at.number;
      time_us = at.time_us;
    }
    count += more;
  }
  [[nodiscard]] std::string text(std::string_view one) const {
    const std::string first = count == 0 ? "" : fmt::format(" (first at tick {}, {:g} s{}{})", tick, static_cast<double>(time_us) / 1e6, what.empty() ? "" : ": ", what);
    return diagnostics::counted(count, one) + first;
  }
};

struct Counts {
  std::uint64_t ticks = 0, events = 0;
  Faults conflicts, bad_facts, bad_readings;
  trace::Looks looks;

  void add(const program::Tick& tick, std::span<const float> facts, const program::Program& program, const trace::Looks& so_far) {
    ++ticks;
    events += tick.events.size();
    conflicts.add(tick.conflicts.size(), tick);
    if (tick.bad_facts > 0 && bad_facts.count == 0) {
      const auto bad = std::ranges::find_if_not(facts, program::is_certainty);
      if (bad != facts.end()) bad_facts.what = fmt::format("`{}` is {}", program.cells[static_cast<std::size_t>(bad - facts.begin())].name, *bad);
    }
    bad_facts.add(tick.bad_facts, tick);
    bad_readings.add(so_far.bad - looks.bad, tick);
    looks = so_far;
  }
  /// What went wrong, in words; empty: nothing.
  [[nodiscard]] std::string faults_text() const {
    std::string text;
    if (conflicts.count > 0) text = conflicts.text("conflict");
    if (bad_facts.count > 0) text += (text.empty() ? "" : ", ") + bad_facts.text("bad fact");
    return text;
  }
};

// Everything that takes the ticks of a run.
struct Sinks {
  enum File : std::size_t { kTrace, kPage, kFiles };
  std::array<trace::OutputFile, kFiles> files;   // those that are not open are not written
  trace::OutputFile* trace = nullptr;
  std::optional<trace::Table> table;
  std::optional<trace::ConflictTally> conflicts;
  std::optional<RecordedPage> page;

  /// Whether what is written stays hidden until all is.
  [[nodiscard]] bool stays_beside() const { return std::ranges::any_of(files, &trace::OutputFile::stays_beside); }
};

bool open_sinks(const RunOptions& options, const program::Program& program, Sinks& sinks, Session& session,
                diagnostics::Diagnostics& diagnostics) {
  if (options.table) {
    trace::TableOptions shown = options.shown;
    if (!options.ticks.empty()) shown.ticks = trace::parse_ticks(options.ticks);
    sinks.table.emplace(program, std::move(shown));
    const std::vector<std::string> vain = trace::vain_patterns(program, options.shown.cells);
    for (const std::string& pattern : vain) diagnostics.report(Kind::kCellsNone, {}, {pattern}).suggest(trace::meant_by(program, pattern));
    if (!vain.empty()) return false;
  }
  if (options.conflicts) sinks.conflicts.emplace(program);
  if (!options.html.empty()) {
    if (!session.open_output(sinks.files[Sinks::kPage], options.html)) return false;
    sinks.page.emplace(program, fmt::format("{} on {}", options.file, options.recorded.path()));
  }
  if ((options.table || options.conflicts || sinks.page) && options.trace.empty()) return true;
  const std::string path = options.trace.empty() ? "-" : options.trace;
  sinks.trace = &sinks.files[Sinks::kTrace];
  return session.open_output(*sinks.trace, path);
}

// Gives the tick to all sinks. True if they could take it.
bool take(const program::Tick& tick, const trace::Engine& engine, const program::Program& program, Sinks& sinks,
          diagnostics::Diagnostics& diagnostics) {
  if (!engine.disagreement().empty()) {
    diagnostics.report(Kind::kEnginesDisagree, {}, {fmt::format("{}", tick.number), engine.disagreement()});
    return false;
  }
  if (sinks.trace) {
    sinks.trace->write(print_json(program, tick));
    sinks.trace->write("\n");
    if (sinks.trace->failed()) return true;  // reported once, when the file is closed
  }
  if (sinks.conflicts) sinks.conflicts->add(tick);
  if (sinks.page && !sinks.page->add(tick, engine)) {
    diagnostics.report(Kind::kPageTooLong, {}, {diagnostics::counted(RecordedPage::kMostTicks, "tick")});
    return false;
  }
  if (!sinks.table || sinks.table->add(tick, [&](program::CellId cell) { return engine.value(cell); })) return true;
  diagnostics.report(Kind::kTableTooLarge, {}, {fmt::format("{} values", trace::Table::kMaxValues)});
  return false;
}

// Runs all rows. False if something was reported.
bool play(trace::FactsReader& reader, trace::Engine& engine, trace::Senses& senses, const program::Program& program, Sinks& sinks,
          Counts& counts, Session& session, diagnostics::Diagnostics& diagnostics) {
  Progress progress(session, "ticks");
  for (const trace::FactsRow* row = reader.next(); row != nullptr && !Interrupts::came(); row = reader.next()) {
    const auto facts = senses.look(*row, [&](program::CellId cell) { return engine.value(cell); });
    program::Tick tick = engine.tick(facts, row->dt_us);
    tick.perceived = senses.changed();
    if (!senses.disagreement().empty()) {
      diagnostics.report(Kind::kEnginesDisagree, {}, {fmt::format("{}", tick.number), senses.disagreement()});
      return false;
    }
    if (!take(tick, engine, program, sinks, diagnostics)) return false;
    if (sinks.trace && sinks.trace->failed()) break;
    counts.add(tick, facts, program, senses.looks());
    progress.update(counts.ticks);
  }
  return !reader.failed();
}

// False (reported) if the recording ends before the first tick that the table is to show.
bool has_ticks(const RunOptions& options, const Sinks& sinks, const Counts& counts, diagnostics::Diagnostics& diagnostics) {
  const auto wanted = trace::parse_ticks(options.ticks);
  const bool cut_off = sinks.trace != nullptr && sinks.trace->failed();   // reported when it is closed
  if (!wanted || cut_off || wanted->first <= counts.ticks) return true;
  diagnostics.report(Kind::kWhyNoTick, {},
                     {fmt::format("{}", wanted->first), options.recorded.path(), diagnostics::counted(counts.ticks, "tick")});
  return false;
}

bool close_sinks(const RunOptions& options, Sinks& sinks, const Counts& counts, Session& session, diagnostics::Diagnostics& diagnostics) {
  if (sinks.page) sinks.files[Sinks::kPage].write(sinks.page->html(counts.faults_text()));
  if (const auto refused = trace::OutputFile::commit_all(sinks.files)) {
    const std::string& path = *refused == Sinks::kPage ? options.html : options.trace;
    diagnostics.report(Kind::kCannotWrite, {}, {path.empty() || path == "-" ? "standard output" : path, sinks.files[*refused].error()});
    return false;
  }
  if (sinks.table) session.print(sinks.table->print());
  if (sinks.conflicts) session.print((sinks.table ? "\n" : "") + sinks.conflicts->print());
  return true;
}

void summarise(const RunOptions& options, const Counts& counts, Session& session) {
  using diagnostics::counted;
  session.remark(fmt::format("{}, {}, {}, {}", counted(counts.ticks, "tick"), counted(counts.events, "event"), counts.conflicts.text("conflict"),
                             counts.bad_facts.text("bad fact")));
  if (!options.recorded.has_readings()) return;
  session.remark(fmt::format("{}, {} perceived, {} asleep, {}", counted(counts.looks.fits, "fit"), counted(counts.looks.facts, "fact"),
                             counts.looks.asleep, counts.bad_readings.text("bad reading")));
}

int run(const RunOptions& options, Session& session) {
  const auto compiled = session.load(options.file, driver::Stage::kTables);
  if (!compiled->ok()) return kErrors;
  const program::Program& program = compiled->program;
  auto diagnostics = session.diagnostics(compiled->sources);
  const RecordedInput input = open_recorded(options.recorded, options.file, *compiled, diagnostics);
  std::optional<Interrupts> interrupts(std::in_place);   // before the trace is opened, so that an interrupt leaves no half of it behind
  Sinks sinks;
  if (!input.reader || !open_sinks(options, program, sinks, session, diagnostics)) return kErrors;
  if (!sinks.stays_beside()) interrupts.reset();
  const trace::EngineKind kind = *trace::find_engine(options.engine);
  const auto engine = make_engine(kind, *compiled);
  trace::Senses senses(program, kind);
  Counts counts;
  if (sinks.trace) input.bytes->before_read = [&] { sinks.trace->flush(); };   // for a program that writes facts and reads what they lead to
  if (!play(*input.reader, *engine, senses, program, sinks, counts, session, diagnostics)) return kErrors;
  if (Interrupts::came()) return kInterrupted;
  if (!has_ticks(options, sinks, counts, diagnostics) || !close_sinks(options, sinks, counts, session, diagnostics)) return kErrors;
  summarise(options, counts, session);
  return session.exit_code();
}

}  // namespace

Run setup_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  add_recorded_options(app, options->recorded);
  auto* trace = app.add_option("--trace", options->trace,
                 "Write the trace to this file, JSON lines; without it, --table, --conflicts and --html, to standard output")
      ->type_name("FILE");
  auto* html = app.add_option("--html", options->html, "Write a page that plays the run and explains each decision to this file")->type_name("FILE");
  auto* table =
      app.add_flag("--table", options->table, "Print cells by ticks: the cells that change, at ticks when one does; and the strategy that runs, if the cells do not show it");
  app.add_option("--cells", options->shown.cells, "With --table: of the cells that match, such as 'Move.* sat LM?', those that change; a name in full, such as Gate, is always shown")->type_name("NAMES")
      ->needs(table);
  app.add_option("--ticks", options->ticks, "With --table: these ticks, such as 7, 7-19, 7-")->type_name("TICKS")
      ->needs(table)
      ->check(is_tick_range());
  app.add_flag("--all", options->shown.all, "With --table: all cells and all ticks, changed or not")->needs(table);
  auto* conflicts = app.add_flag("--conflicts", options->conflicts,
                                 "Print which rules contradicted each other on which cell, on how many ticks, and on which first; the most frequent first");
  add_engine_option(app, options->engine);
  refuse_shared_standard_output(app, {trace, table, conflicts, html});
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
