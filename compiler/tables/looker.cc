// The runtime's perception on tables in memory, and the plain perception with which it is compared.
#include <algorithm>
#include <cmath>

#include "compiler/tables/perception.h"

namespace kb::tables {
namespace {

using I = PerceptionForm::I;
using program::Percept;
using program::PerceptId;
using program::Program;

class Engine final : public Looker {
 public:
  Engine(const Program& program, const PerceptionForm& form)
      : firing_(static_cast<float>(program.settings.firing)), form_(form), view_(view(form)),
        floats_(2u * form.shape.readings + form.shape.fits + form.shape.facts + 1u),
        bytes_(form.shape.fits + form.shape.facts + 1u), instants_(2u * form.shape.readings + 1u) {
    state_.value = floats_.data();
    state_.spread = state_.value + form.shape.readings;
    state_.fit = state_.spread + form.shape.readings;
    state_.certainty = state_.fit + form.shape.fits;
    state_.known = bytes_.data();
    state_.needed = state_.known + form.shape.fits;
    state_.at_us = instants_.data();
    state_.born_us = state_.at_us + form.shape.readings;
    mts::PerceptionEngine<I>(view_, state_).reset();
  }

  void look(const ReadingTable& readings, std::int64_t now_us, std::span<const float> cells, std::span<float> facts) override {
    mts::PerceptionEngine<I>(view_, state_).look(readings, mts::Instant{now_us}, cells.data(), firing_, facts.data());
    for (I i = 0; i < form_.shape.facts; ++i) facts[form_.fact[i]] = state_.certainty[i];
  }
  [[nodiscard]] const mts::SightReport& report() const override { return state_.report; }

 private:
  float firing_;
  const PerceptionForm& form_;
  mts::PerceptionTables<I> view_;
  std::vector<float> floats_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::int64_t> instants_;
  mts::PerceptionState state_;
};

class Plain final : public Looker {
 public:
  Plain(const Program& program, const PerceptionForm& form) : program_(program), from_(program.perception), form_(form), arrivals_(form.shape.readings) {
    std::vector<program::Alternatives> found = program::alternatives(program, from_.lazy_facts());
    auto next = found.begin();
    for (const program::Perceived& perceived : from_.perceived) alternatives_.push_back(perceived.lazy ? std::move(*next++) : program::Alternatives{});
  }

  void look(const ReadingTable& readings, std::int64_t now_us, std::span<const float> cells, std::span<float> facts) override {
    report_ = {};
    readings_ = &readings;
    note_arrivals(now_us);
    for (std::size_t i = 0; i < from_.perceived.size(); ++i) facts[program::index(from_.perceived[i].fact)] = value(from_.perceived[i].percept, facts);
    awaited_ = who_is_awaited(cells);
    for (std::size_t i = 0; i < from_.perceived.size(); ++i) {
      if (asleep(i)) facts[program::index(from_.perceived[i].fact)] = 0.0f;
    }
    // If a fact is looked at, so are those that define it; so masking a fact changes no fact that is not masked itself.
  }
  [[nodiscard]] const mts::SightReport& report() const override { return report_; }

  [[nodiscard]] bool asleep(std::size_t perceived) const override { return !awaited_[perceived]; }
  [[nodiscard]] float certainty(const Percept& percept) const override {
    const Datum d = datum(percept.reading);
    if (d.spread < 0.0f) return 0.0f;
    if (percept.op == Percept::Op::kFits) return mts::certainty(form_.prototypes[percept.prototype], d.value, d.spread);
    const std::vector<std::string>& texts = from_.sensor_of(percept.reading).texts;
    const auto wanted = std::find(texts.begin(), texts.end(), percept.text) - texts.begin() + 1;
    return d.value == static_cast<float>(wanted) ? 1.0f : -1.0f;
  }

 private:
  struct Datum { float value = 0.0f, spread = -1.0f; };
  /// The present reading of an element: when it came, and what it says of when it was measured.
  struct Arrival { bool there = false, refused = false; std::int64_t at_us = 0, set_back_us = 0; };

  void note_arrivals(std::int64_t now_us) {
    if (!first_ && now_us < now_us_) set_back_us_ += now_us_ - now_us;
    first_ = false;
    now_us_ = now_us;
    for (std::size_t r = 0; r < arrivals_.size(); ++r) {
      Arrival& last = arrivals_[r];
      const std::int64_t at_us = readings_->at_us[r];
      if (readings_->there[r] == 0) last = {};
      else if (!last.there || last.at_us != at_us) {
        const float ahead_s = static_cast<float>(at_us - now_us) * 1e-6f;
        last = {true, ahead_s > std::min(1.0f, form_.sensors[form_.sensor_of[r]].stale_s), at_us, set_back_us_};
      }
    }
  }

