// Groups of the sizes that Darintsev and Migranov name, 10, 50 and 1,000, and of 100,000 and a million: every robot has a goal of its
// own on a common grid, decides by the 72 rules for itself, and never shares a cell.
//
//   build/bench/bench/measure_groups [--seed N] [--quick]
//
// Prints the table of docs/batches.md. What arrives and when is the same on every machine; times are of this one: the processor's,
// of one thread and of two together, the least of many steps. Other work on the machine does not count, but for what it takes
// of the caches. `--quick` leaves out the million.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string_view>
#include <vector>

#include "planners/dice.h"
#include "planners/swarm.h"
#include "tests/unit/planners/meetings.h"

namespace kb::planners {
namespace {

constexpr std::array<std::size_t, 5> kRobots{10, 50, 1'000, 100'000, 1'000'000};
constexpr std::array<std::size_t, 2> kCellsOfARobot{4, 16};
constexpr std::uint64_t kTimedSteps = 64;

struct World {
  Grid grid;
  std::vector<Swarm::Robot> robots;
};

/// One cell in a hundred is blocked; starts are different, and so are goals.
World draw_world(std::size_t robots, std::size_t cells_of_a_robot, std::uint64_t seed) {
  const auto side = static_cast<std::int32_t>(std::ceil(std::sqrt(static_cast<double>(robots * cells_of_a_robot))));
  World world{Grid(side, side), {}};
  Dice dice(seed);
  const auto draw = [&] {
    const auto below = [&] { return static_cast<std::int32_t>(dice.below(static_cast<std::uint32_t>(side))); };
    const std::int32_t x = below();
    return Cell{x, below()};
  };
  for (std::size_t i = 0; i < world.grid.size() / 100; ++i) world.grid.set_blocked(draw(), true);
  std::vector<bool> starts(world.grid.size(), false), goals(world.grid.size(), false);
  const auto draw_free = [&](std::vector<bool>& used) {
    for (;;) {
      const Cell cell = draw();
      if (world.grid.blocked(cell) || used[world.grid.index(cell)]) continue;
      used[world.grid.index(cell)] = true;
      return cell;
    }
  };
  for (std::size_t i = 0; i < robots; ++i) {
    const Cell at = draw_free(starts);
    world.robots.push_back({at, draw_free(goals)});
  }
  return world;
}

template <clockid_t clock>
double now_s() {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds of the fastest of the first steps, when most robots are on the way. Steps of small groups are timed together, or the
/// clock would be what is timed.
template <clockid_t clock>
double fastest_step(const World& world, unsigned threads) {
  const std::uint64_t together = world.robots.size() < 10'000 ? 8 : 1;
  double least = std::numeric_limits<double>::max();
  for (int repeat = 0; repeat < 3; ++repeat) {
    Swarm swarm(world.grid, kFuzzyTable, world.robots);
    for (std::uint64_t i = 0; i < kTimedSteps; i += together) {
      const double begin = now_s<clock>();
      for (std::uint64_t k = 0; k < together; ++k) static_cast<void>(swarm.step(threads));
      least = std::min(least, (now_s<clock>() - begin) / static_cast<double>(together));
    }
  }
  return least;
}

void measure(std::size_t robots, std::size_t cells_of_a_robot, std::uint64_t seed) {
  const World world = draw_world(robots, cells_of_a_robot, seed);
  const double one_s = fastest_step<CLOCK_THREAD_CPUTIME_ID>(world, 1), two_s = fastest_step<CLOCK_PROCESS_CPUTIME_ID>(world, 2);
  Swarm swarm(world.grid, kFuzzyTable, world.robots);
  const auto side = static_cast<std::uint64_t>(world.grid.width());
  // Every step of a group that can be watched at once; of a million, one in a hundred.
  const std::uint64_t look_every = robots > 100'000 ? 101 : robots > 1'000 ? 11 : 1;
  testing::Meetings all(world.grid);
  std::size_t meetings = 0, looks = 0;
  std::uint64_t ticks = 0, last = 0;
  for (std::size_t idle = 0, arrived = swarm.arrived(); arrived < robots && idle < 3 * side && ticks < 2 * side; ++ticks) {
    const bool look = ticks % look_every == 0;
    const std::vector<Cell> before = look ? swarm.cells() : std::vector<Cell>();
    idle = swarm.step(2) == 0 ? idle + 1 : 0;
    if (swarm.arrived() > arrived) last = ticks + 1;
    arrived = swarm.arrived();
    if (!look) continue;
    ++looks;
    meetings += all.between(before, swarm.cells());
  }
  fmt::print("| {} | {} | {} x {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} % | {} | {} in {} |\n", robots, cells_of_a_robot, side, side, 1e6 * one_s, 1e6 * two_s,
             static_cast<double>(swarm.bytes()) / static_cast<double>(robots), 100.0 * static_cast<double>(swarm.arrived()) / static_cast<double>(robots), last,
             meetings, looks);
  std::fflush(stdout);
}

}  // namespace
}  // namespace kb::planners

int main(int argc, char** argv) {
  std::uint64_t seed = 1;
  bool quick = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--quick") quick = true;
    else if (std::string_view(argv[i]) == "--seed" && i + 1 < argc) seed = std::strtoull(argv[++i], nullptr, 10);
    else return std::fputs("measure_groups [--seed N] [--quick]\n", stderr), 2;
  }
  fmt::print("| robots | cells a robot | grid | us a step, one thread | us a step, two threads together | bytes a robot | arrive | last arrival, steps | meetings in steps looked at |\n"
             "|---:|---:|---|---:|---:|---:|---:|---:|---:|\n");
  for (const std::size_t cells : kb::planners::kCellsOfARobot) {
    for (const std::size_t robots : kb::planners::kRobots) {
      if (!quick || robots <= 100'000) kb::planners::measure(robots, cells, seed);
    }
  }
  return 0;
}
