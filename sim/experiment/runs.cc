#include "sim/experiment/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "compiler/source/numbers.h"
#include "planners/crew.h"
#include "sim/experiment/bug_helm.h"
#include "sim/experiment/programmed.h"
#include "sim/experiment/sized_helm.h"
#include "sim/experiment/streams.h"

namespace kb::sim::experiment {
namespace {

constexpr std::uint32_t kScenariosOfARoute = 8;   // two of each class

std::optional<Labyrinth> laid_out(const Sketch& sketch, const Setup& setup, const source::FileSystem& files) {
  try {
    return floor_of(sketch, setup.library, files);
  } catch (const std::runtime_error&) {
    return std::nullopt;   // slanted roads came too near to each other
  }
}

/// A route between two landmarks that are at least four roads apart, or as far apart as any pair that was drawn.
RoutePlan draw_route(const Labyrinth& labyrinth, Random& random) {
  constexpr int kTries = 60;
  constexpr std::size_t kFew = 4, kMany = 10;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.next() % n); };
  RoutePlan best;
  for (int i = 0; i < kTries; ++i) {
    const std::size_t from = below(labyrinth.crossings.size()), to = below(labyrinth.crossings.size());
    auto way = shortest_way(labyrinth, static_cast<CrossingId>(from), static_cast<CrossingId>(to));
    if (!way || way->exits.size() > kMany || way->exits.size() <= best.exits.size()) continue;
    best = std::move(*way);
    if (best.exits.size() >= kFew) break;
  }
  return best;
}

/// The road on which the robot stands at the beginning: one that the route does not take first, if there is one.
Labyrinth::End start_for(const Labyrinth& labyrinth, const RoutePlan& route) {
  const CrossingId first = route.crossings.front();
  for (const Arm& arm : labyrinth[first].arms) {
    if (&arm != route.exits.front()) return {first, &arm};
  }
  return {first, route.exits.front()};
}

std::size_t rank_of(std::string_view method) {
  const auto& methods = built_in_methods();
  return static_cast<std::size_t>(std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.name == method; }) - methods.begin());
}

/// Without it the simulator would round up the scale anew for each size, and the case would not fit.
std::string scale_option(const Labyrinth& floor, double size) { return fmt::format("--scale {}", floor.scale / floor.size * size); }

}  // namespace

const std::vector<Method>& built_in_methods() {
  static const std::vector<Method> methods{{Method::Control::kMind, "mts", {}}, {Method::Control::kProgrammed, "programmed", {}}, {Method::Control::kBug, "bug2", {}}};
  return methods;
}

bool way_before(const Row& a, const Row& b) {
  const std::size_t rank_a = rank_of(a.method), rank_b = rank_of(b.method);
  return std::tie(rank_a, a.method, a.set) < std::tie(rank_b, b.method, b.set);
}

float size_of(const std::vector<Setting>& settings) {
  float size = 1.0f;   // values were checked when they were read
  for (const Setting& setting : settings) {
    if (setting.key == "robot.size") std::from_chars(setting.value.data(), setting.value.data() + setting.value.size(), size);
  }
  return size;
}

Place place_of(const Setup& setup, std::uint32_t scenario) {
  const std::uint32_t turn = scenario / setup.labyrinths;   // how many scenarios its labyrinth had before
  return {scenario % setup.labyrinths, turn / kScenariosOfARoute, static_cast<Class>(turn % kClassNames.size())};
}

std::vector<Group> groups_of(const Setup& setup) {
  std::vector<Group> groups;
  for (std::uint32_t labyrinth = 0; labyrinth < setup.labyrinths; ++labyrinth) {
    for (std::uint32_t scenario = labyrinth; scenario < setup.scenarios; scenario += setup.labyrinths) {
      const std::uint32_t route = place_of(setup, scenario).route;
      if (scenario == labyrinth || groups.back().route != route) groups.push_back({labyrinth, route, {}});
      groups.back().scenarios.push_back(scenario);
    }
  }
  return groups;
}

Ground ground_of_number(const Setup& setup, std::uint32_t labyrinth, const source::FileSystem& files) {
  Random random(setup.seed, stream_of(Drawn::kSketch, labyrinth));
  for (;;) {
    std::optional<Sketch> sketch;
    if (in_maze(setup, labyrinth)) {
      sketch = sketch_of_maze(*setup.maze, 5 + static_cast<int>(random.next() % 2), random);
      if (!sketch) throw MazeFails();
    } else {
      GridForm form;
      form.columns = 3 + static_cast<int>(random.next() % 3);
      form.rows = 3 + static_cast<int>(random.next() % 3);
      form.roads = 0.7 + 0.25 * static_cast<double>(random.unit());
      form.slant_m = labyrinth % 4 == 1 ? 0.12 : 0.0;
      form.bends = labyrinth % 4 == 2 ? 0.0 : 0.4;
      sketch = sketch_of_grid(form, random);
    }
    if (auto floor = laid_out(*sketch, setup, files)) return {std::move(*sketch), std::move(*floor)};
  }
}

Grounds::Grounds(const Setup& setup, const source::FileSystem& files) : setup_(setup), files_(files), all_(setup.labyrinths) {}

const Ground& Grounds::of(std::uint32_t labyrinth) {
  Once& once = all_.at(labyrinth);
  std::call_once(once.flag, [&] { once.ground = ground_of_number(setup_, labyrinth, files_); });
  return *once.ground;
}

