// Sensors that the knowledge base declares and the host reads: those that none of the other fields of a line gives.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mind/knowledge.h"
#include "tools/kbc/wire/line.h"
#include "tools/kbc/wire/mistake.h"

namespace kb::wire {

class OwnSensors {
 public:
  /// `knowledge` must outlive it. O(readings).
  explicit OwnSensors(const sim::Knowledge& knowledge);

  /// A value for one reading of the program; nothing: the sensor is silent.
  struct Heard {
    std::uint32_t reading = 0;
    Line::Value value;
    source::Span at{};
  };
  /// Looks up what a line has measured; returns the first mistake.
  [[nodiscard]] std::optional<Mistake> look_up(const std::vector<Line::Measured>& measured, std::vector<Heard>& heard) const;
  /// The warning for the first of these whose sensor has a range that it lies outside of; `said`: what was warned of already.
  [[nodiscard]] std::optional<Mistake> out_of_range(const std::vector<Heard>& heard, const std::function<bool(const std::string& sensor)>& said) const;
  /// A sensor of which the host gives the elements from `from` on: the robot has those before.
  struct Sensor { const program::Sensor* sensor = nullptr; std::uint32_t from = 0; };
  /// In order of declaration.
  [[nodiscard]] std::vector<Sensor> sensors() const;

 private:
  struct Place { std::uint32_t first = 0, count = 1; bool list = false; };
  [[nodiscard]] std::optional<Mistake> look_up(const Line::Measured& one, const Place& place, std::vector<Heard>& heard) const;
  [[nodiscard]] std::string_view field_of(std::uint32_t reading) const;

  const sim::Knowledge& knowledge_;
  std::map<std::string, Place, std::less<>> places_;   // of elements and of arrays, by name
};

}  // namespace kb::wire
