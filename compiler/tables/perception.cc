#include "compiler/tables/perception.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "compiler/tables/fuzzy.h"
#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using program::Percept;
using program::PerceptId;
using program::Program;

/// The row of a prototype, which needs a core, and flanks with a level curve.
mts::Membership prototype_row(const fuzzy::Shape& shape) {
  const mts::Membership made = row(shape);
  if (!mts::can_be_prototype(made)) throw std::logic_error("a prototype without a core");   // the model has refused such shapes
  return made;
}

mts::Sensor sensor_row(const program::Sensor& sensor) {
  mts::Sensor row;
  row.low = to_float(sensor.low);
  row.high = to_float(sensor.high);
  row.period = sensor.circular ? row.high - row.low : 0.0f;
  row.noise = to_float(sensor.noise);
  row.growth = to_float(sensor.growth);
  row.stale_s = sensor.stale_s ? to_float(*sensor.stale_s) : std::numeric_limits<float>::infinity();
  row.text = sensor.text;
  row.strict = sensor.strict;
  return row;
}

class PerceptionBuilder {
 public:
  explicit PerceptionBuilder(const Program& program) : program_(program), from_(program.perception) {}

  PerceptionForm run() {
    for (const program::Sensor& sensor : from_.sensors) {
      made_.sensor_of.insert(made_.sensor_of.end(), sensor.count, number(made_.sensors.size()));
      made_.sensors.push_back(sensor_row(sensor));
    }
    for (const program::Prototype& prototype : from_.prototypes) made_.prototypes.push_back(prototype_row(prototype.shape));
    made_.shape.readings = from_.readings();
    made_.shape.facts = number(from_.perceived.size());
    place_fits();
    for (std::size_t i = 0; i < from_.perceived.size(); ++i) place_of_.emplace(from_.perceived[i].fact, number(i));
    for (const program::Perceived& perceived : from_.perceived) {
      made_.fact.push_back(number(program::index(perceived.fact)));
      made_.steps_begin.push_back(number(made_.steps.size()));
      if (put(perceived.percept) > mts::kMaxPerceptDepth) throw std::logic_error("a definition is nested too deeply");
    }
    made_.steps_begin.push_back(number(made_.steps.size()));
    const auto lazy = std::count_if(from_.perceived.begin(), from_.perceived.end(), [](const auto& p) { return p.lazy; });
    made_.shape.lazy = number(static_cast<std::size_t>(lazy));
    if (made_.shape.lazy != 0) place_lazy();
    return std::move(made_);
  }

 private:
  /// Collects each pair of a reading and what it is compared with, without repetition, ordered by reading.
  void place_fits() {
    for (const Percept& percept : from_.percepts) {
      if (percept.op == Percept::Op::kFits || percept.op == Percept::Op::kReads) fit_of_.emplace(key(percept), 0);
    }
    made_.fits_begin.push_back(0);
    for (auto& [key, place] : fit_of_) {
      while (made_.fits_begin.size() <= key.first) made_.fits_begin.push_back(number(made_.fits.size()));
      place = number(made_.fits.size());
      made_.fits.push_back({key.first, key.second});
    }
    made_.fits_begin.resize(made_.shape.readings + 1u, number(made_.fits.size()));
    made_.shape.fits = number(made_.fits.size());
  }

  [[nodiscard]] std::pair<I, I> key(const Percept& percept) const {
    if (percept.op == Percept::Op::kFits) return {percept.reading, percept.prototype};
    const std::vector<std::string>& texts = from_.sensor_of(percept.reading).texts;
    const auto text = std::lower_bound(texts.begin(), texts.end(), percept.text);
    return {percept.reading, number(static_cast<std::size_t>(text - texts.begin()) + 1)};
  }

  /// Writes a definition in postfix form and returns the most values that it needs on the stack. Recursion as deep as definitions nest.
  I put(PerceptId id) {
    const Percept& percept = from_[id];
    switch (percept.op) {
      case Percept::Op::kFits: made_.steps.push_back({mts::PerceptOp::kFits, fit_of_.at(key(percept))}); return 1;
      case Percept::Op::kReads: made_.steps.push_back({mts::PerceptOp::kReads, fit_of_.at(key(percept))}); return 1;
      case Percept::Op::kFact: made_.steps.push_back({mts::PerceptOp::kFact, fact(percept.cell)}); return 1;
      case Percept::Op::kNot: {
        const I depth = put(percept.children.front());
        made_.steps.push_back({mts::PerceptOp::kNot, 0});
        return depth;
      }
      case Percept::Op::kAnd:
      case Percept::Op::kOr: break;
    }
    I depth = put(percept.children.front());
    for (std::size_t i = 1; i < percept.children.size(); ++i) {
      depth = std::max(depth, put(percept.children[i]) + 1);
      made_.steps.push_back({percept.op == Percept::Op::kAnd ? mts::PerceptOp::kAnd : mts::PerceptOp::kOr, 0});
    }
    return depth;
  }

  [[nodiscard]] I fact(program::CellId cell) const {
    const auto perceived = place_of_.find(cell);
    return perceived != place_of_.end() ? perceived->second : made_.shape.facts + number(program::index(cell));
  }

