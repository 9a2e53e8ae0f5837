// Reads a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/scenario/names.h"
#include "sim/scenario/plain.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

/// Reads where the line sensors sit.
void read_row(TomlTable& line, mts::Body& body) {
  const auto set = [&](std::string_view key, TomlTable::Range range, float& value) {
    if (const auto read = line.number(key, range)) value = static_cast<float>(*read);
  };
  const double size = static_cast<double>(body.size);
  set("ahead", {0.03 * size, 0.2 * size}, body.line_ahead_m);
  set("span", around({0.04, 0.2}, size), body.line_span_m);
}

/// Warns of a sensor that controllers cannot use. Older readings than half a second count as silent, and with readings that are later than this robots swing about
/// their roads and miss stop lines: docs/simulator.md has the figures. Nothing waits for bumper and tag reader.
void check_rate(TomlTable& table, SensorId id, const SensorBuild& build, const mts::Body& body) {
  const double longer = static_cast<double>(mts::Similarity(body.size).of("s"));
  const double least_hz = 3.0 / longer, latest_s = (id == SensorId::kRange ? 0.3 : 0.1) * longer;
  const bool seldom = build.rate_hz < least_hz, late = build.latency_s > latest_s;
  if (build.rate_hz == 0.0 || id == SensorId::kBumper || id == SensorId::kTag || (!seldom && !late)) return;
  table.diagnostics().report(Kind::kSimSeldom, table.span(seldom ? "rate" : "latency"),
                             {fmt::format("{:g}", build.rate_hz), fmt::format("{:g}", build.latency_s), fmt::format("{:.2g}", least_hz), fmt::format("{:.2g}", latest_s)});
}

void read_build(TomlTable& sensors, SensorId id, Scenario& scenario) {
  SensorBuild& build = scenario.sensors[id];
  auto table = sensors.table(kSensorNames[static_cast<std::size_t>(id)]);
  if (!table) return;
  build.rate_hz = table->number("rate", {0.0, 100.0}).value_or(build.rate_hz);
  build.latency_s = table->number("latency", {0.0, 1.0}).value_or(build.latency_s);
  if (id != SensorId::kBumper) build.noise = table->number("noise", {0.0, 1.0}).value_or(build.noise);
  if (id != SensorId::kBumper && id != SensorId::kTag) build.bias = table->number("bias", {0.0, 1.0}).value_or(build.bias);
  if (id == SensorId::kLine) read_row(*table, scenario.body);
  check_rate(*table, id, build, scenario.body);
  table->done();
}

/// Rules wait for seconds of the clock, whatever the robot: who goes round a crate for longer than a minute is blocked to `std.care`.
void warn_of_weakness(TomlTable& robot, const mts::Body& body) {
  constexpr float kWellKnown = 2.5f;
  const float slow = mts::Similarity::slowness(body), times = mts::Similarity(body).of("s");
  if (slow == 1.0f || times <= kWellKnown) return;
  robot.diagnostics().report(Kind::kSimWeak, robot.span(), {fmt::format("{:.2g}", times)});
}

/// Reads lengths and limits of the robot; the world, the wheels and the controllers all take these.
void read_body(TomlTable& robot, Scenario& scenario) {
  mts::Body& body = scenario.body;
  DriveLimits& drive = scenario.drive;
  const auto set = [&](std::string_view key, TomlTable::Range range, double& value) { value = robot.number(key, range).value_or(value); };
  const mts::Similarity as(body.size);
  const double size = static_cast<double>(as.of("m")), fast = static_cast<double>(as.of("m/s"));
  double radius_m = static_cast<double>(body.radius_m);
  static_cast<void>(robot.has("size"));   // read_floor has read it
  set("radius", {0.06 * size, 0.2 * size}, radius_m);
  drive.wheel_base_m = std::min(drive.wheel_base_m, 2.0 * radius_m);   // its wheels are within its body, also where nobody says how far apart they are
  set("wheel_base", {0.05 * size, 2.0 * radius_m}, drive.wheel_base_m);
  set("speed", {0.05 * fast, 1.5 * fast}, drive.speed_m_s);
  set("acceleration", {0.1, 10.0}, drive.acceleration_m_s2);
  set("turn", {0.3 * static_cast<double>(as.of("rad/s")), 10.0}, drive.turn_rad_s);
  set("slip", {0.0, 0.3}, drive.slip);
  set("slip_mean", {0.0, 0.3}, drive.slip_mean);
  set("wheel_mismatch", {0.0, 0.1}, drive.wheel_mismatch);
  set("motor_lag", {0.0, 1.0}, drive.motor_lag_s);
  robot.done();
  body.radius_m = static_cast<float>(radius_m);
  body.wheel_base_m = static_cast<float>(drive.wheel_base_m);
  body.top_speed_m_s = static_cast<float>(drive.speed_m_s);
  body.top_acceleration_m_s2 = static_cast<float>(drive.acceleration_m_s2);
  body.top_turn_rad_s = static_cast<float>(drive.turn_rad_s);
  warn_of_weakness(robot, body);
}

