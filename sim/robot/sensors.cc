#include "sim/robot/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kBright = 0.05, kDark = 0.95;
// Streams of the generator: see Random.
enum Stream : std::uint64_t { kLineStream = 1, kRangeStream, kCompassStream, kOdometryStream, kTagStream, kEchoStream };

Spot turned(Spot v, Spot ahead) { return {v.x_m * ahead.x_m - v.y_m * ahead.y_m, v.x_m * ahead.y_m + v.y_m * ahead.x_m}; }

/// The directions of all rays in the robot's own frame, three for each range finder.
const std::array<Spot, 3 * mts::kRangeFinders>& rays() {
  static const auto directions = [] {
    std::array<Spot, 3 * mts::kRangeFinders> made{};
    for (std::size_t i = 0; i < mts::kRangeFinders; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        made[3 * i + k] = direction(static_cast<double>(i) * kPi / 4.0 + (static_cast<double>(k) - 1.0) * kConeHalf);
      }
    }
    return made;
  }();
  return directions;
}

}  // namespace

SensorBuild& SensorBuilds::operator[](SensorId id) {
  switch (id) {
    case SensorId::kLine: return line;
    case SensorId::kRange: return range;
    case SensorId::kCompass: return compass;
    case SensorId::kOdometry: return odometry;
    case SensorId::kTag: return tag;
    case SensorId::kBumper: return bumper;
  }
  return bumper;
}

Sensors::Sensors(const SensorBuilds& builds, std::uint64_t seed, const mts::Body& body)
    : builds_(builds), body_(body), line_(builds.line), range_(builds.range), compass_(builds.compass), odometry_(builds.odometry), tag_(builds.tag),
      bumper_(builds.bumper), line_random_(seed, kLineStream), range_random_(seed, kRangeStream),
      compass_random_(seed, kCompassStream), odometry_random_(seed, kOdometryStream), tag_random_(seed, kTagStream),
      echo_random_(seed, kEchoStream) {
  for (float& bias : line_bias_) bias = static_cast<float>(builds.line.bias) * line_random_.bell();
  for (float& bias : range_bias_) bias = static_cast<float>(builds.range.bias) * range_random_.bell();
  compass_bias_ = static_cast<float>(builds.compass.bias) * compass_random_.bell();
  way_bias_ = static_cast<float>(builds.odometry.bias) * odometry_random_.bell();
  turn_bias_ = static_cast<float>(builds.odometry.bias) * odometry_random_.bell();
}

float Sensors::spoil(Element& element, float value, float noise, std::int64_t now_us) {
  if (element.since_us < 0) element.since_us = now_us;
  switch (element.fault) {
    case Fault::kDead: return 0.0f;
    case Fault::kStuck: return element.last;
    case Fault::kNoisy: value += noise * (element.amount - 1.0f); break;
    case Fault::kOffset: value += element.amount; break;
    case Fault::kDrift: value += element.amount * static_cast<float>(now_us - element.since_us) * 1e-6f; break;
    case Fault::kNone:
    case Fault::kDelayed:
    case Fault::kSpikes: break;
  }
  element.last = value;
  return value;
}

/// With `Fault::kSpikes`, now and then an echo nearer than the true one: of something that is not there, or of another sensor's pulse.
float Sensors::false_echo(const Element& element, float value) {
  if (element.fault != Fault::kSpikes || !echo_random_.chance(element.amount)) return value;
  return static_cast<float>(kRangeLeast) + echo_random_.unit() * (value - static_cast<float>(kRangeLeast));
}

double Sensors::bent_by_steel(Spot at) const {
  double rad = 0.0;
  for (const Steel& steel : steel_) rad += steel.rad * std::max(1.0 - distance(steel.at, at) / steel.radius_m, 0.0);
  return rad;
}

void Sensors::place_steel(const std::string& name, Spot at, double radius_m, double degrees) {
  remove_steel(name);
  steel_.push_back({name, at, radius_m, -degrees * kPi / 180.0});
}

void Sensors::remove_steel(const std::string& name) {
  std::erase_if(steel_, [&](const Steel& steel) { return steel.name == name; });
}

