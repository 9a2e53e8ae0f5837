#include "tests/unit/sim_report/small_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/unit/sim_report/small_mind.h"

namespace kb::sim::testing {
namespace {

using RoadKind = Picture::Kind;
using Op = MindNames::Condition::Op;

constexpr double kWidth = 0.3, kLine = 0.025, kSpeed = 0.4, kNearMark = 0.2, kNearLine = 0.15, kPi = 3.14159265358979323846;

struct Mark { const char* name; double x, y; };
constexpr Mark kMarks[] = {{"LM1", 1, 1},   {"LM2", 0, 0},   {"LM5", 1, 0},   {"LM4", 2, 0},    {"LM3", 0, -1},  {"LM6", 1, -1},  {"LM8", 2, -1}, {"LM12", 3, -1},
                           {"LM9", 0, -2},  {"LM7", 1, -2},  {"LM14", 3, -2}, {"LM10", 0, -3},  {"LM11", 1, -3}, {"LM13", 2, -3}, {"LM15", 3, -3}};
Spot mark(const std::string& name) {
  for (const Mark& one : kMarks) {
    if (one.name == name) return {one.x, one.y};
  }
  return {};
}

struct Way { const char *name, *from, *to; RoadKind kind; std::vector<Spot> through; };
const std::vector<Way>& ways() {
  static const std::vector<Way> kWays = {
      {"LM1.S", "LM1", "LM5", RoadKind::kMark, {}},    {"LM5.W", "LM5", "LM2", RoadKind::kMark, {}},          {"LM5.E", "LM5", "LM4", RoadKind::kMark, {}},   {"LM2.S", "LM2", "LM3", RoadKind::kMark, {}},
      {"LM3.E", "LM3", "LM6", RoadKind::kMark, {}},    {"LM3.S", "LM3", "LM9", RoadKind::kDist, {}},          {"LM4.S", "LM4", "LM8", RoadKind::kDist, {}},   {"LM4.E", "LM4", "LM12", RoadKind::kAzimuth, {{3, 0}}},
      {"LM6.E", "LM6", "LM8", RoadKind::kMark, {}},    {"LM6.S", "LM6", "LM7", RoadKind::kMark, {}},          {"LM8.E", "LM8", "LM12", RoadKind::kDist, {}},  {"LM9.E", "LM9", "LM7", RoadKind::kMark, {}},
      {"LM9.S", "LM9", "LM10", RoadKind::kAzimuth, {}}, {"LM7.E", "LM7", "LM13", RoadKind::kMark, {{2, -2}}}, {"LM7.S", "LM7", "LM11", RoadKind::kDist, {}},  {"LM10.E", "LM10", "LM11", RoadKind::kDist, {}},
      {"LM11.E", "LM11", "LM13", RoadKind::kDist, {}}, {"LM12.S", "LM12", "LM14", RoadKind::kMark, {}},       {"LM14.S", "LM14", "LM15", RoadKind::kMark, {}}, {"LM13.E", "LM13", "LM15", RoadKind::kAzimuth, {}}};
  return kWays;
}

// A stretch of a road: its paint or its walls, and the stop lines at its ends.
void lay_stretch(Picture& picture, RoadKind kind, Spot a, Spot b, bool stop_a, bool stop_b) {
  const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), ux = (b.x_m - a.x_m) / length, uy = (b.y_m - a.y_m) / length;
  const auto at = [&](double along, double aside) { return Spot{a.x_m + ux * along - uy * aside, a.y_m + uy * along + ux * aside}; };
  const double begin = stop_a ? kNearLine : 0.0, end = length - (stop_b ? kNearLine : 0.0), half = kWidth / 2;
  if (kind == RoadKind::kMark) picture.lines.push_back({at(begin, 0), at(end, 0), kLine});
  if (kind == RoadKind::kDist) {
    for (const double side : {-half, half}) picture.walls.push_back({at(begin, side), at(end, side)});
  }
  if (stop_a) picture.stop_lines.push_back({at(begin, -half * 0.7), at(begin, half * 0.7), kLine});
  if (stop_b) picture.stop_lines.push_back({at(end, -half * 0.7), at(end, half * 0.7), kLine});
}

Picture lay_floor() {
  Picture picture;
  picture.low = {-0.3, -3.3};
  picture.high = {3.3, 1.3};
  picture.robot_radius_m = 0.09;
  for (const Mark& one : kMarks) picture.landmarks.push_back({one.name, {one.x, one.y}});
  for (const Way& way : ways()) {
    std::vector<Spot> along = {mark(way.from)};
    along.insert(along.end(), way.through.begin(), way.through.end());
    along.push_back(mark(way.to));
    for (std::size_t i = 1; i < along.size(); ++i) lay_stretch(picture, way.kind, along[i - 1], along[i], i == 1, i + 1 == along.size());
    picture.roads.push_back({way.name, way.from, way.to, way.kind, kWidth, along});
  }
  return picture;
}

struct Step { const char *from, *to, *road, *move, *turn; bool detour; };
constexpr Step kSteps[] = {{"LM1", "LM5", "LM1.S", "Move.mark", "right", false},  {"LM5", "LM2", "LM5.W", "Move.mark", "left", false},    {"LM2", "LM3", "LM2.S", "Move.mark", "left", false},
                           {"LM3", "LM6", "LM3.E", "Move.mark", "right", false},  {"LM6", "LM7", "LM6.S", "Move.mark", "forward", false}, {"LM7", "LM11", "LM7.S", "Move.dist", "left", true},
                           {"LM11", "LM13", "LM11.E", "Move.dist", "forward", true}, {"LM13", "LM15", "LM13.E", "Move.azimuth", "", false}};

std::string leg_name(const Step& step) { return std::string("Route1[") + step.from + "," + step.to + "]"; }

void add_cells(MindBuilder& mind) {
  mind.names.cells[mind.fact("Start1")].command = true;
  for (const Mark& one : kMarks) mind.fact(one.name);
  for (const char* name : {"Line", "Safe", "Obst", "Track.mark", "Track.dist", "Track.azimuth"}) mind.fact(name);
  mind.satellite("sat Start1", 1.0f);
  for (const Mark& one : kMarks) mind.satellite(std::string("sat ") + one.name);
  mind.satellite("Arrived");
  std::vector<std::uint32_t> legs, moves, turns;
  for (const Step& step : kSteps) legs.push_back(mind.satellite(leg_name(step)));
  for (const char* turn : {"left", "right", "forward"}) turns.push_back(mind.satellite(std::string("Turn.") + turn));
  for (const char* name : {"sat Move.mark", "sat Move.dist", "sat Move.azimuth"}) moves.push_back(mind.satellite(name));
  for (const char* turn : {"left", "right", "forward"}) moves.push_back(mind.satellite(std::string("sat Cross[") + turn + ",mark]"));
  const std::uint32_t avoid = mind.satellite("sat Avoid");
  mind.names.exclusive = {legs, turns, moves};
  constexpr const char* kControls[] = {"follow_line(speed: 0.4 m/s)", "keep_wall(distance: 0.15 m, speed: 0.3 m/s)", "hold_heading(speed: 0.3 m/s)"};
  for (std::size_t i = 0; i < moves.size(); ++i) mind.strategy(mind.names.cells[moves[i]].name.substr(4), moves[i], i < 3 ? kControls[i] : "turn_on_line(turn: ...)");
  mind.strategy("Avoid", avoid, "keep_wall(side: right, distance: 0.2 m)");
}

void add_rules(MindBuilder& mind) {
  const auto sat = [&](const std::string& name) { return mind.cell("sat " + name); };
  mind.names.levels = {"mission", "route", "passage", "road", "control"};
  mind.rule("begin[Start1]", "mission", mind.all({mind.about(Op::kEvent, "Start1"), mind.is("sat Start1")}),
            {{sat("Start1"), -1.0f}, {mind.cell(leg_name(kSteps[0])), 1.0f}, {sat("LM5"), 1.0f}, {sat("Move.mark"), 1.0f}});
  for (std::size_t i = 0; i < std::size(kSteps); ++i) {
    const Step& step = kSteps[i];
    std::vector<MindNames::Write> writes = {{sat(step.to), -1.0f}, {mind.cell("Arrived"), 1.0f}};
    const bool last = i + 1 == std::size(kSteps);
    if (!last) writes.insert(writes.end(), {{mind.cell(leg_name(kSteps[i + 1])), 1.0f}, {sat(kSteps[i + 1].to), 1.0f}, {mind.cell(std::string("Turn.") + step.turn), 1.0f}});
    auto& rule = mind.rule("arrive[" + leg_name(step) + "]", "route", mind.all({mind.about(Op::kSeen, step.to), mind.is(std::string("sat ") + step.to), mind.is(leg_name(step))}), writes);
    rule.clears = last ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{0, 1};
  }
  for (const char* turn : {"left", "right", "forward"}) {
    const std::string name = std::string("Cross[") + turn + ",mark]";
    mind.rule(std::string("enter[") + turn + ",mark]", "passage",
              mind.all({mind.about(Op::kSeen, "Line"), mind.lasting(mind.is("Arrived"), 0.1), mind.is(std::string("Turn.") + turn)}), {{sat(name), 1.0f}, {mind.cell("Arrived"), -1.0f}})
        .clears = {2};
  }
  for (const Step& step : kSteps) {
    const auto crossing = mind.any({mind.is("Cross[left,mark]"), mind.is("Cross[right,mark]"), mind.is("Cross[forward,mark]")});
    mind.rule("leave[" + leg_name(step) + "]", "passage", mind.all({mind.about(Op::kLost, "Line"), crossing, mind.is(leg_name(step))}), {{sat(step.move), 1.0f}}).clears = {1, 2};
  }
  mind.rule("go_round", "road", mind.all({mind.about(Op::kSeen, "Obst"), mind.no(mind.is("sat Avoid"))}), {{sat("Avoid"), 1.0f}});
  mind.rule("passed", "road", mind.all({mind.lasting(mind.no(mind.about(Op::kSeen, "Obst")), 0.5), mind.is("sat Avoid")}), {{sat("Avoid"), -1.0f}});
  for (const auto& cell : std::vector<MindNames::Cell>(mind.names.cells)) {
    if (cell.kind != MindNames::Cell::Kind::kStrategy) continue;
    std::vector<std::uint32_t> parts = {mind.is("sat " + cell.name)};
    if (cell.name != "Avoid") parts.push_back(mind.no(mind.is("sat Avoid")));
    auto& rule = mind.rule("run[" + cell.name + "]", "control", mind.all(parts), {{mind.cell(cell.name), 1.0f}});
    rule.each_tick = true;
    rule.at = "priority";
  }
}

// Where the robot is after `s` metres of the path; round the obstacle on LM3-LM6 it swerves.
Pose on_path(double s) {
  for (const Step& step : kSteps) {
    const Spot a = mark(step.from), b = mark(step.to);
    const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (s > length && &step != &kSteps[std::size(kSteps) - 1]) {
      s -= length;
      continue;
    }
    s = std::min(s, length);
    Pose pose{a.x_m + (b.x_m - a.x_m) * s / length, a.y_m + (b.y_m - a.y_m) * s / length, std::atan2(b.y_m - a.y_m, b.x_m - a.x_m)};
    if (std::string(step.road) == "LM3.E" && s > 0.3 && s < 0.8) {
      pose.y_m += 0.12 * std::sin((s - 0.3) / 0.5 * kPi);
      pose.heading_rad += std::atan(0.12 * kPi / 0.5 * std::cos((s - 0.3) / 0.5 * kPi));
    }
    return pose;
  }
  return {};
}
double path_length() {
  double sum = 0.0;
  for (const Step& step : kSteps) sum += std::hypot(mark(step.to).x_m - mark(step.from).x_m, mark(step.to).y_m - mark(step.from).y_m);
  return sum;
}

/// Even in [-1, 1], the same from every library.
double noise(std::mt19937& random) { return static_cast<double>(random()) / 2147483648.0 - 1.0; }

mts::Senses sense(const Pose& pose, double s, std::mt19937& random) {
  mts::Senses senses;
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = true;
  for (std::size_t i = 0; i < mts::kLineSensors; ++i) senses.line[i] = static_cast<float>((i == 2 ? 0.9 : 0.1) + 0.08 * noise(random));
  for (std::size_t i = 0; i < mts::kRangeFinders; ++i) senses.range_m[i] = i % 4 == 2 ? static_cast<float>(0.15 + 0.01 * noise(random)) : i % 2 == 1 ? 0.6f : mts::kOutOfRange;
  senses.heading_rad = static_cast<float>(pose.heading_rad + 0.02 * noise(random));
  senses.x_m = static_cast<float>(pose.x_m + 0.006 * s - 7.0);   // in a frame of the wheels' own
  senses.y_m = static_cast<float>(pose.y_m - 0.004 * s + 3.0);
  senses.speed_m_s = static_cast<float>(kSpeed + 0.01 * noise(random));
  return senses;
}

std::vector<float> facts_at(const MindBuilder& mind, const Pose& pose, double t_s, std::mt19937& random) {
  std::vector<float> facts;
  for (const auto& cell : mind.names.cells) {
    if (cell.kind != MindNames::Cell::Kind::kFact) break;
    facts.push_back(-1.0f);
  }
  const auto give = [&](const std::string& name, double value) { facts[mind.cell(name)] = static_cast<float>(std::round(value * 1000.0) / 1000.0); };
  if (t_s > 0.85 && t_s < 1.15) give("Start1", 0.8);
  give("Safe", 0.7 + 0.05 * noise(random));
  for (const Mark& one : kMarks) {
    const double far = std::hypot(pose.x_m - one.x, pose.y_m - one.y);
    if (far < kNearMark) give(one.name, 0.85 + 0.05 * noise(random));
    if (far < kNearLine) give("Line", 0.92);
    if (far < kNearMark && std::string(one.name) == "LM7") give("Safe", -0.8);
  }
  const double obstacle = std::hypot(pose.x_m - 0.55, pose.y_m + 1.0);
  if (obstacle < 0.35) give("Obst", 1.0 - obstacle);
  for (const char* name : {"Track.mark", "Track.dist", "Track.azimuth"}) give(name, 0.9 + 0.1 * noise(random));
  return facts;
}

void set_scene(Recording& recording, double period_s) {
  const auto frame = [&](double t_s) { return std::min(static_cast<std::uint32_t>(t_s / period_s), static_cast<std::uint32_t>(recording.frames.size() - 1)); };
  const auto stay = [&](Thing thing, double from_s, double to_s, const std::string& note) {
    recording.stays.push_back({std::move(thing), frame(from_s), to_s < 0 ? static_cast<std::uint32_t>(recording.frames.size()) : frame(to_s)});
    recording.frames[frame(from_s)].notes.push_back(note);
  };
  stay({Thing::Kind::kObstacle, "box", {0.48, -1.06}, {0.62, -0.94}}, 6.0, -1, "obstacle `box` appears on LM3.E");
  stay({Thing::Kind::kLostMarking, "LM6.S", {1, -1.35}, {1, -1.65}}, 10.0, 16.0, "marking of LM6.S lost between 0.35 m and 0.65 m");
  stay({Thing::Kind::kClosedRoad, "LM7.E", {1.2, -2}, {1.8, -2}}, 12.0, -1, "road LM7.E closed");
  stay({Thing::Kind::kUnsafeCrossing, "LM7", {1, -2}, {1, -2}}, 12.0, -1, "crossing LM7 unsafe");
}

}  // namespace