  void place_lazy() {
    const std::vector<program::Alternatives> alternatives = program::alternatives(program_, from_.lazy_facts());
    auto of_fact = alternatives.begin();
    for (const program::Perceived& perceived : from_.perceived) {
      const I self = number(made_.lazy.size());
      made_.lazy.push_back(perceived.lazy ? 1 : 0);
      made_.uses_begin.push_back(number(made_.uses.size()));
      for (I i = made_.steps_begin[self]; i < made_.steps_begin[self + 1]; ++i) {
        const mts::PerceptStep<I>& step = made_.steps[i];
        if (step.op != mts::PerceptOp::kFact || step.argument >= made_.shape.facts || !from_.perceived[step.argument].lazy) continue;
        made_.uses.push_back(step.argument);
      }
      made_.alternatives_begin.push_back(number(made_.demands_begin.size()));
      if (!perceived.lazy) continue;
      for (const std::vector<program::Demand>& alternative : *of_fact++) {
        made_.demands_begin.push_back(number(made_.demands.size()));
        for (const program::Demand& demand : alternative) {
          made_.demands.push_back({number(program::index(demand.cell)), static_cast<std::uint8_t>(demand.term), demand.negated});
        }
      }
    }
    made_.uses_begin.push_back(number(made_.uses.size()));
    made_.alternatives_begin.push_back(number(made_.demands_begin.size()));
    made_.demands_begin.push_back(number(made_.demands.size()));
  }

  const Program& program_;
  const program::Perception& from_;
  PerceptionForm made_;
  std::map<std::pair<I, I>, I> fit_of_;
  std::map<program::CellId, I> place_of_;   // by fact: its place among the perceived ones
};

}  // namespace

PerceptionForm build_perception(const Program& program) { return PerceptionBuilder(program).run(); }

mts::PerceptionTables<I> view(const PerceptionForm& form) {
  mts::PerceptionTables<I> t;
  t.shape = form.shape;
  t.sensors = form.sensors.data();
  t.sensor_of = form.sensor_of.data();
  t.prototypes = form.prototypes.data();
  t.fits_begin = form.fits_begin.data();
  t.fits = form.fits.data();
  t.fact = form.fact.data();
  t.steps_begin = form.steps_begin.data();
  t.steps = form.steps.data();
  t.lazy = form.lazy.empty() ? nullptr : form.lazy.data();
  t.uses_begin = form.uses_begin.data();
  t.uses = form.uses.data();
  t.alternatives_begin = form.alternatives_begin.data();
  t.demands_begin = form.demands_begin.data();
  t.demands = form.demands.data();
  return t;
}

std::string print(const PerceptionForm& form, const Program& program) {
  if (form.empty()) return {};
  std::string out = fmt::format("perception {} readings, {} fits, {} facts, {} lazy\n", form.shape.readings, form.shape.fits,
                                form.shape.facts, form.shape.lazy);
  const program::Perception& from = program.perception;
  for (I fit = 0; fit < form.fits.size(); ++fit) {
    const auto [reading, prototype] = form.fits[fit];
    const program::Sensor& sensor = from.sensor_of(reading);
    out += fmt::format("fit {} {} ~ {}\n", fit, from.reading_name(reading),
                       sensor.text ? '"' + sensor.texts[prototype - 1] + '"' : from.prototypes[prototype].text);
  }
  constexpr std::string_view kWords[] = {"fits ", "reads ", "fact ", "not", "and", "or"};
  static_assert(std::size(kWords) == static_cast<std::size_t>(mts::PerceptOp::kOr) + 1);
  for (I i = 0; i < form.shape.facts; ++i) {
    out += fmt::format("perceive {}:", program.cells[form.fact[i]].name);
    for (I s = form.steps_begin[i]; s < form.steps_begin[i + 1]; ++s) {
      const mts::PerceptStep<I>& step = form.steps[s];
      out += fmt::format(" {}", kWords[static_cast<std::size_t>(step.op)]);
      if (step.op == mts::PerceptOp::kFits || step.op == mts::PerceptOp::kReads) out += fmt::format("{}", step.argument);
      if (step.op != mts::PerceptOp::kFact) continue;
      const I cell = step.argument < form.shape.facts ? form.fact[step.argument] : step.argument - form.shape.facts;
      out += program.cells[cell].name;
    }
    out += '\n';
    if (form.lazy.empty() || form.lazy[i] == 0) continue;
    for (I a = form.alternatives_begin[i]; a < form.alternatives_begin[i + 1]; ++a) {
      out += "  awaited while";
      for (I d = form.demands_begin[a]; d < form.demands_begin[a + 1]; ++d) {
        const mts::Demand<I>& demand = form.demands[d];
        out += fmt::format("{}{} is{} {}", d == form.demands_begin[a] ? " " : " and ", program.cells[demand.cell].name,
                           demand.negated ? " not" : "", word(program::Term{demand.term}));
      }
      out += form.demands_begin[a] == form.demands_begin[a + 1] ? " always\n" : "\n";
    }
  }
  return out;
}

}  // namespace kb::tables
