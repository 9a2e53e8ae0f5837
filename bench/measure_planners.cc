// Measures what docs/planners.md says of the planners, and prints it as the sections of that page:
//
//   build/bench/bench/measure_planners data/movingai [section...]
//
// tools/measure_planners puts the sections into the page. Lengths, counts and outcomes are the same on every machine; times
// are of this one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "planners/fairway.h"
#include "planners/fuzzy.h"
#include "planners/neural.h"
#include "planners/potential.h"
#include "planners/report/rows.h"
#include "planners/shortest.h"
#include "planners/trap.h"
#include "planners/two_maps.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::Benchmark;
using testing::benchmarks;

// Time of this thread's processor: other work on the machine does not count.
struct Clock {
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
};
double seconds_since(double begin) { return Clock::now() - begin; }

unsigned cores() { return std::max(1u, std::thread::hardware_concurrency()); }

template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
  const std::string text = fmt::format(form, std::forward<Arguments>(arguments)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

double statistic(const Statistics& statistics, std::string_view name) {
  for (const auto& [what, value] : statistics.more) {
    if (what == name) return value;
  }
  return 0.0;
}

// ---- all methods on all rows
void measure_rows() {
  for (const Knowledge knowledge : {Knowledge::kFullMap, Knowledge::kLocalRange, Knowledge::kContact}) {
    bool begun = false;
    for (const Method& method : methods()) {
      if (method.knowledge != knowledge) continue;
      if (!std::exchange(begun, true)) {
        say("\nKnows: {}\n\n| method | map | reached | trapped | no way | limit | numeric | mean ratio | median | p95 | median us |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|\n",
            name(knowledge));
      }
      for (const Benchmark& map : benchmarks()) {
        RunOptions run;
        const auto answers = answer_rows(method, map.grid, map.scenarios, run, cores());
        const Summary s = summarise(method, map.scenarios, answers);
        say("| {} | {} | {} of {} | {} | {} | {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.1f} |\n", s.method, map.name, s.reached,
            s.rows, s.trapped, s.unreachable, s.limit, s.other, s.mean_ratio, s.median_ratio, s.p95_ratio, s.median_us);
      }
    }
  }
}

// ---- neural map
// Median over the rows of the time of one call, each the least of `repeats`.
template <class Call>
double median_us(const Benchmark& map, const Call& call, int repeats = 5) {
  std::vector<double> times;
  for (std::size_t i = 0; i < map.scenarios.size(); i += 3) {
    double least = 1e9;
    for (int n = 0; n < repeats; ++n) {
      const auto begin = Clock::now();
      call(map.scenarios[i]);
      least = std::min(least, seconds_since(begin));
    }
    times.push_back(1e6 * least);
  }
  return percentile(times, 50);
}

double sum_us(const Benchmark& map, const auto& call, int repeats = 5) {
  double sum = 0.0;
  for (std::size_t i = 0; i < map.scenarios.size(); i += 3) {
    double least = 1e9;
    for (int n = 0; n < repeats; ++n) {
      const auto begin = Clock::now();
      call(map.scenarios[i]);
      least = std::min(least, seconds_since(begin));
    }
    sum += 1e6 * least;
  }
  return sum;
}

void measure_neural() {
  say("| map | worst ratio - 1 | field, ns a reached cell | early stop, sum of rows us | A*, sum us | of A* | "
      "mend a freed cell, share of a field | 90 % of cells below |\n|---|---|---|---|---|---|---|---|\n");
  for (const Benchmark& map : benchmarks()) {
    double worst = 0.0;
    Astar astar(map.grid);
    for (const Scenario& row : map.scenarios) {
      const Result result = plan(*find_method("neural"), testing::problem_between(map.grid, row.start, row.goal));
      static_cast<void>(astar.search(row.start, row.goal));
      worst = std::max(worst, std::abs(result.length_m / astar.length() - 1.0));
    }
    const RunOptions run;
    const auto whole = [&](const Scenario& row) {
      Watch watch(run);
      return relax(map.grid, row.goal, {}, watch);
    };
    const double field_us = median_us(map, whole);
    const auto reached_cells = static_cast<double>(distance_field(map.grid, {map.scenarios[0].goal}).settled);
    NeuralQuery query(map.grid);
    const double early_us = sum_us(map, [&](const Scenario& row) { return query.path(row.start, row.goal); });
    const double astar_us = sum_us(map, [&](const Scenario& row) { return astar.search(row.start, row.goal); });
    // Blocked cells that touch a free one are freed, one at a time.
    Grid grid = map.grid;
    std::vector<double> mend_us;
    NeuralMap old = whole(map.scenarios[0]);
    for (std::int32_t y = 0; y < grid.height(); y += 3) {
      for (std::int32_t x = 0; x < grid.width(); x += 3) {
        if (grid.free({x, y})) continue;
        NeuralMap copy = old;
        grid.set_blocked({x, y}, false);
        const auto begin = Clock::now();
        mend(grid, copy, map.scenarios[0].goal, {x, y});
        mend_us.push_back(1e6 * seconds_since(begin));
        grid.set_blocked({x, y}, true);
      }
    }
    say("| {} | {:.1e} | {:.1f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} % | {:.1f} % |\n", map.name, worst,
        1e3 * field_us / reached_cells, early_us, astar_us, early_us / astar_us, 100.0 * percentile(mend_us, 50) / field_us,
        100.0 * percentile(mend_us, 90) / field_us);
  }
}

// ---- fuzzy rules
void measure_fuzzy() {
  // Robots on a large map, each its own goal; a robot that loops or arrives is set to another place.
  const Grid grid = testing::random_grid(512, 512, 0.2, 7);
  std::mt19937_64 dice(1);
  const auto anywhere = [&] {
    for (;;) {
      const Cell cell{static_cast<std::int32_t>(dice() % 512), static_cast<std::int32_t>(dice() % 512)};
      if (grid.free(cell)) return cell;
    }
  };
  struct Robot {
    Cell at, goal;
    CellIndex index;
  };
  const std::size_t count = 1000;
  std::vector<Robot> robots(count);
  const auto place = [&](Robot& robot) {
    robot.at = anywhere();
    robot.goal = anywhere();
    robot.index = grid.index(robot.at);
  };
  for (Robot& robot : robots) place(robot);
  const std::uint8_t* const moves = grid.all_moves().data();
  const std::uint8_t* const blocked = grid.all_blocked().data();
  constexpr std::array<Cell, 9> kSteps = {{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {0, 0}}};
  std::array<std::int32_t, 9> by{};
  std::copy(grid.steps().begin(), grid.steps().end(), by.begin());
  const std::uint64_t ticks = 1'000'000;   // times 1000 robots: 10^9 steps
  std::uint64_t collisions = 0;
  const auto begin = Clock::now();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    for (Robot& robot : robots) {
      const std::uint8_t k = fuzzy_move(robot.goal.x - robot.at.x, robot.goal.y - robot.at.y, moves[robot.index]);
      robot.at = robot.at + kSteps[k];
      robot.index = static_cast<CellIndex>(static_cast<std::int32_t>(robot.index) + by[k]);
      collisions += blocked[robot.index];
    }
    place(robots[tick % count]);
  }
  const double ns = 1e9 * seconds_since(begin) / static_cast<double>(ticks * count);
  say("- robot-steps: {:.0e}, collisions: {}, {:.2f} ns a robot and step (decision, move and the check for collision)\n",
      static_cast<double>(ticks * count), collisions, ns);
}