// note [a row and its lines]
// If four of the five line sensors are on paint, that is taken for a stop line. A row no broader than four lines has a sensor on a line
// that lies anywhere under it; in a broader one the line could lie between two sensors. A row less than two lines broad has four sensors on
// a line that it meets at 45 degrees, and would take that for a stop line.
void check_row(TomlTable& file, const mts::Body& body) {
  constexpr float kLeastLines = 2.0f, kMostLines = 4.0f, kRounding = 1e-6f;
  const float line_m = body.paint_width_m, least_m = kLeastLines * line_m, most_m = kMostLines * line_m;
  const bool narrow = body.line_span_m < least_m - kRounding, broad = body.line_span_m > most_m + kRounding;
  if (!narrow && !broad) return;
  auto sensors = file.table("sensors"), line = sensors ? sensors->table("line") : std::nullopt, floor = file.table("floor");
  const source::Span at = line && line->has("span") ? line->span("span") : floor ? floor->span("line_width") : file.span();
  file.diagnostics().report(Kind::kSimRow, at, {fmt::format("{:g}", body.line_span_m), fmt::format("{:g}", line_m),
                            broad ? "the line could lie between two of them" : "a line that they meet askew would be a stop line to them",
                            fmt::format("{:g}", least_m), fmt::format("{:g}", most_m)});
}

/// Returns the keys of `[robot]`, which may be forgotten to be its own.
std::vector<std::string> read_build(TomlTable& file, const Labyrinth& labyrinth, Scenario& scenario) {
  scenario.body = robot_of(static_cast<float>(labyrinth.size));
  scenario.drive = limits_of(scenario.body);
  scenario.body.paint_width_m = static_cast<float>(labyrinth.widths.line_m);
  scenario.body.stop_line_width_m = static_cast<float>(labyrinth.widths.stop_line_m);
  static_cast<void>(file.has("floor"));   // read_floor has read it
  const std::size_t before = file.diagnostics().errors();
  if (auto sensors = file.table("sensors")) {
    for (std::size_t i = 0; i < kSensorNames.size(); ++i) {
      read_build(*sensors, static_cast<SensorId>(i), scenario);
    }
    sensors->done();
  }
  if (file.diagnostics().errors() == before) check_row(file, scenario.body);
  TomlTable robot = file.table_or_none("robot");
  read_body(robot, scenario);
  return robot.asked();
}

void read_crossings(TomlTable& file, const Names& names, Scenario& scenario) {
  std::map<CrossingId, source::Span> described;
  for (TomlTable& table : file.tables("crossing")) {
    const auto crossing = names.crossing(table, "landmark");
    auto methods = table.texts("methods");
    if (!table.has("landmark")) table.missing("landmark");
    if (!table.has("methods")) table.missing("methods");
    const std::vector<std::string_view>& known = names.knowledge.methods;
    for (const std::string& method : methods) {
      if (std::find(known.begin(), known.end(), method) == known.end()) table.unknown_name("methods", "method", method, known);
    }
    table.done();
    if (!crossing) continue;
    const auto [first, fresh] = described.try_emplace(*crossing, table.span("landmark"));
    if (!fresh) {
      file.diagnostics().report(diagnostics::Kind::kSimTwice, table.span("landmark"), {"crossing", names.labyrinth[*crossing].name})
          .note(diagnostics::Kind::kSimFirstDescribed, first->second);
    }
    scenario.crossings.push_back({*crossing, std::move(methods)});
  }
}

/// The landmark to which a robot in this pose drives on the nearest road; kNone if there are no roads. `away_m`: how far away that road is.
CrossingId heads_for(const Labyrinth& labyrinth, const Pose& pose, double& away_m) {
  const Spot spot{pose.x_m, pose.y_m};
  away_m = 1e9;
  CrossingId answer = CrossingId::kNone;
  for (const Road& road : labyrinth.roads) {
    const Along near = nearest_along(road.along, spot);
    if (near.distance_m >= away_m) continue;
    away_m = near.distance_m;
    const double turned = wrap(pose.heading_rad - point_on(road.along, near.along_m).heading_rad);
    answer = std::abs(turned) < kPi / 2.0 ? road.to : road.from;
  }
  return answer;
}