  /// What the clock says now, and by how much it has been set back since the reading came.
  [[nodiscard]] std::int64_t age_us(const Arrival& reading) const {
    return std::max<std::int64_t>(0, now_us_ - reading.at_us + (set_back_us_ - reading.set_back_us));
  }

  [[nodiscard]] Datum datum(std::uint32_t reading) const {
    const mts::Sensor& sensor = form_.sensors[form_.sensor_of[reading]];
    const float value = readings_->value[reading];
    const Arrival& arrival = arrivals_[reading];
    if (!arrival.there || arrival.refused || std::isnan(value) || std::isinf(value)) return {};
    const float age_s = static_cast<float>(age_us(arrival)) * 1e-6f;
    if (sensor.text) return {value, age_s > sensor.stale_s ? -1.0f : 0.0f};
    if (sensor.strict && (value < sensor.low || value > sensor.high)) return {};
    const float inside = sensor.period > 0.0f ? mts::wrapped(value, sensor.low, sensor.period) : std::clamp(value, sensor.low, sensor.high);
    return {inside, mts::aged_spread(sensor.noise, sensor.growth, age_s)};
  }

  /// Recursion as deep as definitions nest.
  [[nodiscard]] float value(PerceptId id, std::span<const float> facts) const {
    const Percept& percept = from_[id];
    switch (percept.op) {
      case Percept::Op::kFits:
      case Percept::Op::kReads: return certainty(percept);
      case Percept::Op::kFact: {
        const float x = facts[program::index(percept.cell)];
        return std::isnan(x) ? 0.0f : std::clamp(x, -1.0f, 1.0f);
      }
      case Percept::Op::kNot: return 0.0f - value(percept.children.front(), facts);
      case Percept::Op::kAnd:
      case Percept::Op::kOr: break;
    }
    float all = value(percept.children.front(), facts);
    for (const PerceptId child : percept.children) {
      const float part = value(child, facts);
      all = percept.op == Percept::Op::kAnd ? std::min(all, part) : std::max(all, part);
    }
    return all;
  }

  [[nodiscard]] bool holds(const program::Demand& demand, std::span<const float> cells) const {
    const auto firing = static_cast<float>(program_.settings.firing);
    return program::holds(demand.term, cells[program::index(demand.cell)], firing) != demand.negated;
  }

  [[nodiscard]] std::vector<bool> who_is_awaited(std::span<const float> cells) const {
    std::vector<bool> awaited(from_.perceived.size(), false);
    for (std::size_t i = awaited.size(); i-- > 0;) {
      const bool somebody = std::any_of(alternatives_[i].begin(), alternatives_[i].end(), [&](const auto& alternative) {
        return std::all_of(alternative.begin(), alternative.end(), [&](const program::Demand& demand) { return holds(demand, cells); });
      });
      awaited[i] = awaited[i] || !from_.perceived[i].lazy || somebody;
      if (awaited[i]) mark_parts(from_.perceived[i].percept, awaited);
    }
    return awaited;
  }

  void mark_parts(PerceptId id, std::vector<bool>& awaited) const {
    const Percept& percept = from_[id];
    for (const PerceptId child : percept.children) mark_parts(child, awaited);
    if (percept.op != Percept::Op::kFact) return;
    for (std::size_t i = 0; i < awaited.size(); ++i) {
      if (from_.perceived[i].fact == percept.cell) awaited[i] = true;
    }
  }

  const Program& program_;
  const program::Perception& from_;
  const PerceptionForm& form_;
  std::vector<program::Alternatives> alternatives_;  // by perceived fact
  std::vector<bool> awaited_;  // by perceived fact, at the last look
  const ReadingTable* readings_ = nullptr;
  std::vector<Arrival> arrivals_;   // by reading
  std::int64_t now_us_ = 0, set_back_us_ = 0;   // by how much the clock has been set back in all
  bool first_ = true;
  mts::SightReport report_;
};

}  // namespace

std::unique_ptr<Looker> make_looker(const Program& program, const PerceptionForm& form) { return std::make_unique<Engine>(program, form); }
std::unique_ptr<Looker> make_plain_looker(const Program& program, const PerceptionForm& form) {
  return std::make_unique<Plain>(program, form);
}

}  // namespace kb::tables
