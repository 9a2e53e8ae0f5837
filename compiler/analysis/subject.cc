#include "compiler/analysis/subject.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using program::CellId;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;

void find_families(Subject& subject) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::string_view>;
  std::map<Key, std::uint32_t> known;
  source::Span before;   // instances of a rule mostly follow one another
  subject.family.reserve(subject.program.rules.size());
  for (const Rule& rule : subject.program.rules) {
    if (before.known() && before == rule.span) {   // only one rule can be written at a place
      subject.family.push_back(subject.family.back());
      ++subject.instances[subject.family.back()];
      continue;
    }
    before = rule.span;
    const Key key{static_cast<std::uint32_t>(rule.span.file), rule.span.begin, rule.tmpl()};
    const auto [it, fresh] = known.emplace(key, static_cast<std::uint32_t>(subject.instances.size()));
    if (fresh) subject.instances.push_back(0);
    subject.family.push_back(it->second);
    ++subject.instances[it->second];
  }
}

/// Each condition is visited once, so the first rule that contains it counts as its reader. The user's rules are visited first.
void find_readers(Subject& subject) {
  const Program& program = subject.program;
  subject.reader.assign(program.cells.size(), RuleId::kNone);
  subject.asked.assign(program.cells.size(), 0);
  std::vector<bool> visited(program.conds.size(), false);
  std::vector<CondId> pending;
  for (const bool library : {false, true}) {
    for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
      const Rule& rule = program.rules[i];
      if (Subject::generated(rule) || rule.standard != library) continue;
      pending.push_back(rule.condition);
      while (!pending.empty()) {
        const CondId id = pending.back();
        pending.pop_back();
        if (visited[program::index(id)]) continue;
        visited[program::index(id)] = true;
        const program::Cond& cond = program[id];
        pending.insert(pending.end(), cond.children.begin(), cond.children.end());
        if (program::has_parts(cond.op)) continue;
        RuleId& reader = subject.reader[program::index(cond.cell)];
        if (reader == RuleId::kNone) reader = RuleId{i};
        const bool high = cond.op == program::Cond::Op::kIs && cond.term == program::Term::kHigh;
        subject.asked[program::index(cond.cell)] |= cond.op != program::Cond::Op::kIs ? Subject::kAsksSight : high ? Subject::kAsksHigh : std::uint8_t{0};
      }
    }
  }
}

void find_raisers(Subject& subject) {
  const Program& program = subject.program;
  subject.raiser.assign(program.cells.size(), RuleId::kNone);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    for (const program::Write& write : program.rules[i].writes) {
      const std::size_t cell = program::index(write.cell);
      if (write.value > 0.0f && subject.raiser[cell] == RuleId::kNone) subject.raiser[cell] = RuleId{i};
    }
  }
}

/// A group is a clan, and so are the rows of a relation; any other cell is a clan of its own. A cell's own satellite goes with the cell.
void find_clans(Subject& subject) {
  const model::Model& model = subject.model;
  const std::vector<CellId> order = program::cell_order(model);
  std::vector<std::uint32_t> clan_of(model.cells.size(), program::kNoGroup);
  const auto found = [&](bool indexed) {
    subject.clans.push_back({{}, indexed});
    return static_cast<std::uint32_t>(subject.clans.size() - 1);
  };
  for (const model::Group& group : model.groups) {
    const bool own_names =
        group.dimensions.size() == 1 && model.sets[model::index(group.dimensions[0])].name == group.name;
    // Strategies for each member of a set of the user's are as if they had been written with these names.
    const bool users = group.kind == model::CellKind::kStrategy && group.dimensions.size() == 1 &&
                       !subject.in_library(model.sets[model::index(group.dimensions[0])].declared);
    const std::uint32_t clan = found(!own_names && !users);
    for (const model::CellId cell : group.cells) clan_of[model::index(cell)] = clan;
  }
  for (const model::Relation& relation : model.relations) {
    if (!relation.satellites) continue;
    const std::uint32_t clan = found(true);
    for (const model::RowId row : relation.rows) {
      if (model[row].cell != model::CellId::kNone) clan_of[model::index(model[row].cell)] = clan;
    }
  }
  subject.clans.reserve(model.cells.size());
  std::vector<std::uint32_t> own;  // by clan: that of its own satellites
  for (std::size_t i = 0; i < model.cells.size(); ++i) {
    const model::Cell& cell = model.cells[i];
    if (clan_of[i] == program::kNoGroup && cell.own_satellite && cell.of != model::CellId::kNone) {
      const std::uint32_t of = clan_of[model::index(cell.of)];
      if (of != program::kNoGroup) {
        if (of >= own.size()) own.resize(subject.clans.size(), program::kNoGroup);
        if (own[of] == program::kNoGroup) own[of] = found(subject.clans[of].indexed);
        clan_of[i] = own[of];
      }
    }
    if (clan_of[i] == program::kNoGroup) clan_of[i] = found(false);
  }
  for (std::size_t i = 0; i < model.cells.size(); ++i) subject.clans[clan_of[i]].cells.push_back(order[i]);
  std::erase_if(subject.clans, [](const Clan& clan) { return clan.cells.empty(); });
}

}  // namespace

Subject::Subject(const model::Model& studied, const Program& lowered, diagnostics::Diagnostics& messages)
    : model(studied), program(lowered), diagnostics(messages), domains(find_domains(program)), written(written_domains(program)), widest(widest_domains(program)),
      writers(program), group_of(program::group_of_cells(program)), reported(program.cells.size(), false), confusions(std::make_unique<Confusions>(program)),
      narrow_(program, domains, confusions.get()), wide_(narrow_, widest) {
  find_families(*this);
  find_readers(*this);
  find_raisers(*this);
  find_clans(*this);
}

std::string more(std::uint32_t count, const char* of_what) {
  if (count < 2) return {};
  return " (and " + std::to_string(count - 1) + " more " + of_what + ")";
}

}  // namespace kb::analysis
