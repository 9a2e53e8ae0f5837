#include "tools/kbc/wire/own_sensors.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/utf8.h"

namespace kb::wire {

using diagnostics::Kind;

namespace {

std::string_view field_of(sim::SensorFeed::What what) {
  switch (what) {
    using enum sim::SensorFeed::What;
    case kLine: return "line";
    case kRange: return "range_m";
    case kCompass: return "compass_rad";
    case kSpeed: return "odometry_m_s";
    case kTag:
    case kMemory: return "tag";
  }
  return {};
}

}  // namespace

OwnSensors::OwnSensors(const sim::Knowledge& knowledge) : knowledge_(knowledge) {
  for (const program::Sensor& sensor : knowledge.program->perception.sensors) {
    if (sensor.array) places_.emplace(sensor.name, Place{sensor.first, sensor.count, true});
    for (std::uint32_t i = 0; i < sensor.count; ++i) places_.emplace(knowledge.program->perception.reading_name(sensor.first + i), Place{sensor.first + i});
  }
}

/// The field of a line that gives this reading; empty if none does.
std::string_view OwnSensors::field_of(std::uint32_t reading) const {
  for (const sim::SensorFeed& feed : knowledge_.feeds) {
    if (reading >= feed.first && reading < feed.first + feed.count) return wire::field_of(feed.what);
  }
  return {};
}

std::vector<const program::Sensor*> OwnSensors::sensors() const {
  std::vector<const program::Sensor*> sensors;
  for (const program::Sensor& sensor : knowledge_.program->perception.sensors) {
    if (field_of(sensor.first + sensor.count - 1).empty()) sensors.push_back(&sensor);   // the robot's elements are the first ones
  }
  return sensors;
}

Mistake OwnSensors::unknown(const Line::Measured& one) const {
  std::vector<std::string_view> names;
  for (const auto& [name, place] : places_) names.push_back(name);
  return {Kind::kWireUnknownName, {"sensor", source::printable(one.sensor.text), {}}, "readings", one.sensor.at, diagnostics::closest(one.sensor.text, names)};
}

std::optional<Mistake> OwnSensors::look_up(const std::vector<Line::Measured>& measured, std::vector<Heard>& heard) const {
  heard.clear();
  for (const Line::Measured& one : measured) {
    const auto place = places_.find(one.sensor.text);
    if (place == places_.end()) return unknown(one);
    if (auto mistake = look_up(one, place->second, heard)) return mistake;
  }
  return std::nullopt;
}

std::optional<Mistake> OwnSensors::look_up(const Line::Measured& one, const Place& place, std::vector<Heard>& heard) const {
  const std::string field = "readings." + one.sensor.text;
  const bool text = knowledge_.program->perception.sensor_of(place.first).text;
  const auto wrong = [&](std::string is, std::string wanted) { return Mistake{Kind::kWireType, {field, std::move(is), std::move(wanted)}, field, one.sensor.at}; };
  if (one.list != place.list || one.values.size() != place.count) {
    return wrong(one.list ? fmt::format("a list of {}", one.values.size()) : "one value", place.list ? fmt::format("a list of {}", place.count) : "one value");
  }
  for (std::uint32_t i = 0; i < place.count; ++i) {
    const Line::Value& value = one.values[i];
    if (const std::string_view other = field_of(place.first + i); !other.empty()) {
      return Mistake{Kind::kWireOtherField, {knowledge_.program->perception.reading_name(place.first + i), std::string(other), {}}, field, one.sensor.at};
    }
    const bool is_text = std::holds_alternative<std::string>(value);
    if (is_text != text && !std::holds_alternative<std::monostate>(value)) return wrong(is_text ? "a string" : "a number", text ? "a string" : "a number");
    heard.push_back({place.first + i, value});
  }
  return std::nullopt;
}

}  // namespace kb::wire
