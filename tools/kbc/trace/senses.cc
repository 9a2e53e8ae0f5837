#include "tools/kbc/trace/senses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kb::trace {

Senses::Senses(const program::Program& program, EngineKind kind)
    : program_(program),
      form_(tables::build_perception(program)),
      readings_(form_.shape.readings),
      cells_(program.cells.size(), 0.0f),
      facts_(program.facts, 0.0f),
      before_(program.facts, 0.0f) {
  looker_ = kind == EngineKind::kInterpreter ? tables::make_plain_looker(program, form_) : tables::make_looker(program, form_);
  if (kind == EngineKind::kBoth) second_ = tables::make_plain_looker(program, form_);
}

std::span<const float> Senses::look_at(const FactsRow& row) {
  now_us_ += row.dt_us;
  for (const ReadingUpdate& update : row.readings) {
    if (update.forget) readings_.there[update.reading] = 0;
    else readings_.set(update.reading, update.value, now_us_);
  }
  std::copy(row.facts.begin(), row.facts.end(), facts_.begin());
  std::vector<float> other = second_ ? facts_ : std::vector<float>();
  looked_ = true;
  looker_->look(readings_, now_us_, cells_, facts_);
  const mts::SightReport& report = looker_->report();
  looks_.fits += report.fits;
  looks_.facts += report.facts;
  looks_.asleep += report.asleep;
  looks_.bad += report.not_a_number + report.out_of_range;
  if (second_) {
    second_->look(readings_, now_us_, cells_, other);
    for (std::size_t f = 0; f < facts_.size() && disagreement_.empty(); ++f) {
      const bool same = facts_[f] == other[f] || (std::isnan(facts_[f]) && std::isnan(other[f]));   // a given fact may be NaN
      if (!same) disagreement_ = fmt::format("`{}` is perceived as {}, not {}", program_.cells[f].name, facts_[f], other[f]);
    }
  }
  changed_.clear();
  for (const program::Perceived& perceived : program_.perception.perceived) {
    const std::size_t f = program::index(perceived.fact);
    if (facts_[f] != before_[f]) changed_.push_back({perceived.fact, facts_[f]});
    before_[f] = facts_[f];
  }
  std::sort(changed_.begin(), changed_.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  return facts_;
}

std::optional<Sighting> Senses::explain(program::CellId fact) const {
  const program::Perception& perception = program_.perception;
  const auto found = std::find_if(perception.perceived.begin(), perception.perceived.end(), [&](const auto& p) { return p.fact == fact; });
  if (found == perception.perceived.end() || !looked_) return std::nullopt;
  const float certainty = facts_[program::index(fact)];
  Sighting out{std::string(program_[fact].name), program::percept_text(program_, found->percept), certainty, certainty,
               looker_->asleep(static_cast<std::size_t>(found - perception.perceived.begin()))};
  std::vector<program::PerceptId> todo{found->percept};
  while (!todo.empty() && !out.asleep) {
    const program::PerceptId id = todo.back();
    const program::Percept& percept = perception[id];
    todo.pop_back();
    todo.insert(todo.end(), percept.children.rbegin(), percept.children.rend());
    using Op = program::Percept::Op;
    if (percept.op == Op::kFact) out.parts.push_back({std::string(program_[percept.cell].name), facts_[program::index(percept.cell)]});
    if (percept.op == Op::kReads || percept.op == Op::kFits) out.parts.push_back(compared(id));
  }
  return out;
}

Sighting::Part Senses::compared(program::PerceptId id) const {
  const program::Percept& percept = program_.perception[id];
  const std::size_t r = percept.reading;
  Sighting::Part part{program::percept_text(program_, id), 0.0f, true};
  if (readings_.there[r] == 0) return part;
  part.read = true;
  part.certainty = looker_->certainty(percept);
  part.age_s = static_cast<double>(now_us_ - readings_.at_us[r]) / 1e6;
  const program::Sensor& sensor = program_.perception.sensor_of(percept.reading);
  if (percept.op == program::Percept::Op::kFits) {
    part.reading = readings_.value[r];
    part.unit = sensor.unit;
  } else if (const auto text = static_cast<std::size_t>(readings_.value[r]); text != 0) {
    part.reading = sensor.texts[text - 1];
  }
  return part;
}

}  // namespace kb::trace
