#include "compiler/program/lower_perception.h"

#include "compiler/model/model.h"

namespace kb::program {
namespace {

Sensor lower_sensor(const model::Sensor& from) {
  Sensor made{from.name, from.text, from.array, from.low, from.high, from.unit, from.circular, from.noise,
              from.stale_s, 0.0, from.first, from.count, {}, from.declared, from.strict};
  made.growth = growth_of(made);
  return made;
}

}  // namespace

Perception lower_perception(const model::Model& model, const std::vector<CellId>& cell_of) {
  Perception made;
  for (const model::Sensor& sensor : model.sensors) made.sensors.push_back(lower_sensor(sensor));
  for (const model::PlacedShape& shape : model.placed_shapes) made.prototypes.push_back({shape.shape, shape.text});
  for (const model::Percept& from : model.percepts) {
    Percept percept{from.op, from.reading, from.shape, from.text, CellId::kNone, {}};
    if (from.op == model::Percept::Op::kFact) percept.cell = cell_of[model::index(from.cell)];
    for (const model::PerceptId child : from.children) percept.children.push_back(PerceptId{static_cast<std::uint32_t>(child)});
    if (from.op == model::Percept::Op::kReads) {
      made.sensors[static_cast<std::size_t>(&made.sensor_of(from.reading) - made.sensors.data())].texts.push_back(from.text);
    }
    made.percepts.push_back(std::move(percept));
  }
  for (Sensor& sensor : made.sensors) {
    source::sort_unique(sensor.texts);
  }
  for (const model::Perceived& from : model.perceived) {
    made.perceived.push_back({cell_of[model::index(from.fact)], PerceptId{static_cast<std::uint32_t>(from.percept)}, from.lazy, from.span});
  }
  return made;
}

}  // namespace kb::program