void Sensors::sample_line(std::int64_t now_us, const Pose& pose, const Floor& floor) {
  const Spot ahead = direction(pose.heading_rad);
  const float spread = static_cast<float>(builds_.line.noise) * line_.noise_factor();
  const double spot_m = kArraySpot * std::min(static_cast<double>(body_.size), 1.0);
  Line line{};
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Spot where{static_cast<double>(body_.line_ahead_m), static_cast<double>(body_.line_sensor_left_m(i))};
    const float dark = floor.darkness(Spot{pose.x_m, pose.y_m} + turned(where, ahead), spot_m);
    const float noise = spread * line_random_.bell();
    const float value = static_cast<float>(kBright) + static_cast<float>(kDark - kBright) * dark + line_bias_[i] + noise;
    const float spoilt = spoil(line_whole_, spoil(line_elements_[i], value, noise, now_us), noise, now_us);
    line[i] = line_elements_[i].fault == Fault::kDead ? 0.0f : std::clamp(spoilt, 0.0f, 1.0f);
  }
  line_.take(now_us, line);
}

void Sensors::sample_range(std::int64_t now_us, const Pose& pose, const Arena& arena) {
  const Spot ahead = direction(pose.heading_rad);
  const Spot from{pose.x_m, pose.y_m};
  const float spread = static_cast<float>(builds_.range.noise) * range_.noise_factor();
  const float out_of_range_m = mts::out_of_range_m(body_);
  Range range{};
  for (std::size_t i = 0; i < range.size(); ++i) {
    float nearest = out_of_range_m;
    for (std::size_t k = 0; k < 3; ++k) {
      nearest = std::min(nearest, arena.ray(from, turned(rays()[3 * i + k], ahead), static_cast<double>(nearest)));
    }
    const float noise = spread * range_random_.bell();
    const float value = nearest >= out_of_range_m ? out_of_range_m : nearest + range_bias_[i] + noise;
    const bool seen = nearest < out_of_range_m;
    float spoilt = value;
    for (Element* element : {&range_elements_[i], &range_whole_}) {
      const bool shifts = element->fault == Fault::kNoisy || element->fault == Fault::kOffset || element->fault == Fault::kDrift;
      if (seen || !shifts) spoilt = spoil(*element, spoilt, noise, now_us);   // without an echo there is no distance that could be off
      spoilt = false_echo(*element, spoilt);
    }
    range[i] = range_elements_[i].fault == Fault::kDead ? std::numeric_limits<float>::quiet_NaN() : std::clamp(spoilt, static_cast<float>(kRangeLeast), out_of_range_m);
  }
  range_.take(now_us, range);
}

void Sensors::sample(std::int64_t now_us, const Arena& arena, const Floor& floor, const DriveTrain& wheels, double dt_s) {
  const Pose pose = arena.pose();
  if (!odometry_began_) {
    odometry_heading_rad_ = pose.heading_rad;
    odometry_began_ = true;
  }
  const double way_m = wheels.wheel_speed_m_s() * (1.0 + static_cast<double>(way_bias_)) * dt_s;
  odometry_heading_rad_ += wheels.wheel_turn_rad_s() * (1.0 + static_cast<double>(turn_bias_)) * dt_s;
  odometry_x_m_ += way_m * std::cos(odometry_heading_rad_);
  odometry_y_m_ += way_m * std::sin(odometry_heading_rad_);
  if (line_.due(now_us)) sample_line(now_us, pose, floor);
  if (range_.due(now_us)) sample_range(now_us, pose, arena);
  if (compass_.due(now_us)) {
    const float noise = static_cast<float>(builds_.compass.noise) * compass_.noise_factor() * compass_random_.bell();
    const float off = spoil(compass_whole_, compass_bias_ + noise, noise, now_us);
    compass_.take(now_us, static_cast<float>(wrap(pose.heading_rad + bent_by_steel({pose.x_m, pose.y_m}) + static_cast<double>(off))));
  }
  if (odometry_.due(now_us)) {
    const float noise = static_cast<float>(builds_.odometry.noise) * odometry_.noise_factor() * odometry_random_.bell();
    odometry_.take(now_us, {static_cast<float>(odometry_x_m_), static_cast<float>(odometry_y_m_),
                            static_cast<float>(wheels.wheel_speed_m_s() * (1.0 + static_cast<double>(way_bias_))) * (1.0f + noise),
                            static_cast<float>(wrap(odometry_heading_rad_))});
  }
  if (tag_.due(now_us)) {
    const Floor::Reading* reading = floor.tag_near({pose.x_m, pose.y_m});
    const bool fails = tag_random_.chance(static_cast<float>(builds_.tag.noise) * tag_.noise_factor());
    tag_.take(now_us, reading == nullptr || fails ? TagSample{} : TagSample{reading->memory, reading->arm});
  }
  if (bumper_.due(now_us)) bumper_.take(now_us, arena.touching());
}

