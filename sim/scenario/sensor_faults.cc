// Reads the faults of sensors in a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "sim/scenario/names.h"

namespace kb::sim {
namespace {

/// A fault and its word. Its `amount` lies in the range `amounts`, if that is not empty, and is `usual` if the file does not say it.
/// `sensors`: those that can have the fault, as bits.
struct FaultWord {
  std::string_view word;
  Fault fault;
  TomlTable::Range amounts;
  double usual;
  unsigned sensors;
};
constexpr unsigned bit(SensorId id) { return 1u << static_cast<unsigned>(id); }
constexpr unsigned kAll = ~0u, kNoisy = kAll & ~bit(SensorId::kBumper), kMeasured = bit(SensorId::kLine) | bit(SensorId::kRange) | bit(SensorId::kCompass);
constexpr std::array kFaults{
    FaultWord{"none", Fault::kNone, {}, 0.0, kAll},
    FaultWord{"dead", Fault::kDead, {}, 0.0, kAll},
    FaultWord{"stuck", Fault::kStuck, {}, 0.0, kAll},
    FaultWord{"noisy", Fault::kNoisy, {0.0, 100.0}, 5.0, kNoisy},
    FaultWord{"delayed", Fault::kDelayed, {0.0, 2.0}, 0.3, kAll},
    FaultWord{"offset", Fault::kOffset, {-4.0, 4.0}, 0.1, kMeasured},
    FaultWord{"drift", Fault::kDrift, {-1.0, 1.0}, 0.01, kMeasured},
    FaultWord{"spikes", Fault::kSpikes, {0.0, 1.0}, 0.1, bit(SensorId::kRange)},
};

const FaultWord* read_fault(TomlTable& table, SensorId sensor) {
  if (!table.has("fault")) {
    table.missing("fault");
    return nullptr;
  }
  const auto word = table.text("fault");
  if (!word) return nullptr;
  std::vector<std::string_view> words;
  for (const FaultWord& known : kFaults) {
    if ((known.sensors & bit(sensor)) == 0) continue;
    if (known.word == *word) return &known;
    words.push_back(known.word);
  }
  table.unknown_name("fault", fmt::format("fault of the {} sensor", kSensorNames[static_cast<std::size_t>(sensor)]), *word, words);
  return nullptr;
}

bool read_element(TomlTable& table, Action& action) {
  const bool line = action.sensor == SensorId::kLine, array = line || action.sensor == SensorId::kRange;
  if (!array || action.fault == Fault::kDelayed) {
    const std::string why = array ? "all elements are delayed alike" : fmt::format("sensor `{}` has one element", kSensorNames[static_cast<std::size_t>(action.sensor)]);
    table.diagnostics().report(diagnostics::Kind::kSimUnknownKey, table.span("element"), {"element", why});
    return false;
  }
  const auto element = table.whole("element", (line ? mts::kLineSensors : mts::kRangeFinders) - 1);
  if (element) action.element = static_cast<std::uint32_t>(*element);
  return element.has_value();
}

}  // namespace

bool read_sensor_fault(TomlTable& table, Event& event) {
  const std::string name = table.text("sensor").value_or("");
  const auto found = std::find(kSensorNames.begin(), kSensorNames.end(), name);
  if (found == kSensorNames.end()) {
    if (!name.empty()) table.unknown_name("sensor", "sensor", name, kSensorNames);
    return false;
  }
  Action& action = event.action;
  action.kind = Action::Kind::kSensor;
  action.sensor = static_cast<SensorId>(found - kSensorNames.begin());
  const FaultWord* fault = read_fault(table, action.sensor);
  if (fault == nullptr) return false;
  action.fault = fault->fault;
  action.amount = fault->usual;
  if (fault->amounts.high > 0.0) action.amount = table.number("amount", fault->amounts).value_or(fault->usual);
  if (table.has("element") && !read_element(table, action)) return false;
  const std::string element = action.element ? fmt::format("[{}]", *action.element) : "";
  event.text = fmt::format("sensor {}{} {}", name, element, action.fault == Fault::kNone ? "well again" : fault->word);
  return true;
}

}  // namespace kb::sim