// ---- traps
struct Confusion {
  std::size_t runs = 0, hits = 0, misses = 0, alarms = 0;
  std::array<std::size_t, 4> false_kinds{};   // by Trap::Kind
  std::vector<double> delays;   // in windows
};

Confusion label_runs(Attraction attraction, Drive drive, std::size_t wanted) {
  Confusion out;
  PotentialParameters parameters;
  parameters.attraction = attraction;
  for (std::uint64_t seed = 1; out.runs < wanted; ++seed) {
    const double share = 0.02 + 0.03 * static_cast<double>(seed % 5);
    const Grid grid = testing::random_grid(40, 40, share, seed);
    const GridClearance clearance(grid, parameters.zone_cells);
    std::mt19937_64 dice(seed);
    for (int i = 0; i < 20 && out.runs < wanted; ++i) {
      const auto cell = [&] { return Cell{static_cast<std::int32_t>(dice() % 40), static_cast<std::int32_t>(dice() % 40)}; };
      const Cell from = cell(), to = cell();
      if (grid.blocked(from) || grid.blocked(to)) continue;
      const Problem problem = testing::problem_between(grid, from, to);
      const PotentialField field(clearance, problem.goal, 1.0, parameters);
      DriveParameters how;
      how.drive = drive;
      const Result seen = drive_by_potential(field, problem, how, {});
      how.diagnose = false;
      // Twenty times as long as the diagnosed run took, and not less than what crosses the map twenty times.
      how.max_steps = std::max<std::uint64_t>(20 * seen.statistics.steps, 20000);
      const Result truth = drive_by_potential(field, problem, how, {});
      const bool trapped = truth.outcome != Outcome::kReached, alarmed = seen.outcome == Outcome::kTrapped;
      ++out.runs;
      out.hits += trapped && alarmed ? 1 : 0;
      out.misses += trapped && !alarmed ? 1 : 0;
      out.alarms += !trapped && alarmed ? 1 : 0;
      if (!trapped && alarmed) ++out.false_kinds[static_cast<std::size_t>(seen.trap.kind)];
      if (!(trapped && alarmed)) continue;
      // Caught since the last time that it was farther than the box from where it was diagnosed.
      std::size_t since = seen.path.size() - 1;
      while (since > 0 && distance(seen.path[since], seen.trap.at) < 1.5) --since;
      const double window_s = 12.0;   // 12 cells of way at 1 m/s
      out.delays.push_back((seen.trap.time_s - seen.times_s[since]) / window_s);
    }
  }
  return out;
}