/// The route that a command starts; null if there is none.
const model::Row* route_by(const model::Model& model, std::string_view command_name) {
  for (const model::RowId id : model.rows_of("Route")) {
    const model::Row* command = model.row_in(model[id], "command");
    if (command != nullptr && command->name == command_name) return &model[id];
  }
  return nullptr;
}

/// The route whose command is pressed first, by time; null if commands are only pressed when something else happens.
const model::Row* asked_first(const Scenario& scenario, const Names& names, const model::Model& model) {
  const model::Row* first = nullptr;
  double at_s = 0.0;
  for (const Event& event : scenario.events) {
    if (event.action.kind != Action::Kind::kPress || event.when.kind != Trigger::Kind::kTime) continue;
    const double when_s = event.when.time_s + event.when.delay_s;
    if (first != nullptr && when_s >= at_s) continue;
    const model::Row* route = route_by(model, names.knowledge.program->cells[program::index(event.action.cell)].name);
    if (route != nullptr) first = route, at_s = when_s;
  }
  return first;
}

/// Where the robot starts if the file does not say so: on the way to the beginning of the route that is asked for first.
std::optional<Pose> usual_start(const Scenario& scenario, const Names& names, const model::Model& model, Diagnostics& diagnostics) {
  const model::Row* asked = asked_first(scenario, names, model);
  const bool begins = asked != nullptr && begin_of(model, *asked) != nullptr;
  return start_before(begins ? *asked : *first_route(model), names.labyrinth, model, diagnostics);
}

/// Whether the start has room for the robot, and lies on a road to the beginning of the route that is asked for first.
bool check_start(const Scenario& scenario, const Names& names, const model::Model& model, source::Span at, Diagnostics& diagnostics) {
  double away_m = 0.0;
  const CrossingId next = heads_for(names.labyrinth, scenario.start, away_m);
  if (away_m > names.labyrinth.size * kRoadWidth) {
    diagnostics.report(Kind::kSimOffRoad, at, {fmt::format("{:.2f}", scenario.start.x_m / names.labyrinth.scale),
                                               fmt::format("{:.2f}", scenario.start.y_m / names.labyrinth.scale), fmt::format("{:.2f}", away_m)});
    return false;
  }
  if (!names.check_room(scenario.start, at, diagnostics)) return false;
  const model::Row* route = asked_first(scenario, names, model);
  const model::Row* begin = route != nullptr ? begin_of(model, *route) : nullptr;
  if (begin == nullptr || names.labyrinth[next].name == begin->name) return true;
  diagnostics.report(Kind::kSimWrongRoad, at, {names.labyrinth[next].name, route->name, begin->name});
  return false;
}

/// The earliest moment at which such an action can happen: an event that waits for something else than the clock may happen at once.
double earliest_s(const Scenario& scenario, Action::Kind kind) {
  double earliest = 1e9;
  for (const Event& event : scenario.events) {
    if (event.action.kind != kind) continue;
    earliest = std::min(earliest, event.when.kind == Trigger::Kind::kTime ? event.when.time_s + event.when.delay_s : 0.0);
  }
  return earliest;
}

/// How the robot may leave the place where it is thought to be.
struct Leaving {
  explicit Leaving(const Scenario& scenario) : pressed_s(earliest_s(scenario, Action::Kind::kPress)), carried_s(earliest_s(scenario, Action::Kind::kKidnap)) {
    for (const Event& event : scenario.events) {
      if (event.action.kind == Action::Kind::kKidnap && event.when.kind == Trigger::Kind::kPlace) carried_on.insert(event.when.road);
    }
  }
  double pressed_s, carried_s;   // the earliest moment
  std::set<RoadId> carried_on;   // when it comes to a place on such a road
};

/// Where the robot is when an event happens, if that is certain: at its start before anything is pressed or the robot is carried off, or at
/// the place that the event waits for, unless it may be carried off there.
std::optional<Spot> robot_at(const Event& event, const Leaving& leaves, const Scenario& scenario, const Labyrinth& labyrinth) {
  const Trigger& when = event.when;
  if (when.kind == Trigger::Kind::kTime) {
    const double at_s = when.time_s + when.delay_s;
    const bool stands = at_s <= leaves.pressed_s && at_s < leaves.carried_s;
    return stands ? std::optional(Spot{scenario.start.x_m, scenario.start.y_m}) : std::nullopt;
  }
  if (when.kind != Trigger::Kind::kPlace || when.delay_s > 0.0) return std::nullopt;
  if (leaves.carried_on.contains(when.road)) return std::nullopt;
  const Road& road = labyrinth[when.road];
  return point_on(road.along, road.begins_m + when.along_m).at;
}