Recording small_drive(std::uint32_t seed, int laps, double period_s) {
  MindBuilder mind;
  add_cells(mind);
  add_rules(mind);
  Recording recording;
  recording.title = "route1.kb, closed_road.toml";
  recording.outcome = "arrived";
  recording.picture = lay_floor();
  recording.names = mind.names;
  for (const Step& step : kSteps) {
    const auto road = std::find_if(ways().begin(), ways().end(), [&](const Way& way) { return std::string(way.name) == step.road; });
    recording.legs.push_back({leg_name(step), step.from, step.to, static_cast<std::int32_t>(road - ways().begin()), step.detour});
  }
  SmallMind engine(mind.names);
  std::mt19937 random(seed);
  const double lap_s = path_length() / kSpeed + 3.0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(lap_s * laps / period_s); ++i) {
    Frame frame;
    frame.t_s = i * period_s;
    const double t = std::fmod(frame.t_s, lap_s), s = std::max(0.0, t - 1.2) * kSpeed;
    frame.pose = on_path(s);
    frame.senses = sense(frame.pose, s, random);
    engine.tick(facts_at(mind, frame.pose, t, random), frame);
    for (const Step& step : kSteps) {
      if (engine.value(mind.cell(leg_name(step))) > 0.5f) frame.leg = leg_name(step);
    }
    recording.frames.push_back(std::move(frame));
  }
  set_scene(recording, period_s);
  return recording;
}

