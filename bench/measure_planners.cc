// Measures what docs/planners.md says of the planners, and prints it as the sections of that page:
//
//   build/bench/bench/measure_planners data/movingai [section...]
//
// tools/measure_planners puts the sections into the page. Lengths, counts and outcomes are the same on every machine; times
// are of this one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "bench/clock.h"
#include "planners/crew.h"
#include "planners/fairway.h"
#include "planners/fuzzy_crowd.h"
#include "planners/neural.h"
#include "planners/potential.h"
#include "planners/report/rows.h"
#include "planners/shortest.h"
#include "planners/trap.h"
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
// The times of some calls by rows, each the least of five. By turns: the machine is now faster and now slower.
template <class... Calls>
std::array<std::vector<double>, sizeof...(Calls)> times_us(const Benchmark& map, const Calls&... calls) {
  constexpr int kRepeats = 5;
  std::array<std::vector<double>, sizeof...(Calls)> times;
  for (std::size_t i = 0; i < map.scenarios.size(); i += 3) {
    std::array<double, sizeof...(Calls)> least;
    least.fill(1e9);
    for (int n = 0; n < kRepeats; ++n) {
      std::size_t which = 0;
      const auto time = [&](const auto& call) {
        const auto begin = Clock::now();
        call(map.scenarios[i]);
        least[which] = std::min(least[which], seconds_since(begin));
        ++which;
      };
      (time(calls), ...);
    }
    for (std::size_t which = 0; which < least.size(); ++which) times[which].push_back(1e6 * least[which]);
  }
  return times;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double mean(const std::vector<double>& values) { return values.empty() ? 0.0 : sum(values) / static_cast<double>(values.size()); }

// Per cent of a field, for each blocked cell beside a reached one that is freed alone.
struct Mending {
  std::vector<double> time, changed;
};
Mending measure_mending(const Grid& map, Cell goal) {
  Grid grid = map;
  const RunOptions run;
  Watch watch(run);
  const NeuralMap old = relax(grid, goal, {}, watch);
  NeuralMap field = old;
  Mending out;
  for (CellIndex at = 0; at < grid.size(); ++at) {
    const Cell cell = grid.cell(at);
    const bool beside = std::any_of(kDirections.begin(), kDirections.end(), [&](Cell step) {
      return grid.free(cell + step) && old.active(grid.index(cell + step));
    });
    if (!grid.contains(cell) || grid.free(cell) || !beside) continue;
    grid.set_blocked(cell, false);
    double mend_s = 1e9, whole_s = 1e9;
    std::uint64_t changed = 0, all = 1;
    // By turns, for the machine is now faster and now slower; by a clock that costs little, for a mending takes a tenth of a us.
    for (int n = 0; n < 10; ++n) {
      field.level = old.level;
      auto begin = bench::Clock::now();
      changed = mend(grid, field, goal, cell);
      mend_s = std::min(mend_s, 1e-9 * bench::ns_since(begin));
      begin = bench::Clock::now();
      all = relax(grid, goal, {}, watch).updates;
      whole_s = std::min(whole_s, 1e-9 * bench::ns_since(begin));
    }
    grid.set_blocked(cell, true);
    out.time.push_back(100.0 * mend_s / whole_s);
    out.changed.push_back(100.0 * static_cast<double>(changed) / static_cast<double>(all));
  }
  return out;
}

void measure_neural() {
  say("| map | worst ratio - 1 | field, ns a reached cell | one question, sum over rows, us | A*, sum over rows, us | question / A* | "
      "mending a freed cell, of a field's time: median, mean, 90th percentile | cells that change, of all: median, mean, 90th percentile |\n"
      "|---|---|---|---|---|---|---|---|\n");
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
    const double field_us = percentile(times_us(map, whole)[0], 50);
    const auto reached_cells = static_cast<double>(distance_field(map.grid, {map.scenarios[0].goal}).settled);
    NeuralQuery query(map.grid);
    const double early_us = sum(times_us(map, [&](const Scenario& row) { return query.path(row.start, row.goal); })[0]);
    const double astar_us = sum(times_us(map, [&](const Scenario& row) { return astar.search(row.start, row.goal); })[0]);
    const Mending mending = measure_mending(map.grid, map.scenarios[0].goal);
    say("| {} | {:.1e} | {:.1f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} %, {:.2f} %, {:.2f} % | {:.2f} %, {:.2f} %, {:.2f} % |\n", map.name,
        worst, 1e3 * field_us / reached_cells, early_us, astar_us, early_us / astar_us, percentile(mending.time, 50),
        mean(mending.time), percentile(mending.time, 90), percentile(mending.changed, 50), mean(mending.changed),
        percentile(mending.changed, 90));
  }
}

