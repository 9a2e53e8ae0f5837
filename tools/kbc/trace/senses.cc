#include "tools/kbc/trace/senses.h"

#include <fmt/format.h>

#include <algorithm>

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
  looker_->look(readings_, now_us_, cells_, facts_);
  const mts::SightReport& report = looker_->report();
  looks_.fits += report.fits;
  looks_.facts += report.facts;
  looks_.asleep += report.asleep;
  looks_.bad += report.not_a_number + report.out_of_range;
  if (second_) {
    second_->look(readings_, now_us_, cells_, other);
    for (std::size_t f = 0; f < facts_.size() && disagreement_.empty(); ++f) {
      if (facts_[f] != other[f]) disagreement_ = fmt::format("`{}` is perceived as {}, not {}", program_.cells[f].name, facts_[f], other[f]);
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

}  // namespace kb::trace
