// Reports cells that nothing sets, reads, sees or wants.
#include <algorithm>

#include <fmt/format.h>

#include "compiler/analysis/subject.h"
#include "compiler/diagnostics/display.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::Cell;
using program::CellId;
using program::CellKind;
using program::Program;
using program::RuleId;

constexpr const char* kOfItsGroup = "of its group";
constexpr std::size_t kNamesInList = 6;

/// The cells of a clan for which `is_one` holds; none if the clan is indexed and it does not hold for all.
template <class F>
std::vector<CellId> those(const Clan& clan, F&& is_one) {
  std::vector<CellId> found;
  for (const CellId cell : clan.cells) {
    if (is_one(cell)) found.push_back(cell);
  }
  if (clan.indexed && found.size() < clan.cells.size()) found.clear();
  return found;
}

std::string more_of(const std::vector<CellId>& found) {
  return more(static_cast<std::uint32_t>(found.size()), kOfItsGroup);
}

/// By cell: whether it is a satellite that draws attention to a fact. That counts as reading it.
std::vector<bool> find_attending(const Program& program) {
  std::vector<bool> attending(program.cells.size(), false);
  for (const Cell& cell : program.cells) {
    for (const CellId satellite : cell.satellites) attending[program::index(satellite)] = true;
  }
  return attending;
}

class CellQuestions {
 public:
  explicit CellQuestions(Subject& subject)
      : subject_(subject), program_(subject.program), attending_(find_attending(subject.program)) {
    for (const program::Rule& rule : program_.rules) resets_ = resets_ || rule.reset;
    mark_landmarks();
    mark_parts();
    mark_helped();
    mark_shifted();
  }

  void run() {
    for (const Clan& clan : subject_.clans) {
      diagnose_never_set(clan);
      diagnose_unread(clan);
      diagnose_outputs(clan);
      diagnose_facts(clan);
      diagnose_sight(clan);
      if (!resets_) diagnose_keep(clan);
    }
  }

 private:
  [[nodiscard]] RuleId reader(CellId cell) const { return subject_.reader[program::index(cell)]; }
  [[nodiscard]] RuleId setter(CellId cell) const {
    const auto& writers = subject_.writers.by_name[program::index(cell)];
    return writers.empty() ? RuleId::kNone : writers.front();
  }
  [[nodiscard]] bool is(CellId cell, CellKind kind) const { return program_[cell].kind == kind; }

  /// Landmarks count as used: they are on the map even if no route goes there.
  void mark_landmarks() {
    const std::vector<CellId> order = program::cell_order(subject_.model);
    landmark_.assign(program_.cells.size(), false);
    for (const model::Map& map : subject_.model.maps) {
      for (const model::RowId row : map.landmarks) {
        const model::CellId cell = subject_.model[row].cell;
        if (cell != model::CellId::kNone) landmark_[program::index(order[model::index(cell)])] = true;
      }
    }
  }

  /// Facts by which others are defined count as read.
  void mark_parts() {
    defines_.assign(program_.cells.size(), false);
    for (const program::Percept& percept : program_.perception.percepts) {
      if (percept.op == program::Percept::Op::kFact) defines_[program::index(percept.cell)] = true;
    }
  }

  /// `sat X` asks for all satellites of X. That X's own satellite is never raised is no mistake if another one is.
  void mark_helped() {
    helped_.assign(program_.cells.size(), false);
    for (const Cell& cell : program_.cells) {
      for (const CellId own : cell.satellites) {
        helped_[program::index(own)] = program_[own].name.starts_with("sat ") &&
                                       std::any_of(cell.satellites.begin(), cell.satellites.end(), [&](CellId other) { return other != own && !never_changes(other); });
      }
    }
  }