Prepared::Prepared(const Setup& setup, const Group& group, const Ground& ground, const source::FileSystem& files)
    : setup_(setup), files_(files), group_(group), ground_(ground), floor_(ground.floor) {
  Random random(setup.seed, stream_of(Drawn::kRoute, route_number(group.labyrinth, group.route)));
  route_ = draw_route(floor_, random);
  start_ = start_for(floor_, route_);
}

std::string Prepared::mission(const std::string& mind, float size) const { return mission_text(ground_.sketch, floor_, route_, mind, size); }

Town& Prepared::town_of(const std::string& mind, float size, std::uint32_t scenario) {
  const auto found = towns_.find({mind, size});
  if (found != towns_.end()) return found->second;
  try {
    return towns_.try_emplace({mind, size}, mission(mind, size), setup_.library, files_).first->second;
  } catch (const std::runtime_error& messages) {
    if (mind.empty()) throw;
    throw MindFails(mind, scenario, messages.what());
  }
}

Case Prepared::case_of(std::uint32_t scenario, float size) const {
  Random random(setup_.seed, stream_of(Drawn::kCase, scenario));
  const std::uint64_t seed = random.next() >> 12;
  const CaseGround ground{floor_, route_, start_, kPatience + kTimes * extent_of(floor_, route_).time_s, size};
  return draw_case(ground, place_of(setup_, scenario).what, seed, random);
}

std::string Prepared::scenario_text(std::uint32_t scenario, const std::vector<Setting>& settings) const {
  std::string text = case_of(scenario, size_of(settings)).scenario, set, how;
  for (const Setting& setting : settings) {
    set += setting.toml() + "\n";
    double size = 1.0;
    if (setting.key == "robot.size" && source::read_number(setting.value, size) && size != 1.0) {
      how = fmt::format("# On the floor of a robot of size 1, enlarged: kbc sim mission.kb --scenario scenario.toml {}\n", scale_option(floor_, size));
    }
    if (setting.key != "limit") continue;
    const std::size_t drawn = text.find("limit = ");
    text.erase(drawn, text.find('\n', drawn) + 1 - drawn);
  }
  return how + set + text;   // keys of the whole file stand before its first table
}

Row Prepared::drive(std::uint32_t scenario, const Method& method, std::size_t set) {
  const mts::Similarity as(size_of(setup_.set[set]));
  const Case what = case_of(scenario, as.of("m"));
  Town& town = town_of(method.mind, as.of("m"), scenario);
  const Scenario read = town.scenario(what.scenario, setup_.set[set]);
  const Labyrinth& labyrinth = town.labyrinth();
  const CrossingId goal = route_.crossings.back();
  const mts::Body robot = as_driven(read.body, read.sensors.range, read.drive);
  const mts::Similarity own(robot);
  const mts::Body body = own.in(robot);
  const double size = labyrinth.size;
  const Pose start{read.start.x_m / size, read.start.y_m / size, read.start.heading_rad};
  std::unique_ptr<Helm> helm;
  if (method.control == Method::Control::kProgrammed) helm = std::make_unique<SizedHelm>(own, std::make_unique<Programmed>(floor_, body, start, route_));
  if (method.control == Method::Control::kBug) helm = std::make_unique<SizedHelm>(own, std::make_unique<BugHelm>(body, start, floor_[goal].name, floor_[goal].at));
  DriveOptions options;
  options.helm = helm.get();
  const Summary summary = Drive(labyrinth, town.knowledge(), read, options).run();

  Row row;
  static_cast<batch::Ending&>(row) = batch::ending_of(summary);
  row.scenario = scenario;
  row.method = method.name;
  row.set = set;
  row.labyrinth = group_.labyrinth;
  row.route = group_.route;
  row.what = what.what;
  row.kinds = what.kinds;
  row.noise = what.seed;
  const Extent shortest = extent_of(floor_, shortest_way(floor_, route_.crossings.front(), goal, what.bans).value());
  row.shortest_m = (shortest.length_m + kStartBefore + start_.arm->stop_m) * size;
  row.shortest_s = (shortest.time_s + time_for(floor_[start_.arm->road], kStartBefore, start_.arm->stop_m)) * static_cast<double>(as.of("s"));
  return row;
}

void run_all(const Setup& setup, const source::FileSystem& files, const RunControl& control) {
  const std::vector<Group> groups = groups_of(setup);
  Grounds grounds(setup, files);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  const auto run_group = [&](const Group& group) {
    std::optional<Prepared> prepared;
    for (const std::uint32_t scenario : group.scenarios) {
      for (std::size_t way = 0; way < setup.methods.size() * setup.set.size(); ++way) {
        const std::size_t method = way / setup.set.size(), set = way % setup.set.size();
        if (control.skip && control.skip(scenario, method, set)) continue;
        if (stop || (control.go_on && !control.go_on())) return;
        if (!prepared) prepared.emplace(setup, group, grounds.of(group.labyrinth), files);
        const Row row = prepared->drive(scenario, setup.methods[method], set);
        const std::lock_guard lock(mutex);
        if (!stop && !control.take(row)) stop = true;
      }
    }
  };
  planners::on_threads(control.jobs, stop, [&](unsigned) {
    for (std::size_t i = next++; i < groups.size() && !stop; i = next++) run_group(groups[i]);
  });
}

}  // namespace kb::sim::experiment
