#include "compiler/program/perception.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/program/program.h"

namespace kb::program {
namespace {

bool is_satellite_term(const Program& program, const Cond& cond) {
  return cond.op == Cond::Op::kIs && program[cond.cell].kind == CellKind::kSatellite;
}

/// What a rule's condition asks of satellites as plain parts of its `and`.
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

const Sensor& Perception::sensor_of(std::uint32_t reading) const {
  const auto after = std::upper_bound(sensors.begin(), sensors.end(), reading,
                                      [](std::uint32_t r, const Sensor& sensor) { return r < sensor.first; });
  return *(after - 1);
}

std::string Perception::reading_name(std::uint32_t reading) const {
  const Sensor& sensor = sensor_of(reading);
  return sensor.array ? fmt::format("{}[{}]", sensor.name, reading - sensor.first) : sensor.name;
}

std::vector<std::vector<Demand>> alternatives(const Program& program, CellId fact) {
  std::vector<std::vector<Demand>> found;
  for (const CellId satellite : program[fact].satellites) found.push_back({{satellite, Term::kHigh, false}});
  std::vector<bool> reads(program.conds.size(), false);  // children stand before their parents
  for (std::size_t i = 0; i < program.conds.size(); ++i) {
    const Cond& cond = program.conds[i];
    const bool asks = cond.op == Cond::Op::kIs || cond.op == Cond::Op::kSeen || cond.op == Cond::Op::kEvent || cond.op == Cond::Op::kLost;
    reads[i] = (asks && cond.cell == fact) ||
               std::any_of(cond.children.begin(), cond.children.end(), [&](CondId child) { return reads[index(child)]; });
  }
  for (const Rule& rule : program.rules) {
    if (reads[index(rule.condition)]) found.push_back(demands(program, rule.condition));
  }
  return found;
}

std::string percept_text(const Program& program, PerceptId percept) { return text(program, percept, false); }

}  // namespace kb::program