  /// Marks cells that change only within a term: `X = 0.3` is a change from 0 for the program, which reads values, but not for rules.
  void mark_shifted() {
    shifted_.assign(program_.cells.size(), false);
    const auto firing = static_cast<float>(program_.settings.firing);
    const auto mark = [&](CellId cell, float value) {
      const float initial = program_[cell].initial;
      if (value != initial && region_of(value, firing) == region_of(initial, firing)) shifted_[program::index(cell)] = true;
    };
    std::vector<bool> cleared(program_.exclusive.size(), false);
    for (const program::Rule& rule : program_.rules) {
      for (const program::Write& write : rule.writes) mark(write.cell, write.value);
      for (const std::uint32_t group : rule.clears) cleared[group] = true;
    }
    for (std::size_t group = 0; group < cleared.size(); ++group) {
      if (!cleared[group]) continue;
      for (const CellId cell : program_.exclusive[group]) mark(cell, -1.0f);
    }
  }

  /// Whether the cell always keeps its initial value. `fact Obst sat = +1` does so on purpose.
  [[nodiscard]] bool never_changes(CellId cell) const {
    const auto firing = static_cast<float>(program_.settings.firing);
    const Cell& satellite = program_[cell];
    const bool fixed = subject_.written.cells[program::index(cell)] == region_of(satellite.initial, firing);
    const bool on_purpose = attending_[program::index(cell)] && satellite.initial >= firing;
    return fixed && !on_purpose;
  }

  void diagnose_never_set(const Clan& clan) {
    const std::vector<CellId> found = those(clan, [this](CellId cell) {
      return is(cell, CellKind::kSatellite) && reader(cell) != RuleId::kNone && never_changes(cell) && !helped_[program::index(cell)];
    });
    if (found.empty()) return;
    for (const CellId cell : found) subject_.reported[program::index(cell)] = true;
    const Cell& cell = program_[found.front()];
    const program::Rule& rule = program_[reader(found.front())];
    // If only a rule of the user asks for a satellite of the library, the message is about the rule.
    const bool at_reader = subject_.in_library(cell.declared) && !rule.standard;
    const std::string_view never = shifted_[program::index(found.front())] ? "changes whether it is `low`, `zero` or `high`" : cell.initial < 0.0f ? "raises it" : "changes it";
    auto message = subject_.diagnostics.report(Kind::kNeverSet, at_reader ? rule.span : cell.declared, {cell.name, never, more_of(found)});
    if (!at_reader) message.note(Kind::kReadHere, rule.span, {rule.name});
  }

  void diagnose_unread(const Clan& clan) {
    const auto idle = [this](CellId cell) {
      return is(cell, CellKind::kSatellite) && !attending_[program::index(cell)] && reader(cell) == RuleId::kNone && !program_[cell].output;
    };
    const std::vector<CellId> written = those(clan, [&](CellId c) { return idle(c) && setter(c) != RuleId::kNone; });
    const std::vector<CellId> unused = those(clan, [&](CellId c) { return idle(c) && setter(c) == RuleId::kNone; });
    if (!written.empty()) {
      const program::Rule& rule = program_[setter(written.front())];
      subject_.diagnostics
          .report(Kind::kNeverRead, program_[written.front()].declared,
                  {program_[written.front()].name, more_of(written)})
          .note(Kind::kSetHere, rule.span, {rule.name});
    }
    if (!unused.empty()) {
      subject_.diagnostics.report(Kind::kUnusedSatellite, program_[unused.front()].declared,
                                  {program_[unused.front()].name, more_of(unused)});
    }
  }

  /// Outputs that rules ask for as well have been reported as never set.
  void diagnose_outputs(const Clan& clan) {
    const std::vector<CellId> found = those(clan, [this](CellId cell) {
      return program_[cell].output && reader(cell) == RuleId::kNone && never_changes(cell) && !shifted_[program::index(cell)];
    });
    if (found.empty()) return;
    const Cell& cell = program_[found.front()];
    subject_.diagnostics.report(Kind::kUnsetOutput, cell.declared, {cell.name, cell.initial < 0.0f ? "raises" : "changes", more_of(found)});
  }