bool check_obstacles(const Scenario& scenario, const Labyrinth& labyrinth, Diagnostics& diagnostics) {
  const Leaving leaves(scenario);
  bool good = true;
  for (const Event& event : scenario.events) {
    if (event.action.kind != Action::Kind::kObstacle) continue;
    const auto robot = robot_at(event, leaves, scenario, labyrinth);
    const double gap_m = robot ? distance(*robot, event.action.obstacle.at) - event.action.obstacle.radius_m - static_cast<double>(scenario.body.radius_m) : 0.0;
    if (gap_m >= 0.0) continue;
    diagnostics.report(Kind::kSimOnRobot, event.at, {event.action.obstacle.name, fmt::format("{:.2f}", -gap_m)});
    good = false;
  }
  return good;
}

}  // namespace

std::optional<Scenario> read_robot(source::FileId file, Settings settings, const Labyrinth& labyrinth, const Knowledge& knowledge, Diagnostics& diagnostics) {
  const TomlPlaces places(file, diagnostics.sources());
  const auto parsed = parse_scenario(file, settings, places, diagnostics);
  if (!parsed) return std::nullopt;
  const std::size_t before = diagnostics.errors();
  Scenario robot;
  TomlTable table(*parsed, "a robot", places, diagnostics);
  static_cast<void>(read_build(table, labyrinth, robot));
  read_crossings(table, Names{labyrinth, knowledge, static_cast<double>(robot.body.radius_m)}, robot);
  for (const char* of_a_drive : {"title", "seed", "limit", "open_end", "start", "event", "hall"}) static_cast<void>(table.has(of_a_drive));
  table.done();
  if (diagnostics.errors() != before) return std::nullopt;
  return robot;
}

std::optional<Scenario> read_scenario(source::FileId file, Settings settings, const Labyrinth& labyrinth, const Knowledge& knowledge,
                                      const model::Model& model, Diagnostics& diagnostics, MissionsBy by) {
  const TomlPlaces places(file, diagnostics.sources());
  const auto parsed = parse_scenario(file, settings, places, diagnostics);
  if (!parsed) return std::nullopt;
  const std::size_t before = diagnostics.errors();
  auto scenario = unplaced_scenario(knowledge, model, diagnostics, by);
  if (!scenario) return std::nullopt;
  TomlTable table(*parsed, "a scenario", places, diagnostics);
  scenario->title = table.text("title").value_or("");
  scenario->seed = table.whole("seed", 9e15).value_or(1);
  scenario->limit_s = table.number("limit", {0.1, 86'400.0}).value_or(scenario->limit_s);
  if (table.flag("open_end")) {
    scenario->open_end = true;
    scenario->events.clear();
  }
  const std::vector<std::string> robot_keys = read_build(table, labyrinth, *scenario);
  const Names names{labyrinth, knowledge, static_cast<double>(scenario->body.radius_m)};
  source::Span start_at{file, 0, 0};
  auto start = table.table("start");
  if (start) {
    if (const auto place = names.place(*start)) scenario->start = *place;
    start->done();
    start_at = start->span();
  }
  read_crossings(table, names, *scenario);
  static_cast<void>(table.has("hall"));   // read_floor has read them
  auto events = read_events(table, names, scenario->limit_s);
  const bool commands = std::any_of(events.begin(), events.end(), [&](const Event& event) {
    return event.action.kind == Action::Kind::kPress && knowledge.program->cells[program::index(event.action.cell)].command;
  });
  if (commands) scenario->events.clear();   // without any, the command of the first route is pressed as in a plain drive
  std::move(events.begin(), events.end(), std::back_inserter(scenario->events));
  table.done("robot", robot_keys);
  if (diagnostics.errors() != before) return std::nullopt;
  if (!start && first_route(model) == nullptr) {
    diagnostics.report(Kind::kSimMissing, start_at, {"a drive without a route", "[start]"});
    return std::nullopt;
  }
  if (!start) {
    const auto usual = usual_start(*scenario, names, model, diagnostics);
    if (!usual) return std::nullopt;
    scenario->start = *usual;
  }
  if (!check_start(*scenario, names, model, start_at, diagnostics)) return std::nullopt;
  if (!check_obstacles(*scenario, labyrinth, diagnostics)) return std::nullopt;
  return scenario;
}

}  // namespace kb::sim
