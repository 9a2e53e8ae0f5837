// The robot's sensors: line array, range finders, compass, odometry, tag reader, bumper. Each is sampled at its rate with
// noise and bias drawn from the seed, and heard after its latency.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <waymark/controllers/senses.h>
#include "sim/robot/body.h"
#include "sim/robot/channel.h"
#include "sim/robot/drive_train.h"
#include "sim/world/floor.h"

namespace kb::sim {

enum class SensorId : std::uint8_t { kLine, kRange, kCompass, kOdometry, kTag, kBumper };
inline constexpr auto kSensorNames = std::to_array<std::string_view>({"line", "range", "compass", "odometry", "tag", "bumper"});   // in this order
static_assert(kSensorNames.size() == static_cast<std::size_t>(SensorId::kBumper) + 1);

/// The build of each sensor. Noise and bias are in the unit of the sensor: darkness, m, rad, a share of the way, a share of
/// the readings that fail, -.
struct SensorBuilds {
  SensorBuild line{100.0, 0.005, 0.02, 0.01};
  SensorBuild range{20.0, 0.02, 0.01, 0.005};
  SensorBuild compass{50.0, 0.02, 0.017, 0.008};
  SensorBuild odometry{50.0, 0.01, 0.005, 0.01};
  SensorBuild tag{20.0, 0.02, 0.05, 0.0};
  SensorBuild bumper{50.0, 0.0, 0.0, 0.0};
  [[nodiscard]] SensorBuild& operator[](SensorId id);
};

// What they see, and how far.
inline constexpr double kArraySpot = 0.010;     ///< radius of the spot that one sees, m; scaled down on a robot below size 1
inline constexpr double kConeHalf = 0.21;       ///< half angle of a range finder's cone, rad: the reading is the nearest of three rays
inline constexpr double kRangeLeast = 0.02;     ///< nothing nearer is measured, m

/// What is heard from the tag reader: a working reader reports even that it reads nothing.
struct TagHeard {
  bool alive = false;
  std::shared_ptr<const Memory> memory;   ///< null: no tag
  std::uint32_t arm = 0;
};

class Sensors {
 public:
  /// `body` says where the line sensors sit.
  Sensors(const SensorBuilds& builds, std::uint64_t seed, const mts::Body& body = kRobot);

  /// Samples the sensors that are due.
  void sample(std::int64_t now_us, const Arena& arena, const Floor& floor, const DriveTrain& wheels, double dt_s);
  /// Writes into `senses` what is heard now.
  void hear(std::int64_t now_us, mts::Senses& senses) const;
  void hear_tag(std::int64_t now_us, TagHeard& tag) const;

  /// Gives a fault to a sensor or to one element of an array (`line`, `range`). `since_us`: when the fault began, if it was there
  /// before, which counts for a drift; negative: it begins now.
  void set_fault(SensorId sensor, std::optional<std::uint32_t> element, Fault fault, double amount, std::int64_t since_us = -1);
  /// Places steel in the floor or beside the road: within `radius_m` the compass points too far clockwise, by `degrees` in the middle
  /// and less farther out. Steel of the same name is moved.
  void place_steel(const std::string& name, Spot at, double radius_m, double degrees);
  void remove_steel(const std::string& name);
  /// Forgets all samples, as when power is lost: see Channel::clear. Odometry begins again at (0, 0).
  void clear();

 private:
  using Line = std::array<float, mts::kLineSensors>;
  using Range = std::array<float, mts::kRangeFinders>;
  struct Way { float x_m = 0.0f, y_m = 0.0f, speed_m_s = 0.0f, turned_rad = 0.0f; };
  struct TagSample { std::shared_ptr<const Memory> memory; std::uint32_t arm = 0; };
  struct Element {
    Fault fault = Fault::kNone;
    float amount = 1.0f, last = 0.0f;
    std::int64_t since_us = -1;   // when the fault began; negative until the first sample with it
  };
  struct Steel { std::string name; Spot at; double radius_m = 0.0, rad = 0.0; };

  void sample_line(std::int64_t now_us, const Pose& pose, const Floor& floor);
  void sample_range(std::int64_t now_us, const Pose& pose, const Arena& arena);
  static float spoil(Element& element, float value, float noise, std::int64_t now_us);
  [[nodiscard]] float false_echo(const Element& element, float value);
  [[nodiscard]] double bent_by_steel(Spot at) const;

  SensorBuilds builds_;
  mts::Body body_;
  Channel<Line> line_;
  Channel<Range> range_;
  Channel<float> compass_;
  Channel<Way> odometry_;
  Channel<TagSample> tag_;
  Channel<bool> bumper_;
  Random line_random_, range_random_, compass_random_, odometry_random_, tag_random_;
  Line line_bias_{};
  Range range_bias_{};
  float compass_bias_ = 0.0f, way_bias_ = 0.0f, turn_bias_ = 0.0f;
  std::array<Element, mts::kLineSensors> line_elements_{};
  std::array<Element, mts::kRangeFinders> range_elements_{};
  Element line_whole_, range_whole_, compass_whole_;   // faults of all elements together
  Random echo_random_;
  std::vector<Steel> steel_;
  double odometry_x_m_ = 0.0, odometry_y_m_ = 0.0, odometry_heading_rad_ = 0.0;
  bool odometry_began_ = false;
};

}  // namespace kb::sim
