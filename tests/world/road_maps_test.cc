// The maps that large knowledge bases are measured on, at a size at which they can be driven; and that what they cost grows
// no faster than they do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/maps/road_map.h"
#include "compiler/tables/image.h"
#include "tests/world/simulation.h"

namespace kb::world {
namespace {

using bench::RoadMap;
using bench::Tour;

constexpr RoadMap (*kMakers[])(std::uint32_t, std::uint64_t) = {bench::make_city, bench::make_warehouse};
constexpr double kRoad_m = 2.4;

std::shared_ptr<const Knowledge> knowledge_of(const RoadMap& map, const Tour& tour) {
  return Knowledge::of_text(kb_text(map, tour));
}

/// `J4.N J7.E`: the roads of the tour, as World::way_text says them.
std::string way_of(const RoadMap& map, const Tour& tour) {
  std::string way;
  std::uint32_t at = tour.start;
  for (const bench::Side exit : tour.exits) {
    way += fmt::format("{}{}.{}", way.empty() ? "" : " ", map.landmark_name(at), "NESW"[static_cast<std::size_t>(exit)]);
    at = map.across({at, exit}).landmark;
  }
  return way;
}

/// A side of the tour's first landmark by which a robot may come to it.
bench::End way_in(const RoadMap& map, const Tour& tour) {
  for (unsigned side = 0;; ++side) {
    if (map.landmarks[tour.start].road[side] != bench::kNoRoad) return map.across({tour.start, static_cast<bench::Side>(side)});
  }
}

TEST(RoadMaps, HaveTheRoadsThatWereAskedForAndAreConnected) {
  for (const auto make : kMakers) {
    for (const std::uint32_t roads : {24u, 25u, 60u, 333u, 2'000u}) {
      const RoadMap map = make(roads, roads);
      ASSERT_EQ(map.roads.size(), roads) << map.name;
      std::vector<bool> reached(map.landmarks.size(), false);
      std::vector<std::uint32_t> todo{0};
      reached[0] = true;
      for (std::size_t i = 0; i < todo.size(); ++i) {
        for (unsigned side = 0; side < 4; ++side) {
          if (map.landmarks[todo[i]].road[side] == bench::kNoRoad) continue;
          const std::uint32_t next = map.across({todo[i], static_cast<bench::Side>(side)}).landmark;
          if (!reached[next]) todo.push_back(next);
          reached[next] = true;
        }
      }
      EXPECT_EQ(todo.size(), map.landmarks.size()) << map.name << " of " << roads;
    }
  }
}

TEST(RoadMaps, AreTheSameForTheSameSeedOnly) {
  for (const auto make : kMakers) {
    const auto text = [&](std::uint64_t seed) {
      const RoadMap map = make(80, seed);
      return kb_text(map, make_tour(map, 10, seed));
    };
    EXPECT_EQ(text(5), text(5));
    EXPECT_NE(text(5), text(6));
  }
}

/// A city has what makes driving hard: dead ends, bends without a landmark, and crossings of all kinds.
TEST(RoadMaps, ACityIsIrregular) {
  const RoadMap city = bench::make_city(1'000, 3);
  std::array<int, 5> by_roads{};
  for (const bench::Landmark& landmark : city.landmarks) {
    ++by_roads[4 - static_cast<std::size_t>(std::count(landmark.road.begin(), landmark.road.end(), bench::kNoRoad))];
  }
  EXPECT_EQ(by_roads[0], 0);
  for (const int roads : {1, 2, 3, 4}) EXPECT_GT(by_roads[static_cast<std::size_t>(roads)], 20) << roads;
  EXPECT_GT(std::count_if(city.roads.begin(), city.roads.end(), [](const bench::Road& road) { return road.bend.has_value(); }), 20);
}

TEST(RoadMaps, ToursAreDrivenInClosedLoop) {
  for (const auto make : kMakers) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const RoadMap map = make(60, seed);
      const Tour tour = make_tour(map, 12, seed);
      const auto knowledge = knowledge_of(map, tour);
      const auto mind = make_mind(mind_from_environment(), *knowledge);
      World world;
      world.map = map_of(knowledge->model(), kRoad_m);
      const bench::End from = way_in(map, tour);
      world.put(world.map.edge(fmt::format("{}.{}", map.landmark_name(from.landmark), "NESW"[static_cast<std::size_t>(from.side)])), 1.2);
      Simulation sim(*knowledge, *mind, std::move(world));
      sim.keep_trace = false;
      sim.tick();
      sim.press("Go");
      ASSERT_TRUE(sim.run(4'000)) << map.name << ", seed " << seed;
      EXPECT_EQ(sim.world.way_text(), way_of(map, tour)) << map.name << ", seed " << seed;
      EXPECT_TRUE(sim.world.faults.empty()) << sim.world.faults.front().what;
      EXPECT_EQ(sim.conflicts(), 0);
      EXPECT_EQ(sim.broken_promise(), "");
    }
  }
}

/// What a map adds, twice as large a map adds twice; the tour, which is the same, is taken off.
TEST(RoadMaps, CostGrowsWithTheMap) {
  for (const auto make : kMakers) {
    const auto cost = [&](std::uint32_t roads) {
      const RoadMap map = make(roads, 1);
      const auto knowledge = knowledge_of(map, make_tour(map, 4, 1));
      const tables::Budget budget = tables::budget(knowledge->tables(), knowledge->program());
      const std::size_t image = tables::write_image(knowledge->tables(), knowledge->program()).size();
      return std::array<double, 5>{double(budget.table_bytes), double(budget.state_bytes), double(budget.rules),
                                   double(knowledge->program().conds.size()), double(image)};
    };
    // All three have 16-bit indexes: wide ones would not be comparable.
    const auto small = cost(1'000), middle = cost(2'000), large = cost(4'000);
    for (std::size_t i = 0; i < small.size(); ++i) {
      EXPECT_NEAR((large[i] - middle[i]) / (middle[i] - small[i]), 2.0, 0.1) << i;
    }
  }
}

/// One landmark concerns the rules of its roads, however many there are: none sleeps under what all of them read.
TEST(RoadMaps, NoRuleSleepsUnderWhatAllRead) {
  const RoadMap map = bench::make_city(400, 1);
  const auto knowledge = knowledge_of(map, make_tour(map, 4, 1));
  const tables::Tables& tables = knowledge->tables();
  std::vector<std::uint32_t> sleepers(tables.shape.atoms, 0);
  for (std::size_t r = 0; r < knowledge->program().rules.size(); ++r) {
    if (knowledge->program().rules[r].tmpl() != "expect") continue;
    EXPECT_LE(++sleepers[tables.rule_key[r]], 4u);
  }
}

}  // namespace
}  // namespace kb::world
