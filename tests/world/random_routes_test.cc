// 1,000 random routes on 200 random maps, in closed loop: every one arrives. Interpreter and engine in lock-step
// (KB_MIND chooses one alone).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/world/promises.h"
#include "tests/world/random_map.h"
#include "tests/world/simulation.h"

namespace kb::world {
namespace {

constexpr int kRoutesOnAMap = 5;
constexpr double kChatter = 0.08;

/// Everything that one seed stands for.
struct Country {
  Map map;
  std::vector<RandomRoute> routes;
  std::string text;
};

Country country_of(std::uint64_t seed) {
  Dice dice(seed);
  Country country{random_map(dice), {}, {}};
  country.text = "import std.navigation\n" + map_text(country.map);
  for (int i = 1; i <= kRoutesOnAMap; ++i) {
    country.routes.push_back(random_route(dice, country.map));
    country.text += route_text(country.map, country.routes.back(), i);
  }
  return country;
}

World random_world(const Country& country, const RandomRoute& route, Dice& dice) {
  static const std::vector<ArrivalSeen> kArrivals{ArrivalSeen::kAtSign, ArrivalSeen::kOnLine, ArrivalSeen::kBoth};
  static const std::vector<MemoryRead> kMemories{MemoryRead::kFromSign, MemoryRead::kOnLine};
  static const std::vector<MethodSet> kCrossings{
      {Method::kMark}, {Method::kDist}, {Method::kAzimuth}, {Method::kMark, Method::kDist}};
  World world;
  world.map = country.map;
  world.arrival_seen = dice.pick(kArrivals);
  world.memory_read = dice.pick(kMemories);
  for (Landmark& landmark : world.map.landmarks) landmark.cross_by = dice.pick(kCrossings);
  world.put(route.start, std::max(0.3, world.map.road(route.start).length_m - 1.3));
  return world;
}

Simulation::Disturbance chatter(std::uint64_t seed) {
  return [dice = Dice(seed)](Simulation&, Readings& now) mutable {
    now.each([&](float& value, bool is_landmark) {
      if (value > 0.5f && dice.chance(kChatter)) value = is_landmark ? 0.45f : kSureNot;
    });
  };
}

std::string left_over(const Knowledge& knowledge, const Mind& mind) {
  const program::Program& program = knowledge.program();
  for (std::size_t i = program.facts; i < program.first_strategy(); ++i) {
    if (mind.value(static_cast<program::CellId>(i)) != program.cells[i].initial) return std::string(program.cells[i].name);
  }
  return {};
}

/// What went wrong on one route; empty if nothing did.
std::string judge(const Simulation& sim, const RandomRoute& route, const std::string& left) {
  const World& world = sim.world;
  const std::string want = way_of(world.map, route);
  if (!world.faults.empty()) return world.faults.front().what;
  if (world.way_text() != want) return fmt::format("drove `{}`, not `{}`", world.way_text(), want);
  if (!sim.ended()) return "never ends";
  if (!world.on_road() || world.on_road()->edge != route.edges.back()) return "ended at " + world.where();
  if (!sim.strategy().empty()) return fmt::format("drives on after the end ({})", sim.strategy());
  if (sim.conflicts() > 0) return "rules contradicted each other";
  if (sim.overlaps() > 0) return "two strategies at once";
  if (!sim.broken_promise().empty()) return sim.broken_promise();
  if (!left.empty()) return "left over: " + left;
  return {};
}

struct Count { int routes = 0, maps = 0; long ticks = 0; };

/// Drives the five routes of one map, each from the state of start-up.
void drive_country(std::uint64_t seed, MindKind kind, bool with_chatter, Count& count) {
  const Country country = country_of(seed);
  std::shared_ptr<const Knowledge> knowledge;
  ASSERT_NO_THROW(knowledge = Knowledge::of_text(country.text)) << "seed " << seed << "\n" << country.text;
  const auto mind = make_mind(kind, *knowledge);
  ++count.maps;
  for (int i = 1; i <= kRoutesOnAMap; ++i) {
    const RandomRoute& route = country.routes[static_cast<std::size_t>(i - 1)];
    Dice dice(seed * 100 + static_cast<std::uint64_t>(i));
    mind->reset();
    Simulation sim(*knowledge, *mind, random_world(country, route, dice));
    sim.keep_trace = false;
    if (with_chatter) sim.disturbances.push_back(chatter(seed * 100 + static_cast<std::uint64_t>(i)));
    sim.tick();
    sim.press(fmt::format("Go{}", i));
    sim.run(200 + 130 * static_cast<int>(route.edges.size() + 1));
    for (int more = 0; more < 10; ++more) sim.tick();
    count.ticks += sim.ticks();
    ++count.routes;
    EXPECT_EQ(judge(sim, route, left_over(*knowledge, *mind)), "")
        << "seed " << seed << ", route " << i << (with_chatter ? ", with chatter\n" : "\n") << country.text;
  }
}

void drive_countries(std::uint64_t first, std::uint64_t last, bool with_chatter) {
  const MindKind kind = mind_from_environment();
  const auto began = std::chrono::steady_clock::now();
  Count count;
  for (std::uint64_t seed = first; seed < last; ++seed) drive_country(seed, kind, with_chatter, count);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  fmt::print("{} routes on {} maps, {} ticks, {:.1f} s\n", count.routes, count.maps, count.ticks, took.count());
}

TEST(RandomRoutes, AThousandRoutesOnTwoHundredMapsArrive) { drive_countries(0, 200, false); }

TEST(RandomRoutes, TheyArriveWhenAllSensorsChatter) { drive_countries(300, 350, true); }

}  // namespace
}  // namespace kb::world
