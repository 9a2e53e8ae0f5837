#include "tools/kbc/wire/describe.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

#include <waymark/controllers/similarity.h>
#include "tools/kbc/trace/json_number.h"
#include "tools/kbc/wire/line.h"
#include "tools/kbc/wire/own_sensors.h"

namespace kb::wire {
namespace {

using Document = nlohmann::ordered_json;

/// Rounds to a tenth of a millimetre or milliradian.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

/// Facts that are made from senses: by the driver, and by the knowledge base's own perception.
std::set<program::CellId> perceived(const sim::Knowledge& knowledge) {
  std::set<program::CellId> facts(knowledge.perceived.begin(), knowledge.perceived.end());
  for (const program::Perceived& one : knowledge.program->perception.perceived) facts.insert(one.fact);
  return facts;
}

Document fields_json() {
  Document fields = Document::array();
  for (const FieldHelp& field : line_fields()) fields.push_back({{"name", field.name}, {"unit", field.unit}, {"about", field.about}});
  return fields;
}

Document landmarks_json(const sim::Labyrinth& labyrinth) {
  Document landmarks = Document::array();
  for (const sim::Crossing& crossing : labyrinth.crossings) {
    Document exits = Document::array();
    for (const sim::Arm& arm : crossing.arms) {
      exits.push_back({{"exit", arm.name}, {"by", labyrinth[arm.road].method}, {"heading_rad", rounded(arm.heading_rad)}, {"stop_line_m", rounded(arm.stop_m)}});
    }
    landmarks.push_back({{"landmark", crossing.name}, {"x_m", rounded(crossing.at.x_m)}, {"y_m", rounded(crossing.at.y_m)}, {"exits", std::move(exits)}});
  }
  return landmarks;
}

Document sensors_json(const sim::Knowledge& knowledge) {
  Document sensors = Document::array();
  for (const auto& [sensor, from] : OwnSensors(knowledge).sensors()) {
    Document one{{"name", sensor->name}};
    if (sensor->array) one["elements"] = sensor->count;
    if (from > 0) one["from"] = from;
    if (sensor->text) one["texts"] = sensor->texts;
    else one.update({{"range", {trace::json_number(static_cast<float>(sensor->low)), trace::json_number(static_cast<float>(sensor->high))}}, {"unit", sensor->unit}});
    sensors.push_back(std::move(one));
  }
  return sensors;
}

Document robot_json(const sim::Scenario& robot) {
  const mts::Body body = sim::as_driven(robot.body, robot.sensors.range, robot.drive);
  return {{"size", trace::json_number(body.size)}, {"radius_m", trace::json_number(body.radius_m)}, {"wheel_base_m", trace::json_number(body.wheel_base_m)}, {"speed_m_s", trace::json_number(body.top_speed_m_s)},
          {"acceleration_m_s2", trace::json_number(body.top_acceleration_m_s2)}, {"turn_rad_s", trace::json_number(body.top_turn_rad_s)},
          {"pace", trace::json_number(1.0f / mts::Similarity::slowness(body))}, {"line_ahead_m", trace::json_number(body.line_ahead_m)},
          {"line_span_m", trace::json_number(body.line_span_m)}, {"range_latency_s", trace::json_number(body.range_latency_s)}};
}

Document floor_json(const mts::Body& body) {
  return {{"line_width_m", trace::json_number(body.paint_width_m)}, {"stop_line_width_m", trace::json_number(body.stop_line_width_m)},
          {"road_width_m", trace::json_number(body.road_width_m)}, {"tag_before_stop_line_m", rounded(static_cast<double>(body.size) * sim::kTagBefore)}};
}

}  // namespace

std::string describe(const sim::Knowledge& knowledge, const sim::Labyrinth& labyrinth, const sim::Scenario& robot, const ExchangeOptions& options) {
  const std::set<program::CellId> known = perceived(knowledge);
  Document buttons = Document::array(), told = Document::array(), made = Document::array(), missions = Document::array();
  for (std::uint32_t fact = 0; fact < knowledge.program->facts; ++fact) {
    const program::Cell& cell = knowledge.program->cells[fact];
    (cell.command ? buttons : known.contains(program::CellId{fact}) ? made : told).push_back(cell.name);
  }
  for (const sim::Mission& mission : knowledge.missions) missions.push_back({{"command", knowledge.program->cells[program::index(mission.command)].name}, {"goal", mission.goal}});
  const Document all{{"tick_s", options.dt_us / 1e6}, {"pause_s", static_cast<double>(options.pause_us) / 1e6}, {"scale", labyrinth.scale}, {"robot", robot_json(robot)}, {"floor", floor_json(robot.body)},
                 {"fields", fields_json()}, {"commands", std::move(buttons)}, {"missions", std::move(missions)}, {"facts_of_the_host", std::move(told)},
                 {"facts_perceived", std::move(made)}, {"sensors_of_the_host", sensors_json(knowledge)}, {"landmarks", landmarks_json(labyrinth)}};
  return all.dump(2, ' ', false, Document::error_handler_t::replace) + "\n";
}

}  // namespace kb::wire