// Labelled runs of each scheme; fewer for a quick look.
std::size_t trap_runs() {
  const char* few = std::getenv("TRAP_RUNS");
  return few != nullptr ? static_cast<std::size_t>(std::strtoul(few, nullptr, 10)) : 5000;
}

void measure_traps() {
  say("| attraction | control | runs | trapped | precision | recall | median delay, windows of 12 s | false alarms: rest, chatter, cycle |\n|---|---|---|---|---|---|---|---|\n");
  const auto row = [](std::string_view what, std::string_view how, Attraction attraction, Drive drive) {
    const Confusion c = label_runs(attraction, drive, trap_runs());
    const auto hits = static_cast<double>(c.hits);
    say("| {} | {} | {} | {} | {:.4f} | {:.4f} | {:.2f} | {}, {}, {} |\n", what, how, c.runs, c.hits + c.misses,
        hits / std::max(1.0, hits + static_cast<double>(c.alarms)), hits / std::max(1.0, hits + static_cast<double>(c.misses)),
        percentile(c.delays, 50), c.false_kinds[1], c.false_kinds[2], c.false_kinds[3]);
    std::fflush(stdout);
  };
  row("conic", "kinematic", Attraction::kConic, Drive::kKinematic);
  row("parabolic", "kinematic", Attraction::kParabolic, Drive::kKinematic);
  row("combined", "kinematic", Attraction::kCombined, Drive::kKinematic);
  row("conic", "dynamic", Attraction::kConic, Drive::kDynamic);
}

// ---- fairway
void measure_fairway() {
  say("| map | reached | median ratio | p95 | time, of a Dijkstra field | median share of approach | median share of the map in the basin |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const Benchmark& map : benchmarks()) {
    const auto answers = answer_rows(*find_method("fairway"), map.grid, map.scenarios, {}, 1);
    const Summary s = summarise(*find_method("fairway"), map.scenarios, answers);
    std::vector<double> approach, basin;
    for (const Answer& answer : answers) {
      approach.push_back(statistic(answer.statistics, "approach share"));
      basin.push_back(statistic(answer.statistics, "basin share"));
    }
    const double field_us = median_us(map, [&](const Scenario& row) { return distance_field(map.grid, {row.goal}); });
    const double us = median_us(map, [&](const Scenario& row) { return find_fairway(map.grid, row.start, row.goal); });
    say("| {} | {} of {} | {:.4f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} |\n", map.name, s.reached, s.rows, s.median_ratio,
        s.p95_ratio, us / field_us, percentile(approach, 50), percentile(basin, 50));
  }
}

// ---- two maps: where the failures come from
void measure_two_maps() {
  say("| map | reached | closed isoline, a way exists | no room beside an obstacle | steps used up | p95 ratio |\n|---|---|---|---|---|---|\n");
  for (const Benchmark& map : benchmarks()) {
    const auto answers = answer_rows(*find_method("two-maps"), map.grid, map.scenarios, {}, cores());
    const Summary s = summarise(*find_method("two-maps"), map.scenarios, answers);
    std::size_t closed = 0, room = 0, steps = 0;
    for (const Answer& answer : answers) {
      if (answer.outcome == Outcome::kReached) continue;
      if (statistic(answer.statistics, "closed isoline") > 0.0) ++closed;
      else if (statistic(answer.statistics, "no room") > 0.0) ++room;
      else ++steps;
    }
    say("| {} | {} of {} | {} | {} | {} | {:.2f} |\n", map.name, s.reached, s.rows, closed, room, steps, s.p95_ratio);
  }
}

struct Section {
  std::string_view name;
  void (*measure)();
};
constexpr Section kSections[] = {{"rows", measure_rows},     {"neural", measure_neural}, {"fuzzy", measure_fuzzy},
                                 {"fairway", measure_fairway}, {"two-maps", measure_two_maps}, {"traps", measure_traps}};

}  // namespace
}  // namespace kb::planners

int main(int argc, char** argv) {
  for (const auto& section : kb::planners::kSections) {
    bool wanted = argc < 2;
    for (int i = 1; i < argc; ++i) wanted = wanted || section.name == argv[i];
    if (!wanted) continue;
    std::printf("<!-- measured: %s -->\n", std::string(section.name).c_str());
    section.measure();
    std::printf("<!-- end -->\n");
    std::fflush(stdout);
  }
  return 0;
}