Recording nasty_drive() {
  Recording recording = small_drive();
  const std::string nasty = "</script><script>document.title='broken'</script><!-- \" ' & \\ ]]> {{data}} \xE2\x80\xA8 \xFF\xC0 \n, end";
  recording.title = nasty;
  recording.outcome = "stopped: " + nasty;
  recording.picture.landmarks[0].name = recording.picture.roads[0].name = nasty;
  recording.names.cells[0].name = recording.names.rules[0].name = recording.names.rules[0].at = nasty;
  recording.names.levels[0] = recording.names.rules[0].level = nasty;
  for (auto& cell : recording.names.cells) cell.control = nasty;
  recording.frames[5].notes.push_back(nasty);
  recording.frames[6].leg = recording.frames[6].status = nasty;
  return recording;
}

Recording one_frame() {
  Recording recording;
  recording.title = "one frame";
  recording.frames.push_back({});
  return recording;
}

Recording not_finite() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  Recording recording = small_drive();
  for (std::size_t i = 10; i < recording.frames.size(); i += 3) {
    Frame& frame = recording.frames[i];
    frame.pose = {i % 2 ? kNan : kInf, -kInf, kNan};
    frame.senses.line[1] = frame.senses.range_m[3] = frame.senses.x_m = static_cast<float>(kNan);
    frame.senses.range_m[0] = static_cast<float>(kInf);
    frame.changed.push_back({1, static_cast<float>(kNan)});
  }
  recording.frames.back().t_s = kNan;
  recording.picture.roads[0].along[0].x_m = recording.picture.roads[1].width_m = kNan;
  recording.picture.landmarks[0].at.x_m = kInf;
  recording.picture.walls[0].to.y_m = kNan;
  recording.stays[0].thing.from.x_m = kNan;
  recording.names.cells[0].initial = static_cast<float>(kNan);
  return recording;
}

}  // namespace kb::sim::testing
