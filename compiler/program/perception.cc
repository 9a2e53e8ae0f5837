#include "compiler/program/perception.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_map>

#include "compiler/program/conditions.h"
#include "compiler/program/program.h"

namespace kb::program {
namespace {

bool is_satellite_term(const Program& program, const Cond& cond) {
  return cond.op == Cond::Op::kIs && program[cond.cell].kind == CellKind::kSatellite;
}

std::string text(const Program& program, PerceptId id, bool inside) {
  const Perception& perception = program.perception;
  const Percept& percept = perception[id];
  std::string out;
  switch (percept.op) {
    case Percept::Op::kFits:
      return fmt::format("{} ~ {}", perception.reading_name(percept.reading), perception.prototypes[percept.prototype].text);
    case Percept::Op::kReads: return fmt::format("{} ~ \"{}\"", perception.reading_name(percept.reading), percept.text);
    case Percept::Op::kFact: return std::string(program[percept.cell].name);
    case Percept::Op::kNot: return "not " + text(program, percept.children.front(), true);
    case Percept::Op::kAnd:
    case Percept::Op::kOr: break;
  }
  for (const PerceptId child : percept.children) {
    if (!out.empty()) out += percept.op == Percept::Op::kAnd ? " and " : " or ";
    out += text(program, child, true);
  }
  return inside ? "(" + out + ")" : out;
}

}  // namespace

double growth_of(const Sensor& sensor) {
  if (!sensor.stale_s || sensor.text) return 0.0;
  const double half = 0.5 * (sensor.high - sensor.low);
  return (half * half - sensor.noise * sensor.noise) / *sensor.stale_s;
}

std::vector<CellId> Perception::lazy_facts() const {
  std::vector<CellId> found;
  for (const Perceived& one : perceived) {
    if (one.lazy) found.push_back(one.fact);
  }
  return found;
}

const Sensor& Perception::sensor_of(std::uint32_t reading) const {
  const auto after = std::upper_bound(sensors.begin(), sensors.end(), reading,
                                      [](std::uint32_t r, const Sensor& sensor) { return r < sensor.first; });
  return *(after - 1);
}

std::string Perception::reading_name(std::uint32_t reading) const {
  const Sensor& sensor = sensor_of(reading);
  return sensor.array ? fmt::format("{}[{}]", sensor.name, reading - sensor.first) : sensor.name;
}

std::vector<Demand> demands(const Program& program, CondId root) {
  std::vector<Demand> found;
  const auto take = [&](CondId id) {
    const Cond& cond = program[id];
    if (is_satellite_term(program, cond)) found.push_back({cond.cell, cond.term, false});
    if (cond.op != Cond::Op::kNot) return;
    const Cond& inner = program[cond.children.front()];
    if (is_satellite_term(program, inner)) found.push_back({inner.cell, inner.term, true});
  };
  if (program[root].op == Cond::Op::kAnd) std::for_each(program[root].children.begin(), program[root].children.end(), take);
  else take(root);
  return found;
}

std::vector<Alternatives> alternatives(const Program& program, std::span<const CellId> facts) {
  std::vector<Alternatives> found(facts.size());
  std::unordered_map<CellId, std::size_t> place_of;   // looked up, never iterated
  for (std::size_t i = 0; i < facts.size(); ++i) {
    place_of.emplace(facts[i], i);
    for (const CellId satellite : program[facts[i]].satellites) found[i].push_back({{satellite, Term::kHigh, false}});
  }
  const auto asks = [&](const Cond& cond) { return !has_parts(cond.op) && place_of.contains(cond.cell); };
  const std::vector<bool> reads = marked(program, asks);
  for (const Rule& rule : program.rules) {
    if (!reads[index(rule.condition)]) continue;
    const std::vector<Demand> all = demands(program, rule.condition);
    std::set<std::size_t> read;
    std::vector<CondId> pending{rule.condition};
    while (!pending.empty()) {
      const Cond& cond = program[pending.back()];
      pending.pop_back();
      if (asks(cond)) read.insert(place_of.at(cond.cell));
      std::copy_if(cond.children.begin(), cond.children.end(), std::back_inserter(pending), [&](CondId child) { return reads[index(child)]; });
    }
    for (const std::size_t place : read) found[place].push_back(all);
  }
  return found;
}

std::string percept_text(const Program& program, PerceptId percept) { return text(program, percept, false); }

}  // namespace kb::program