// ---- fuzzy rules
void measure_fuzzy() {
  // Robots on a large map, each its own goal; a robot that loops or arrives is set to another place.
  const Grid grid = testing::random_grid(512, 512, 0.2, 7);
  std::mt19937_64 dice(1);
  const auto anywhere = [&] { return testing::random_free_cell(grid, dice); };
  const std::size_t count = 1000;
  FuzzyCrowd crowd(grid);
  for (std::size_t i = 0; i < count; ++i) {
    const Cell from = anywhere();
    crowd.add(from, anywhere());
  }
  const std::uint8_t* const blocked = grid.all_blocked().data();
  const std::uint64_t ticks = 1'000'000;   // times 1000 robots: 10^9 steps
  std::uint64_t collisions = 0;
  double least_s = 1e9, all_s = 0.0;   // of a thousand ticks, and of all
  for (std::uint64_t tick = 0; tick < ticks;) {
    const auto begin = Clock::now();
    do {
      crowd.step();
      for (std::size_t i = 0; i < count; ++i) collisions += blocked[crowd.index(i)];
      const auto cell = anywhere();
      crowd.place(tick % count, cell, anywhere());
    } while (++tick % 1000 != 0);
    least_s = std::min(least_s, seconds_since(begin));
    all_s += seconds_since(begin);
  }
  const double ns = 1e9 * least_s / static_cast<double>(1000 * count), mean_ns = 1e9 * all_s / static_cast<double>(ticks * count);
  say("- robot-steps: {:.0e}, collisions: {}, {:.2f} ns a robot and step for decision, move and collision check (the least of a "
      "thousand stretches; the mean is {:.2f})\n",
      static_cast<double>(ticks * count), collisions, ns, mean_ns);
}

// ---- traps
struct Confusion {
  std::size_t runs = 0, hits = 0, misses = 0, alarms = 0;
  std::array<std::size_t, 4> false_kinds{};   // by Trap::Kind
  std::vector<double> delays;   // in windows
};

Confusion label_runs(Attraction attraction, Drive drive, std::size_t wanted) {
  Confusion out;
  for (std::uint64_t seed = 1; out.runs < wanted; ++seed) {
    const double share = 0.02 + 0.03 * static_cast<double>(seed % 5);
    const Grid grid = testing::random_grid(40, 40, share, seed);
    const GridClearance clearance(grid, PotentialParameters{}.zone_cells);
    std::mt19937_64 dice(seed);
    for (int i = 0; i < 20 && out.runs < wanted; ++i) {
      const auto cell = [&] { return Cell{static_cast<std::int32_t>(dice() % 40), static_cast<std::int32_t>(dice() % 40)}; };
      const Cell from = cell(), to = cell();
      if (grid.blocked(from) || grid.blocked(to)) continue;
      const Problem problem = testing::problem_between(grid, from, to);
      const PotentialField field(clearance, problem.goal, 1.0, parameters_for(problem, attraction));
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
  row("parabolic", "dynamic", Attraction::kParabolic, Drive::kDynamic);
  row("combined", "dynamic", Attraction::kCombined, Drive::kDynamic);
}

// ---- conic against parabolic
void measure_attractions() {
  say("| map | conic | parabolic, k = (1 m/s) / D | parabolic, k = 1/s |\n|---|---|---|---|\n");
  for (const Benchmark& map : benchmarks()) {
    const GridClearance clearance(map.grid, PotentialParameters{}.zone_cells);
    std::array<std::size_t, 3> reached{};
    for (const Scenario& row : map.scenarios) {
      const Problem problem = testing::problem_between(map.grid, row.start, row.goal);
      std::array<PotentialParameters, 3> forms = {parameters_for(problem, Attraction::kConic),
                                                  parameters_for(problem, Attraction::kParabolic), {}};
      forms[2].attraction = Attraction::kParabolic;
      for (std::size_t i = 0; i < forms.size(); ++i) {
        const PotentialField field(clearance, problem.goal, 1.0, forms[i]);
        reached[i] += drive_by_potential(field, problem, {}, {}).outcome == Outcome::kReached ? 1 : 0;
      }
    }
    const auto share = [&](std::size_t n) { return 100.0 * static_cast<double>(n) / static_cast<double>(map.scenarios.size()); };
    say("| {} | {} of {} ({:.1f} %) | {} ({:.1f} %) | {} ({:.1f} %) |\n", map.name, reached[0], map.scenarios.size(), share(reached[0]),
        reached[1], share(reached[1]), reached[2], share(reached[2]));
  }
}

// ---- fairway
void measure_fairway() {
  say("| map | reached | median ratio | p95 | time / that of a Dijkstra field | median share of approach | median share of the map in the basin |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const Benchmark& map : benchmarks()) {
    const auto answers = answer_rows(*find_method("fairway"), map.grid, map.scenarios, {}, 1);
    const Summary s = summarise(*find_method("fairway"), map.scenarios, answers);
    std::vector<double> approach, basin;
    for (const Answer& answer : answers) {
      approach.push_back(statistic(answer.statistics, "approach share"));
      basin.push_back(statistic(answer.statistics, "basin share"));
    }
    const auto [field_us, us] = times_us(
        map, [&](const Scenario& row) { return distance_field(map.grid, {row.goal}); },
        [&](const Scenario& row) { return find_fairway(map.grid, row.start, row.goal); });
    say("| {} | {} of {} | {:.4f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} |\n", map.name, s.reached, s.rows, s.median_ratio,
        s.p95_ratio, percentile(us, 50) / percentile(field_us, 50), percentile(approach, 50), percentile(basin, 50));
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
                                 {"fairway", measure_fairway}, {"two-maps", measure_two_maps}, {"traps", measure_traps},
                                 {"attractions", measure_attractions}};

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
