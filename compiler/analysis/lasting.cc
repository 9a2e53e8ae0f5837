// Strategies that stay wanted for ever, before others that then never run again.
#include <algorithm>

#include "compiler/analysis/subject.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;

struct Lasting {
  CellId strategy = CellId::kNone, satellite = CellId::kNone;
  CellId starved = CellId::kNone;   ///< comes after it, and can be wanted
};

class LastingQuestions {
 public:
  explicit LastingQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)),
        lowered_(program_.cells.size(), false), raised_by_clears_(program_.cells.size()), raised_by_resets_(program_.cells.size()),
        clears_(program_.exclusive.size()) {
    for (const Rule& rule : program_.rules) count(rule);
    find_strategies();
  }

  void run() {
    ByFamily<Lasting> found(subject_);
    std::vector<bool> told(program_.cells.size(), false);
    for (const bool library : {false, true}) {   // what the user's rules raise is told there
      for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
        if (program_.rules[i].standard != library) continue;
        for (const program::Write& write : program_.rules[i].writes) {
          if (write.value < firing_ || told[program::index(write.cell)] || !lasts(write.cell)) continue;
          told[program::index(write.cell)] = true;
          const CellId strategy = wants_[program::index(write.cell)];
          found.add(RuleId{i}, {strategy, write.cell, starved_[program::index(strategy)]});
        }
      }
    }
    found.for_each([&](RuleId rule, const Lasting& lasting, std::uint32_t count) { report(program_[rule], lasting, count); });
  }

 private:
  /// A reset, or a write to another member of its group, lowers a cell unless the rule raises it in the same breath.
  void count(const Rule& rule) {
    resets_ += rule.reset ? 1 : 0;
    for (const std::uint32_t group : rule.clears) ++clears_[group];
    for (const program::Write& write : rule.writes) {
      const std::size_t cell = program::index(write.cell);
      if (write.value < firing_) lowered_[cell] = true;
      const std::uint32_t group = subject_.group_of[cell];
      raised_by_clears_[cell] += std::binary_search(rule.clears.begin(), rule.clears.end(), group) ? 1 : 0;
      raised_by_resets_[cell] += rule.reset ? 1 : 0;
    }
  }

  /// Whom each satellite wants, if that comes before a strategy that can be wanted as well, or that runs where nothing is.
  void find_strategies() {
    wants_.assign(program_.cells.size(), CellId::kNone);
    starved_.assign(program_.cells.size(), CellId::kNone);
    CellId after = CellId::kNone;
    for (auto at = program_.priority.rbegin(); at != program_.priority.rend(); ++at) {
      starved_[program::index(*at)] = after;
      const auto& satellites = program_[*at].satellites;
      if (after != CellId::kNone) {
        for (const CellId satellite : satellites) wants_[program::index(satellite)] = *at;
      }
      const bool idle = program_.settings.idle == program::Idle::kStrategy && program_.settings.idle_strategy == *at;
      if (idle || attended_at_times(program_, subject_.domains, *at)) after = *at;
    }
  }

  /// What is high from the start is so on purpose.
  [[nodiscard]] bool lasts(CellId satellite) const {
    const std::size_t cell = program::index(satellite);
    const program::Cell& it = program_[satellite];
    if (wants_[cell] == CellId::kNone || lowered_[cell] || it.initial >= firing_) return false;
    if (!it.keep && resets_ > raised_by_resets_[cell]) return false;
    const std::uint32_t group = subject_.group_of[cell];
    return group == program::kNoGroup || clears_[group] == raised_by_clears_[cell];
  }

  void report(const Rule& rule, const Lasting& lasting, std::uint32_t count) const {
    const std::string_view satellite = program_[lasting.satellite].name;
    auto message = subject_.diagnostics.report(Kind::kNeverLowered, rule.span,
        {program_[lasting.strategy].name, rule.name, satellite, program_[lasting.starved].name, more(count)});
    if (rule.mode == program::Mode::kWhile) message.note(Kind::kWhileLeavesWritten, {}, {satellite});
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  std::uint32_t resets_ = 0;
  std::vector<bool> lowered_;                                        // by cell: a rule writes less than `firing`
  std::vector<std::uint32_t> raised_by_clears_, raised_by_resets_;   // by cell: how many of those rules raise it themselves
  std::vector<std::uint32_t> clears_;                                // by group: how many rules clear it
  std::vector<CellId> wants_, starved_;
};

}  // namespace

void diagnose_lasting(const Subject& subject) { LastingQuestions(subject).run(); }

}  // namespace kb::analysis