  void diagnose_facts(const Clan& clan) {
    const std::vector<CellId> found = those(clan, [this](CellId cell) {
      return is(cell, CellKind::kFact) && reader(cell) == RuleId::kNone && !landmark_[program::index(cell)] &&
             !defines_[program::index(cell)];
    });
    if (found.empty()) return;
    const Cell& cell = program_[found.front()];
    subject_.diagnostics.report(Kind::kUnusedFact, cell.declared,
                                {cell.command ? "command" : "fact", cell.name, more_of(found)});
  }

  [[nodiscard]] bool attended_at_times(CellId fact) const {
    return analysis::attended_at_times(program_, subject_.domains, fact);
  }

  [[nodiscard]] bool never_seen(CellId fact) const {
    const program::Thresholds limits = program::thresholds(program_[fact]);
    return subject_.asks_sight(fact) && (attended_at_times(fact) ? limits.attended >= 1.0f : limits.plain >= 1.0f);
  }

  [[nodiscard]] bool pointless_attention(CellId fact) const {
    const auto& satellites = program_[fact].satellites;
    return program_[fact].attention == 0.0 && program_.settings.attention != 0.0 &&
           std::any_of(satellites.begin(), satellites.end(),
                       [this](CellId s) { return subject_.raiser[program::index(s)] != RuleId::kNone; });
  }

  void diagnose_sight(const Clan& clan) {
    const std::vector<CellId> unseen = those(clan, [this](CellId cell) {
      return is(cell, CellKind::kFact) && reader(cell) != RuleId::kNone && never_seen(cell);
    });
    for (const CellId cell : unseen) subject_.reported[program::index(cell)] = true;
    if (!unseen.empty()) {
      const Cell& fact = program_[unseen.front()];
      const program::Thresholds limits = program::thresholds(fact);
      const std::string limit = fmt::format("{}", attended_at_times(unseen.front()) ? limits.attended : limits.plain);
      subject_.diagnostics.report(Kind::kNeverSeen, fact.declared, {fact.name, limit, more_of(unseen)});
    }
    const std::vector<CellId> pointless =
        those(clan, [this](CellId cell) { return is(cell, CellKind::kFact) && pointless_attention(cell); });
    if (!pointless.empty()) {
      const Cell& fact = program_[pointless.front()];
      subject_.diagnostics.report(Kind::kPointlessAttention, fact.declared, {fact.name, more_of(pointless)});
    }
  }

  void diagnose_keep(const Clan& clan) {
    const std::vector<CellId> found = those(clan, [this](CellId cell) { return program_[cell].keep; });
    if (found.empty()) return;
    const Cell& cell = program_[found.front()];
    subject_.diagnostics.report(Kind::kPointlessKeep, cell.declared, {cell.name, more_of(found)});
  }

  Subject& subject_;
  const Program& program_;
  std::vector<bool> attending_, landmark_, defines_, shifted_, helped_;
  bool resets_ = false;
};

bool never_wanted(const Subject& subject, CellId strategy) {
  const Program& program = subject.program;
  const bool idle = program.settings.idle == program::Idle::kStrategy && program.settings.idle_strategy == strategy;
  return !idle && !can_be_high(subject.written, strategy);
}

std::string strategy_names(const Program& program, const std::vector<CellId>& strategies) {
  std::vector<std::string_view> names;
  for (const CellId strategy : strategies) names.emplace_back(program[strategy].name);
  return diagnostics::listed(names, kNamesInList, "strategies");
}

/// By cell: whether it is a strategy with a `control` line.
std::vector<bool> driven_cells(const Program& program) {
  std::vector<bool> driven(program.cells.size(), false);
  for (const program::Control& control : program.controls) driven[program::index(control.strategy)] = true;
  return driven;
}

