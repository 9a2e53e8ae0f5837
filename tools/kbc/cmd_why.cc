// kbc why: the reasons for what happened at a tick.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/recorded_input.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/facts_csv.h"
#include "tools/kbc/trace/senses.h"
#include "tools/kbc/trace/why.h"
#include "tools/kbc/trace/why_search.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
using program::CellId;

struct WhyOptions {
  std::string file;
  RecordedOptions recorded;
  std::uint64_t tick = 0;
  std::string rule, cell, strategy;
  bool json = false, all = false;
  [[nodiscard]] const std::string& asked() const { return !rule.empty() ? rule : !cell.empty() ? cell : strategy; }
};

// The question with the program's ids; nothing (reported) if a name in it is unknown.
std::optional<trace::Question> understand(const WhyOptions& options, const program::Program& program,
                                          diagnostics::Diagnostics& diagnostics) {
  const trace::CellNames names(program);
  trace::Question question;
  if (!options.rule.empty()) {
    question.rules = trace::find_rules(program, options.rule);
    if (!question.rules.empty()) return question;
    diagnostics.report(Kind::kWhyNoRule, {}, {options.rule}).suggest(trace::closest_rule(program, options.rule));
  } else if (!options.cell.empty()) {
    question.cell = names.find(options.cell);
    if (question.cell != CellId::kNone) return question;
    diagnostics.report(Kind::kWhyNoCell, {}, {options.cell}).suggest(names.closest(options.cell));
  } else if (!options.strategy.empty()) {
    question.strategy = names.find(options.strategy);
    if (question.strategy != CellId::kNone && program[question.strategy].kind == program::CellKind::kStrategy)
      return question;
    diagnostics.report(Kind::kWhyNoStrategy, {}, {options.strategy})
        .suggest(names.closest(options.strategy, program::CellKind::kStrategy));
  } else {
    return question;
  }
  return std::nullopt;
}

// Runs up to the tick in question, or with `search` to the end. False (reported) if there is no such tick or the facts are wrong.
bool replay(const WhyOptions& options, trace::FactsReader& reader, const program::Program& program, program::Recorder& recorder,
            trace::Senses& senses, trace::WhySearch* search, diagnostics::Diagnostics& diagnostics) {
  program::Interpreter interpreter(program);
  interpreter.observe(&recorder);
  while (search != nullptr || reader.rows() < options.tick) {
    const trace::FactsRow* row = reader.next();
    if (row == nullptr) break;
    const auto facts = senses.look(*row, [&](CellId cell) { return interpreter.value(cell); });
    const program::Tick tick = interpreter.tick(facts, row->dt_us);
    recorder.tick_ended(tick, interpreter);
    if (search != nullptr) search->consider(tick, recorder);
  }
  if (reader.failed()) return false;
  if (search != nullptr ? reader.rows() > 0 : reader.rows() == options.tick) return true;
  diagnostics.report(Kind::kWhyNoTick, {},
                     {fmt::format("{}", std::max<std::uint64_t>(options.tick, 1)), options.recorded.path(), diagnostics::counted(reader.rows(), "tick")});
  return false;
}

int why(const WhyOptions& options, Session& session) {
  const auto compiled = session.load(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  const program::Program& program = compiled->program;
  auto diagnostics = session.diagnostics(compiled->sources);
  const auto question = understand(options, program, diagnostics);
  if (!question) return kErrors;
  const RecordedInput input = open_recorded(options.recorded, options.file, *compiled, diagnostics);
  if (!input.reader) return kErrors;
  program::Recorder recorder(program, std::max<std::uint64_t>(options.tick, 1));
  trace::Senses senses(program, trace::EngineKind::kInterpreter);
  std::optional<trace::WhySearch> search;
  if (options.tick == 0) search.emplace(program, *question);
  if (!replay(options, *input.reader, program, recorder, senses, search ? &*search : nullptr, diagnostics)) return kErrors;
  const program::Record& record = search ? search->record(recorder) : recorder.record();
  trace::Answer answer = trace::answer(program, record, *question);
  if (search) answer.ticks = search->ticks();
  if (search && !options.json) session.print(search->print(options.asked(), input.reader->rows()));
  session.print(options.json ? trace::print_json(program, record, answer) + "\n"
                             : trace::print(program, record, answer, options.all ? SIZE_MAX : 5));
  if (!options.json && question->cell != CellId::kNone) session.print(senses.explain(question->cell));
  return session.exit_code();
}

}  // namespace

Run setup_why(CLI::App& app) {
  auto options = std::make_shared<WhyOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  add_recorded_options(app, options->recorded);
  auto* tick = app.add_option("--tick", options->tick,
                              "The tick in question; the first is 1. Without it: on which ticks the rule fired, the cell changed or the strategy "
                              "ran, and why on the first of them, or why not on the tick on which it came nearest")
                   ->type_name("TICK")
                   ->check(is_tick());
  auto* rule = app.add_option("--rule", options->rule,
                              "A rule as written (all its instances, the nearest to firing first), or one instance")->type_name("RULE");
  auto* cell = app.add_option("--cell", options->cell, "A fact or a satellite: who wrote it, and what would raise it")->type_name("CELL");
  auto* strategy = app.add_option("--strategy", options->strategy, "A strategy: why it runs or does not")->type_name("STRATEGY");
  rule->excludes(cell)->excludes(strategy);
  cell->excludes(strategy);
  app.parse_complete_callback([tick, rule, cell, strategy] {
    if (tick->empty() && rule->empty() && cell->empty() && strategy->empty()) throw CLI::RequiredError("--tick, or a --rule, --cell or --strategy, which finds it,");
  });
  app.add_flag("--all", options->all, "Spell out all rules, not only the five nearest");
  app.add_flag("--json", options->json, "The answer as JSON");
  return [options](Session& session) { return why(*options, session); };
}

}  // namespace kb::cli
