// A whole robot: what its sensors read in, the motion of its wheels out. The robot that moves here is the simulator's, which says what it
// senses as lines of JSON (docs/driving.md) and obeys the answers. For one of your own replace `read_line` and `answer`; the rest stays.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include <waymark/controllers/lookout.h>

#include "mission.kb.map.h"

namespace {

using Json = nlohmann::json;

constexpr double kTick_s = 0.1;   // the mind decides ten times a second, the wheels are told fifty times

/// What the robot senses in one control period.
struct Reading {
  double t_s = 0.0;
  mts::Senses senses;
  std::string landmark, side, closed;   // what the tag says that is read; empty: nothing
  bool safe = true;
  Json buttons = Json::array();
};

bool read(const Json& line, const char* field, float& number) {
  const Json value = line.value(field, Json());
  if (value.is_number()) number = value.get<float>();
  return value.is_number();
}
template <std::size_t kCount>
bool read(const Json& line, const char* field, float (&numbers)[kCount]) {
  const Json values = line.value(field, Json());
  if (!values.is_array() || values.size() != kCount) return false;
  for (std::size_t i = 0; i < kCount; ++i) numbers[i] = values[i].is_number() ? values[i].get<float>() : -1.0f;   // below 0: that one is silent
  return true;
}

Reading read_line(const std::string& text) {
  const Json line = Json::parse(text);
  Reading now;
  now.t_s = line.at("t").get<double>();
  mts::Senses& senses = now.senses;
  senses.line_known = read(line, "line", senses.line);
  senses.range_known = read(line, "range_m", senses.range_m);
  senses.heading_known = read(line, "compass_rad", senses.heading_rad);
  senses.odometry_known = read(line, "odometry_m_s", senses.speed_m_s);
  senses.turned_known = read(line, "odometry_turned_rad", senses.turned_rad);
  if (!read(line, "odometry_x_m", senses.x_m) || !read(line, "odometry_y_m", senses.y_m)) senses.x_m = senses.y_m = 0.0f;   // then the speed counts
  senses.touched = line.value("touched", false);
  const Json tag = line.value("tag", Json::object());
  now.landmark = tag.value("landmark", "");
  now.side = tag.value("exit", "");
  now.safe = tag.value("safe", true);
  for (const Json& side : tag.value("closed", Json::array())) now.closed += side.get<std::string>() + ' ';
  now.buttons = line.value("buttons", Json::array());
  return now;
}

class Robot {
 public:
  explicit Robot(const mts::Body& body) : pilot_(body), lookout_(body, mission::landmarks(), mission::find_road) {}

  /// Whether the pilot can drive by all control lines.
  bool ready() const {
    for (std::uint32_t s = 0; s < mission::Knowledge::kShape.strategies; ++s) {
      const mts::ControlLine* line = mission::control_line(static_cast<mission::Strategy>(s));
      if (line == nullptr || pilot_.fits(*line) != mts::Setting::kSet) return false;
    }
    return true;
  }
  /// One control period.
  mts::Motion step(const Reading& now) {
    const float period_s = began_ ? static_cast<float>(now.t_s - last_s_) : 0.02f;
    began_ = true;
    last_s_ = now.t_s;
    if (now.t_s >= tick_s_) tick(now);
    const mts::Motion wheels = pilot_.step(now.senses, period_s);
    lookout_.step(pilot_, {now.landmark.c_str(), now.side.c_str(), now.safe, now.closed.c_str(), "mark azimuth"}, period_s);
    return wheels;
  }
  /// What the judge of a simulated drive may want to know.
  Json state() const {
    Json state = {{"strategy", nullptr}, {"mission", mind_.high(mission::Satellite::Errand)}, {"reports", Json::array()}};
    if (mind_.decision().drives()) state["strategy"] = mission::name(mind_.decision().strategy());
    for (std::uint32_t s = 0; s < mission::Knowledge::kShape.satellites; ++s) {
      const auto satellite = static_cast<mission::Satellite>(s);
      const std::string name = mission::name(satellite);
      if (!mind_.high(satellite)) continue;
      if (name.starts_with("Help.")) state["reports"].push_back(name);
      if (!name.starts_with("Errand.")) continue;
      state["leg"] = name;
      state["goal"] = name.substr(name.find_last_of(":>") + 1);
    }
    return state;
  }

 private:
  void tick(const Reading& now) {
    tick_s_ = now.t_s + kTick_s - 0.001;
    lookout_.write(facts_);
    for (std::uint32_t f = 0; f < mission::Knowledge::kShape.facts; ++f) {   // what is perceived goes on, but for buttons: Bake, Abort, Resume
      const auto fact = static_cast<mission::Fact>(f);
      const bool pressed = std::find(now.buttons.begin(), now.buttons.end(), mission::name(fact)) != now.buttons.end();
      if (pressed || fact == mission::Fact::Bake || fact == mission::Fact::Abort || fact == mission::Fact::Resume) facts_.set(fact, pressed ? 0.9f : -0.9f);
    }
    const auto decision = mind_.tick(facts_, mts::milliseconds(100));
    pilot_.choose(mission::control_line(decision), mission::road_of_leg(mind_), mission::speed_limit_m_per_s(mind_));
  }

  mission::Mind mind_;
  mission::Facts facts_;
  mts::Pilot pilot_;
  mts::Lookout<mission::Knowledge> lookout_;
  double last_s_ = 0.0, tick_s_ = 0.0;
  bool began_ = false;
};

void answer(double t_s, const mts::Motion& wheels, Json state) {
  state["t"] = t_s;
  state["speed"] = wheels.speed_m_s;
  state["turn"] = wheels.turn_rad_s;
  std::cout << state.dump() << '\n' << std::flush;
}

}  // namespace

int main() {
  constexpr mts::Body body{.line_span_m = 0.10f, .stop_line_width_m = 0.10f, .crossing_m = 0.9f};   // the simulator's robot; measure yours
  Robot robot(body);
  if (!robot.ready()) return 1;
  for (std::string text; std::getline(std::cin, text);) {
    const Reading now = read_line(text);
    const mts::Motion wheels = robot.step(now);
    answer(now.t_s, wheels, robot.state());
  }
}
