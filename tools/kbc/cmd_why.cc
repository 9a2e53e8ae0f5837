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

// What to do about a group or a pattern: each answer is about one.
std::string name_one(const std::vector<std::string_view>& members) {
  return members.size() < 2 ? std::string() : fmt::format("; name one of its {}: {}", members.size(), diagnostics::listed(members, 8));
}

// The question with the program's ids; nothing (reported) if a name in it is unknown.
std::optional<trace::Question> understand(const WhyOptions& options, const program::Program& program,
                                          diagnostics::Diagnostics& diagnostics) {
  const trace::CellNames names(program);
  trace::Question question;
  if (options.all) question.detail = program::Detail::kAll;
  if (!options.rule.empty()) {
    question.rules = trace::find_rules(program, options.rule);
    if (!question.rules.empty()) return question;
    diagnostics.report(Kind::kWhyNoRule, {}, {options.rule}).suggest(trace::closest_rule(program, options.rule));
  } else if (!options.cell.empty()) {
    const CellId cell = names.find(options.cell);
    const bool runs = cell != CellId::kNone && program[cell].kind == program::CellKind::kStrategy;
    (runs ? question.strategy : question.cell) = cell;   // of a strategy's cell there is no more to say
    if (cell != CellId::kNone) return question;
    const auto members = names.members(options.cell);
    diagnostics.report(Kind::kWhyNoCell, {}, {options.cell, name_one(members)}).suggest(members.size() > 1 ? std::nullopt : names.closest(options.cell));
  } else if (!options.strategy.empty()) {
    question.strategy = names.find(options.strategy);
    if (question.strategy != CellId::kNone && program[question.strategy].kind == program::CellKind::kStrategy)
      return question;
    const auto members = names.members(options.strategy, program::CellKind::kStrategy);
    diagnostics.report(Kind::kWhyNoStrategy, {}, {options.strategy, name_one(members)})
        .suggest(members.size() > 1 ? std::nullopt : names.closest(options.strategy, program::CellKind::kStrategy));
  } else {
    return question;
  }
  return std::nullopt;
}

// Makes the decisions of a recording again and keeps what there is to know of one tick: the one in question, or the one that a search finds.
class Replay {
 public:
  Replay(const program::Program& program, const trace::Question& question, std::uint64_t tick)
      : program_(program), question_(question), tick_(tick), recorder_(program, std::max<std::uint64_t>(tick, 1)), senses_(program, trace::EngineKind::kInterpreter) {
    if (tick == 0) search_.emplace(program, question);
    if (asks_for(program::CellKind::kSatellite)) recorder_.watch(question.cell);
  }
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  // To the tick in question, or with a search to the end. False if the facts are wrong (reported), or if there is no such tick.
  [[nodiscard]] bool run(trace::FactsReader& reader, bool readings) {
    program::Interpreter interpreter(program_);
    interpreter.observe(&recorder_);
    if (!readings) recorder_.facts_are_given(reader.given());
    while (search_ || reader.rows() < tick_) {
      const trace::FactsRow* row = reader.next();
      if (row == nullptr) break;
      const auto facts = senses_.look(*row, [&](CellId cell) { return interpreter.value(cell); });
      const program::Tick tick = interpreter.tick(facts, row->dt_us);
      recorder_.tick_ended(tick, interpreter);
      if (search_) search_->consider(tick, recorder_);
      if (asks_for(program::CellKind::kFact) && record().tick.number == tick.number) sighting_ = sighted(facts[index(question_.cell)]);
    }
    return !reader.failed() && (search_ ? reader.rows() > 0 : reader.rows() == tick_);
  }
  [[nodiscard]] const program::Record& record() const { return search_ ? search_->record(recorder_) : recorder_.record(); }
  [[nodiscard]] const std::optional<trace::WhySearch>& search() const { return search_; }
  // How the fact in question was perceived, or badly given; nothing if neither.
  [[nodiscard]] const std::optional<trace::Sighting>& sighting() const { return sighting_; }

 private:
  [[nodiscard]] bool asks_for(program::CellKind kind) const { return question_.cell != CellId::kNone && program_[question_.cell].kind == kind; }
  [[nodiscard]] std::optional<trace::Sighting> sighted(float certainty) const {
    auto perceived = senses_.explain(question_.cell);
    if (perceived || program::is_certainty(certainty)) return perceived;
    return trace::Sighting{std::string(program_[question_.cell].name), {}, certainty, record().cf_after[index(question_.cell)]};
  }

  const program::Program& program_;
  const trace::Question& question_;
  std::uint64_t tick_;   // 0: to be searched
  program::Recorder recorder_;
  trace::Senses senses_;
  std::optional<trace::WhySearch> search_;
  std::optional<trace::Sighting> sighting_;
};

int why(const WhyOptions& options, Session& session) {
  const auto compiled = session.load(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  const program::Program& program = compiled->program;
  auto diagnostics = session.diagnostics(compiled->sources);
  const auto question = understand(options, program, diagnostics);
  if (!question) return kErrors;
  const RecordedInput input = open_recorded(options.recorded, options.file, *compiled, diagnostics);
  if (!input.reader) return kErrors;
  Replay replay(program, *question, options.tick);
  if (!replay.run(*input.reader, options.recorded.has_readings())) {
    if (!input.reader->failed()) {
      diagnostics.report(Kind::kWhyNoTick, {}, {fmt::format("{}", std::max<std::uint64_t>(options.tick, 1)), options.recorded.path(),
                                                diagnostics::counted(input.reader->rows(), "tick")});
    }
    return kErrors;
  }
  trace::Answer answer = trace::answer(program, replay.record(), *question);
  if (replay.search()) {
    answer.ticks = replay.search()->ticks();
    answer.values = replay.search()->values();
    answer.within = replay.search()->within();
  }
  answer.sighting = replay.sighting();
  if (options.json) {
    session.print(trace::print_json(program, replay.record(), answer) + "\n");
    return session.exit_code();
  }
  if (replay.search()) session.print(replay.search()->print(options.asked(), input.reader->rows()));
  session.print(trace::print(program, replay.record(), answer, options.all ? SIZE_MAX : 5));
  return session.exit_code();
}

}  // namespace

Run setup_why(CLI::App& app) {
  auto options = std::make_shared<WhyOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  add_recorded_options(app, options->recorded);
  auto* tick = app.add_option("--tick", options->tick,
                              "The tick in question; the first is 1. Without it: on which ticks the rule fired, the satellite changed, the fact was seen or the "
                              "strategy ran, and why on the first of them, or why not on the tick on which it came nearest")
                   ->type_name("TICK")
                   ->transform(is_tick());
  auto* rule = app.add_option("--rule", options->rule,
                              "A rule as written (all its instances, the nearest to firing first), or one instance")->type_name("RULE");
  auto* cell = app.add_option("--cell", options->cell, "A fact or a satellite: who wrote it, and what would raise it")->type_name("CELL");
  auto* strategy = app.add_option("--strategy", options->strategy, "A strategy: why it runs or does not")->type_name("STRATEGY");
  rule->excludes(cell)->excludes(strategy);
  cell->excludes(strategy);
  app.parse_complete_callback([tick, rule, cell, strategy] {
    if (tick->empty() && rule->empty() && cell->empty() && strategy->empty()) throw CLI::RequiredError("--tick, or a --rule, --cell or --strategy, which finds it,");
  });
  app.add_flag("--all", options->all, "Spell out all rules and alternatives, not only the nearest");
  app.add_flag("--json", options->json, "The answer as JSON");
  return [options](Session& session) { return why(*options, session); };
}

}  // namespace kb::cli
