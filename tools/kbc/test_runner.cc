#include "tools/kbc/test_runner.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "compiler/analysis/analysis.h"
#include "planners/crew.h"
#include "tools/kbc/interrupts.h"

namespace kb::cli {

using trace::CaseResult;
using trace::TestCase;

TestRunner::TestRunner(const How& how, const std::vector<TestCase>& cases, Session& session)
    : how_(how), cases_(cases), session_(session) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (i == 0 || cases[i].program != cases[i - 1].program) knowledge_.emplace_back();
    running_.push_back(std::make_unique<Running>());
    running_.back()->knowledge = &knowledge_.back();
    knowledge_.back().end = i + 1;
  }
}

void TestRunner::run_case(std::size_t number) {
  const TestCase& test = cases_[number];
  Running& running = *running_[number];
  Knowledge& knowledge = *running.knowledge;
  diagnostics::Keeping keeping(running.messages);
  diagnostics::Diagnostics messages(running.sources, keeping, session_.warnings());
  if (!program_is_there(test, running.sources, messages)) {
    running.result.report = test.program + " cannot be read";
    return;
  }
  std::call_once(knowledge.once, [&] { knowledge.compiled = session_.compile_unheard(test.program, driver::Stage::kTables, knowledge.messages); });
  running.compiled = true;
  if (!knowledge.compiled->ok()) {
    running.result.report = test.program + " does not compile";
    return;
  }
  if (how_.coverage) running.coverage.emplace(knowledge.compiled->program);
  running.result = trace::run_case(test, knowledge.compiled->program, knowledge.compiled->tables,
                                   {.engine = how_.engine,
                                    .update = how_.update,
                                    .coverage = running.coverage ? &*running.coverage : nullptr,
                                    .stop = Interrupts::came},
                                   running.sources, messages);
}

void TestRunner::tell_of(std::size_t number, const Tell& tell) {
  Running& running = *running_[number];
  Knowledge& knowledge = *running.knowledge;
  if (running.compiled) session_.pass_on(knowledge.compiled->sources, std::exchange(knowledge.messages, {}));
  session_.pass_on(running.sources, running.messages);
  tell(cases_[number], running.result);
  results_.push_back(std::move(running.result));
  if (running.coverage) {
    if (!knowledge.coverage) knowledge.coverage.emplace(knowledge.compiled->program);
    knowledge.coverage->add(*running.coverage);
  }
  running_[number].reset();
  if (number + 1 < knowledge.end) return;
  if (knowledge.coverage) summarise(cases_[number].program, knowledge);
  knowledge.coverage.reset();
  knowledge.compiled.reset();
}

void TestRunner::summarise(const std::string& path, const Knowledge& knowledge) {
  const driver::Compilation& compiled = *knowledge.compiled;
  std::vector<diagnostics::Diagnostic> unheard;
  diagnostics::Keeping keeping(unheard);
  diagnostics::Diagnostics messages(compiled.sources, keeping, session_.warnings());
  const std::vector<bool> dead = analysis::find_dead_rules(compiled.model, compiled.program, messages);
  coverage_.push_back(trace::summarise(path, {compiled.sources, compiled.model, compiled.program, dead}, *knowledge.coverage));
}

bool TestRunner::run(const Tell& tell) {
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::size_t told = 0;
  const unsigned jobs = static_cast<unsigned>(std::min<std::size_t>(how_.jobs, cases_.size()));
  planners::on_threads(jobs, stop, [&](unsigned) {
    while (!stop && !Interrupts::came()) {
      const std::size_t number = next++;
      if (number >= cases_.size()) return;
      run_case(number);
      const std::lock_guard lock(mutex);
      running_[number]->ended = running_[number]->result.outcome != CaseResult::Outcome::kStopped;
      for (; told < cases_.size() && running_[told]->ended; ++told) tell_of(told, tell);
    }
  });
  // Cases after one that was stopped may have ended, and written their results.
  for (std::size_t number = told; number < cases_.size(); ++number) {
    if (running_[number]->ended) tell_of(number, tell);
  }
  return results_.size() == cases_.size();
}

}  // namespace kb::cli