void diagnose_controllers(Subject& subject, const std::vector<bool>& driven) {
  const Program& program = subject.program;
  for (const bool library : {false, true}) {
    std::vector<CellId> missing;
    for (std::uint32_t i = program.first_strategy(); i < program.cells.size(); ++i) {
      const bool here = subject.in_library(program.cells[i].declared) == library;
      if (here && !driven[i] && !never_wanted(subject, CellId{i})) missing.push_back(CellId{i});
    }
    if (missing.empty()) continue;
    subject.diagnostics.report(Kind::kNoController, program[missing.front()].declared, {strategy_names(program, missing)});
  }
}

/// Where the user added the member of which the cell at `place` of a library's group is made; unknown if no member is the user's.
source::Span added_member(const Subject& subject, const model::Group& group, std::size_t place) {
  source::Span added;
  for (std::size_t d = group.dimensions.size(); d-- > 0;) {
    const model::FiniteSet& set = subject.model.sets[model::index(group.dimensions[d])];
    const source::Span at = set.places[place % set.members.size()];
    if (!subject.in_library(at)) added = at;
    place /= set.members.size();
  }
  return added;
}

/// Reports strategies of a library's group that exist because the user added a member to a set, and that have no `control` line although
/// others of the group have one. The library's own strategies are not reported: programs and the simulator drive them without a line.
void diagnose_added_strategies(Subject& subject, const std::vector<bool>& driven) {
  const Program& program = subject.program;
  const std::vector<CellId> order = program::cell_order(subject.model);
  std::vector<bool> here(program.cells.size(), false);
  for (const program::Control& control : program.controls) here[program::index(control.strategy)] = !subject.in_library(control.span);
  std::vector<std::pair<source::Span, std::vector<CellId>>> missing;   // by member
  for (const model::Group& group : subject.model.groups) {
    const auto cell = [&](std::size_t place) { return order[model::index(group.cells[place])]; };
    const auto is_here = [&](model::CellId id) { return here[program::index(order[model::index(id)])]; };
    if (group.kind != model::CellKind::kStrategy || !subject.in_library(group.declared)) continue;
    if (std::none_of(group.cells.begin(), group.cells.end(), is_here)) continue;
    for (std::size_t i = 0; i < group.cells.size(); ++i) {
      const source::Span added = added_member(subject, group, i);
      if (!added.known() || driven[program::index(cell(i))] || never_wanted(subject, cell(i))) continue;
      const auto told = std::find_if(missing.begin(), missing.end(), [&](const auto& m) { return m.first == added; });
      (told == missing.end() ? missing.emplace_back(added, std::vector<CellId>{}) : *told).second.push_back(cell(i));
    }
  }
  for (const auto& [member, strategies] : missing) subject.diagnostics.report(Kind::kNoController, member, {strategy_names(program, strategies)});
}

}  // namespace

void diagnose_cells(Subject& subject) {
  CellQuestions(subject).run();
  for (std::uint32_t i = 0; i < subject.program.facts; ++i) {
    if (subject.program.cells[i].name == "t") subject.diagnostics.report(Kind::kNamedAsTime, subject.program.cells[i].declared);
  }
  for (const program::Sensor& sensor : subject.program.perception.sensors) {
    if (sensor.name == "t" && !sensor.array) subject.diagnostics.report(Kind::kNamedAsTime, sensor.declared);
  }
}

void diagnose_strategies(Subject& subject) {
  const Program& program = subject.program;
  for (const Clan& clan : subject.clans) {
    const std::vector<CellId> found = those(
        clan, [&](CellId cell) { return program[cell].kind == CellKind::kStrategy && never_wanted(subject, cell); });
    if (found.empty()) continue;
    const Cell& strategy = program[found.front()];
    const std::string satellite =
        strategy.satellites.empty() ? fmt::format("sat {}", strategy.name) : std::string(program[strategy.satellites.front()].name);
    subject.diagnostics.report(Kind::kNeverWanted, strategy.declared, {strategy.name, satellite, more_of(found)});
  }
  const std::vector<bool> driven = driven_cells(subject.program);
  diagnose_controllers(subject, driven);
  diagnose_added_strategies(subject, driven);
}

}  // namespace kb::analysis
