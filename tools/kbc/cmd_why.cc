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

// Without --tick: the ticks on which a rule fired; if there are none, the one on which it came nearest.
struct Search {
  program::Record nearest;
  trace::Nearness near{UINT32_MAX, 0.0};
  std::vector<std::uint64_t> fired;   // ticks, each once, whichever instances fired
};

// Leaves the first tick on which one of the rules fired in the recorder, which then has no more to do.
void consider(const program::Program& program, const std::vector<program::RuleId>& rules, const program::Tick& tick,
              program::Recorder& recorder, Search& search) {
  if (std::ranges::find_first_of(tick.fired, rules) != tick.fired.end()) search.fired.push_back(tick.number);
  if (!search.fired.empty()) return;
  for (const program::RuleId rule : rules) {
    const trace::Nearness near = trace::nearness(program, recorder.record(), rule);
    if (!(near < search.near)) continue;
    search.near = near;
    search.nearest = recorder.record();
  }
  recorder.go_on();
}

// "7, 9-12": at most ten such pieces, the others counted.
std::string ranges(const std::vector<std::uint64_t>& ticks) {
  constexpr std::size_t kMost = 10;
  std::string out;
  std::size_t pieces = 0;
  for (std::size_t from = 0, to = 0; from < ticks.size(); from = to, ++pieces) {
    if (pieces == kMost) return out + fmt::format(", and {} more", ticks.size() - from);
    to = from + 1;
    while (to < ticks.size() && ticks[to] == ticks[to - 1] + 1) ++to;
    out += fmt::format("{}{}", pieces == 0 ? "" : ", ", ticks[from]);
    if (to - from > 1) out += fmt::format("-{}", ticks[to - 1]);
  }
  return out;
}

std::string found(const std::string& rule, const Search& search, std::uint64_t ticks) {
  const std::string of = diagnostics::counted(ticks, "tick");
  if (search.fired.empty()) return fmt::format("`{}` did not fire in {}. It came nearest at tick {}:\n", rule, of, search.nearest.tick.number);
  if (search.fired.size() == 1) return fmt::format("`{}` fired once in {}:\n", rule, of);
  return fmt::format("`{}` fired on {} of {}: {}. The first:\n", rule, search.fired.size(), of, ranges(search.fired));
}

// Runs up to the tick in question, or with `search` to the end. False (reported) if there is no such tick or the facts are wrong.
bool replay(const WhyOptions& options, trace::FactsReader& reader, const program::Program& program, program::Recorder& recorder,
            trace::Senses& senses, const trace::Question& question, Search* search, diagnostics::Diagnostics& diagnostics) {
  program::Interpreter interpreter(program);
  interpreter.observe(&recorder);
  while (search != nullptr || reader.rows() < options.tick) {
    const trace::FactsRow* row = reader.next();
    if (row == nullptr) break;
    const auto facts = senses.look(*row, [&](CellId cell) { return interpreter.value(cell); });
    const program::Tick tick = interpreter.tick(facts, row->dt_us);
    recorder.tick_ended(tick, interpreter);
    if (search != nullptr) consider(program, question.rules, tick, recorder, *search);
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
  const bool any = options.tick == 0;
  program::Recorder recorder(program, any ? 1 : options.tick);
  trace::Senses senses(program, trace::EngineKind::kInterpreter);
  Search search;
  if (!replay(options, *input.reader, program, recorder, senses, *question, any ? &search : nullptr, diagnostics)) return kErrors;
  const program::Record& record = any && search.fired.empty() ? search.nearest : recorder.record();
  const trace::Answer answer = trace::answer(program, record, *question);
  if (any && !options.json) session.print(found(options.rule, search, input.reader->rows()));
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
                              "The tick in question; the first is 1. Without it --rule says on which ticks the rule fired, and explains the "
                              "first of them, or the tick on which it came nearest")
                   ->type_name("TICK")
                   ->check(is_tick());
  auto* rule = app.add_option("--rule", options->rule,
                              "A rule as written (all its instances, the nearest to firing first), or one instance")->type_name("RULE");
  auto* cell = app.add_option("--cell", options->cell, "A fact or a satellite: who wrote it, and what would raise it")->type_name("CELL");
  auto* strategy = app.add_option("--strategy", options->strategy, "A strategy: why it runs or does not")->type_name("STRATEGY");
  rule->excludes(cell)->excludes(strategy);
  cell->excludes(strategy);
  app.parse_complete_callback([tick, rule] {
    if (tick->empty() && rule->empty()) throw CLI::RequiredError("--tick, or --rule, which finds it,");
  });
  app.add_flag("--all", options->all, "Spell out all rules, not only the five nearest");
  app.add_flag("--json", options->json, "The answer as JSON");
  return [options](Session& session) { return why(*options, session); };
}

}  // namespace kb::cli
