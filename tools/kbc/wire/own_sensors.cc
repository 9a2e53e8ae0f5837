#include "tools/kbc/wire/own_sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

std::vector<OwnSensors::Sensor> OwnSensors::sensors() const {
  std::vector<Sensor> sensors;
  for (const program::Sensor& sensor : knowledge_.program->perception.sensors) {
    const std::uint32_t from = sim::elements_of_robot(knowledge_, sensor);
    if (from < sensor.count) sensors.push_back({&sensor, from});
  }
  return sensors;
}

std::optional<Mistake> OwnSensors::look_up(const std::vector<Line::Measured>& measured, std::vector<Heard>& heard) const {
  heard.clear();
  if (measured.empty()) return std::nullopt;
  for (const Line::Measured& one : measured) {
    const auto place = places_.find(one.sensor.text);
    if (place == places_.end()) {
      std::vector<std::string_view> names;
      for (const auto& [name, at] : places_) names.push_back(name);
      return no_such("sensor", one.sensor, "readings", diagnostics::closest(one.sensor.text, names));
    }
    if (auto mistake = look_up(one, place->second, heard)) return mistake;
  }
  std::vector<bool> seen(knowledge_.program->perception.readings());
  for (const Heard& one : heard) {   // an array, and one of its elements beside it
    const std::string field = "readings." + knowledge_.program->perception.reading_name(one.reading);
    if (seen[one.reading]) return Mistake{Kind::kWireTwice, {field, {}, {}}, field, measured.back().sensor.at};
    seen[one.reading] = true;
  }
  return std::nullopt;
}

std::optional<Mistake> OwnSensors::out_of_range(const std::vector<Heard>& heard, const std::function<bool(const std::string& sensor)>& said) const {
  const program::Perception& perception = knowledge_.program->perception;
  for (const Heard& one : heard) {
    const program::Sensor& sensor = perception.sensor_of(one.reading);
    const float* const value = std::get_if<float>(&one.value);
    if (value == nullptr || sensor.text || sensor.circular || sensor.strict) continue;
    const double says = static_cast<double>(*value);
    const double beside = static_cast<double>(std::numeric_limits<float>::epsilon()) * std::max(std::abs(sensor.low), std::abs(sensor.high));   // 0.1 is no float
    if ((says >= sensor.low - beside && says <= sensor.high + beside) || said(sensor.name)) continue;
    const std::string field = "readings." + perception.reading_name(one.reading);
    return Mistake{Kind::kWireOutOfRange, {field, fmt::format("{:g}", *value), fmt::format("{:g}", says < sensor.low ? sensor.low : sensor.high)}, field, one.at};
  }
  return std::nullopt;
}

std::optional<Mistake> OwnSensors::look_up(const Line::Measured& one, const Place& place, std::vector<Heard>& heard) const {
  const program::Perception& perception = knowledge_.program->perception;
  const std::string field = "readings." + one.sensor.text;
  const bool text = perception.sensor_of(place.first).text, silent = !one.list && std::holds_alternative<std::monostate>(one.values.front());
  const auto wrong = [&](std::string at, std::string is, std::string wanted) { return Mistake{Kind::kWireType, {at, std::move(is), std::move(wanted)}, at, one.sensor.at}; };
  if (!silent && (one.list != place.list || one.values.size() != place.count)) {
    return wrong(field, one.list ? fmt::format("a list of {}", one.values.size()) : "one value", place.list ? fmt::format("a list of {}", place.count) : "one value");
  }
  for (std::uint32_t i = 0; i < place.count; ++i) {
    const Line::Value& value = one.values[silent ? 0 : i];
    const bool says = !std::holds_alternative<std::monostate>(value), is_text = std::holds_alternative<std::string>(value);
    if (const std::string_view other = field_of(place.first + i); !other.empty()) {
      if (!says && place.list) continue;   // the robot has this element itself
      return Mistake{Kind::kWireOtherField, {perception.reading_name(place.first + i), std::string(other), {}}, field, one.sensor.at};
    }
    if (says && is_text != text) return wrong(place.list ? fmt::format("{}[{}]", field, i) : field, is_text ? "a string" : "a number", text ? "a string" : "a number");
    heard.push_back({place.first + i, value, one.sensor.at});
  }
  return std::nullopt;
}

}  // namespace kb::wire