void Sensors::hear(std::int64_t now_us, mts::Senses& senses) const {
  senses = {};
  if (const Line* line = line_.heard(now_us)) {
    std::copy(line->begin(), line->end(), senses.line);
    senses.line_known = true;
  }
  for (float& range : senses.range_m) range = mts::out_of_range_m(body_);
  if (const Range* range = range_.heard(now_us)) {
    std::copy(range->begin(), range->end(), senses.range_m);
    senses.range_known = true;
  }
  if (const float* heading_rad = compass_.heard(now_us)) {
    senses.heading_rad = *heading_rad;
    senses.heading_known = true;
  }
  if (const Way* way = odometry_.heard(now_us)) {
    senses.x_m = way->x_m;
    senses.y_m = way->y_m;
    senses.speed_m_s = way->speed_m_s;
    senses.turned_rad = way->turned_rad;
    senses.odometry_known = senses.turned_known = true;
  }
  const bool* touched = bumper_.heard(now_us);
  senses.touched = touched != nullptr && *touched;
}

void Sensors::hear_tag(std::int64_t now_us, TagHeard& tag) const {
  const TagSample* sample = tag_.heard(now_us);
  tag.alive = sample != nullptr;
  if (sample == nullptr) {
    tag.memory = nullptr;
    return;
  }
  if (tag.memory != sample->memory) tag.memory = sample->memory;   // mostly equal: saves counting a reference
  tag.arm = sample->arm;
}

void Sensors::set_fault(SensorId sensor, std::optional<std::uint32_t> element, Fault fault, double amount, std::int64_t since_us) {
  if (element && (sensor == SensorId::kLine || sensor == SensorId::kRange)) {
    Element& one = sensor == SensorId::kLine ? line_elements_[*element] : range_elements_[*element];
    one = {fault, static_cast<float>(amount), one.last, since_us};
    return;
  }
  const bool of_values = fault == Fault::kOffset || fault == Fault::kDrift || fault == Fault::kSpikes;
  const Element whole{of_values ? fault : Fault::kNone, static_cast<float>(amount), 0.0f, since_us};
  if (sensor == SensorId::kLine) line_whole_ = whole;
  if (sensor == SensorId::kRange) range_whole_ = whole;
  if (sensor == SensorId::kCompass) compass_whole_ = whole;
  if (of_values) fault = Fault::kNone;
  switch (sensor) {
    case SensorId::kLine: return line_.set_fault(fault, amount);
    case SensorId::kRange: return range_.set_fault(fault, amount);
    case SensorId::kCompass: return compass_.set_fault(fault, amount);
    case SensorId::kOdometry: return odometry_.set_fault(fault, amount);
    case SensorId::kTag: return tag_.set_fault(fault, amount);
    case SensorId::kBumper: return bumper_.set_fault(fault, amount);
  }
}

void Sensors::clear() {
  line_.clear();
  range_.clear();
  compass_.clear();
  odometry_.clear();
  tag_.clear();
  bumper_.clear();
  odometry_x_m_ = odometry_y_m_ = 0.0;
  odometry_began_ = false;
}

}  // namespace kb::sim
