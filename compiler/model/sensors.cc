// Sensors: what they measure, how exactly, and how long a reading holds.
#include <fmt/format.h>

#include <cmath>

#include "compiler/model/draft.h"
#include "compiler/model/units.h"
#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

constexpr std::uint32_t kMaxReadings = 65535;

class SensorReader {
 public:
  SensorReader(Draft& draft, const syntax::Sensor& from) : draft_(draft), from_(from) {}

  void run() {
    sensor_.name = std::string(from_.name.text);
    sensor_.text = !from_.range;
    sensor_.declared = from_.name.span;
    read_count();
    sensor_.text ? read_text() : read_number();
    read_stale();
    if (!draft_.declare(from_.name, Entity::Kind::kSensor, draft_.model.sensors.size(), good_)) return;
    if (!draft_.model.sensors.empty()) sensor_.first = draft_.model.sensors.back().first + draft_.model.sensors.back().count;
    if (sensor_.first + sensor_.count > kMaxReadings) {
      draft_.exhausted = true;
      draft_.diagnostics.report(Kind::kTooManyReadings, from_.name.span, {fmt::format("{}", kMaxReadings)});
      return;
    }
    draft_.model.sensors.push_back(std::move(sensor_));
    draft_.sensors.push_back({std::move(domain_), false});
  }

 private:
  void fail(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
    draft_.diagnostics.report(kind, at, arguments);
    good_ = false;
  }

  void read_count() {
    if (!from_.count) return;
    sensor_.array = true;
    const double count = from_.count->value;
    if (!(count >= 1.0 && count <= kMaxReadings) || count != std::floor(count)) {
      return fail(Kind::kSensorCount, from_.count->span,
                  {sensor_.name, syntax::number_text(*from_.count), fmt::format("{}", kMaxReadings)});
    }
    sensor_.count = static_cast<std::uint32_t>(count);
  }

  void read_text() {
    if (from_.noise) fail(Kind::kSensorTextAttribute, from_.noise->span, {"noise", sensor_.name});
    if (from_.circular) fail(Kind::kSensorTextAttribute, *from_.circular, {"circular", sensor_.name});
    if (from_.strict) fail(Kind::kSensorTextAttribute, *from_.strict, {"strict", sensor_.name});
  }

  void read_number() {
    auto domain = resolve_range(from_.range->first, from_.range->second, sensor_.name, from_.circular.has_value(),
                                draft_.diagnostics);
    good_ = good_ && domain.has_value();
    if (!domain) return;
    domain_ = std::move(*domain);
    sensor_.low = domain_.low;
    sensor_.high = domain_.high;
    sensor_.unit = domain_.unit;
    sensor_.circular = domain_.circular;
    sensor_.strict = from_.strict.has_value();
    if (from_.noise) read_noise(*from_.noise);
  }

  void read_noise(const syntax::Number& number) {
    const auto noise = resolve_number(number, domain_, draft_.diagnostics);
    good_ = good_ && noise.has_value();
    if (!noise) return;
    sensor_.noise = *noise;
    const std::string written = syntax::number_text(number);
    const double half = 0.5 * (sensor_.high - sensor_.low);
    if (*noise < 0.0) return fail(Kind::kNegativeNoise, number.span, {sensor_.name, written});
    if (*noise < half) return;
    fail(Kind::kNoiseTooLarge, number.span,
         {sensor_.name, written, fmt::format("{}{}{}", half, sensor_.unit.empty() ? "" : " ", sensor_.unit)});
  }

  void read_stale() {
    if (!from_.stale) return;
    const auto time = to_microseconds(*from_.stale, draft_.diagnostics);
    good_ = good_ && time.has_value();
    if (!time) return;
    if (*time == 0) return fail(Kind::kStaleNotPositive, from_.stale->span, {sensor_.name, syntax::number_text(*from_.stale)});
    sensor_.stale_s = static_cast<double>(*time) / 1e6;
  }

  Draft& draft_;
  const syntax::Sensor& from_;
  Sensor sensor_;
  Domain domain_;
  bool good_ = true;
};

}  // namespace

void declare_sensors(Draft& draft) {
  draft.each<syntax::Sensor>([&](const auto&, const auto&, const syntax::Sensor& sensor) {
    if (!draft.exhausted) SensorReader(draft, sensor).run();
  });
}

}  // namespace kb::model
