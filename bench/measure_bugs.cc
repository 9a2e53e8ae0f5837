// Measures what docs/planners_bugs_genetic.md says of lengths and outcomes, and prints its tables. The figures are the same on
// every machine. With an argument it also writes the pictures of that page into the folder.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "planners/bug.h"
#include "planners/dice.h"
#include "planners/fairway_bug.h"
#include "planners/genetic.h"
#include "planners/movers.h"
#include "planners/rectangle.h"
#include "planners/report/rows.h"
#include "planners/shortest.h"
#include "planners/space_time.h"
#include "tests/unit/planners/patrols.h"
#include "tests/unit/planners/planning.h"
#include "tests/unit/planners/separate_obstacles.h"

namespace kb::planners {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

struct Variant {
  const char* name;
  std::function<Result(const Problem&)> run;
};
std::vector<Variant> bugs() {
  const auto modified = [](LeaveRule leave, HandRule hand) {
    return [=](const Problem& p) { return modified_bug(p, {}, {.leave = leave, .hand = hand}); };
  };
  return {{"Bug1", [](const Problem& p) { return bug1(p, {}); }},
          {"Bug2", [](const Problem& p) { return bug2(p, {}); }},
          {"Bug2, smaller turn", [](const Problem& p) { return bug2(p, {}, {.hand = HandRule::kSmallerTurn}); }},
          {"modified, literal", modified(LeaveRule::kLiteral, HandRule::kLeft)},
          {"modified, literal, alternate hands", modified(LeaveRule::kLiteral, HandRule::kAlternate)},
          {"modified, literal, smaller turn", modified(LeaveRule::kLiteral, HandRule::kSmallerTurn)},
          {"modified, guarded", modified(LeaveRule::kGuarded, HandRule::kLeft)},
          {"modified, guarded, smaller turn (`bug`)", modified(LeaveRule::kGuarded, HandRule::kSmallerTurn)},
          {"modified, nearer, smaller turn", modified(LeaveRule::kNearer, HandRule::kSmallerTurn)}};
}

void bugs_on_maps() {
  for (const auto& map : testing::benchmarks()) {
    fmt::print("\n{}, {} rows\n\n| contact | reached | mean | median | p95 | worst |\n|---|---|---|---|---|---|\n", map.name,
               map.scenarios.size());
    for (const Variant& variant : bugs()) {
      std::vector<double> ratios;
      std::size_t reached = 0;
      for (const Scenario& row : map.scenarios) {
        const Result result = variant.run(testing::problem_between(map.grid, row.start, row.goal));
        if (result.outcome != Outcome::kReached) continue;
        ++reached;
        if (row.optimum > 0.0) ratios.push_back(result.length_m / row.optimum);
      }
      fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.0f} |\n", variant.name, reached, mean(ratios), percentile(ratios, 50),
                 percentile(ratios, 95), percentile(ratios, 100));
    }
  }
}

void bugs_among_separate_obstacles() {
  const std::vector<std::pair<const char*, testing::SeparateObstacles>> kinds = {{"40 obstacles of 4 to 14 cells", {100, 40, 4, 14}},
                                                                                 {"150 obstacles of 2 to 10 cells", {100, 150, 2, 10}}};
  for (const auto& [name, kind] : kinds) {
    std::vector<std::vector<double>> to_optimum(bugs().size()), to_bug2(bugs().size());
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
      const auto world = testing::make_separate_obstacles(kind, seed);
      Astar search(world.grid);
      const double optimum = search.search(world.start, world.goal).empty() ? 0.0 : search.length();
      const Problem problem = testing::problem_between(world.grid, world.start, world.goal);
      const double bug2_m = bug2(problem, {}).length_m;
      for (std::size_t i = 0; i < bugs().size(); ++i) {
        const double length_m = bugs()[i].run(problem).length_m;
        to_optimum[i].push_back(length_m / optimum);
        to_bug2[i].push_back(length_m / bug2_m);
      }
    }
    fmt::print("\n{}, 2,000 worlds\n\n| contact | median to optimum | median to Bug2 |\n|---|---|---|\n", name);
    for (std::size_t i = 0; i < bugs().size(); ++i) {
      fmt::print("| {} | {:.3f} | {:.3f} |\n", bugs()[i].name, percentile(to_optimum[i], 50), percentile(to_bug2[i], 50));
    }
  }
}

void genetic_on_maps() {
  fmt::print("\n| map | weights | reached | mean | p95 | worst | generations |\n|---|---|---|---|---|---|---|\n");
  for (const auto& map : testing::benchmarks()) {
    for (const bool balanced : {false, true}) {
      GeneticOptions options;
      if (balanced) options.weights = kBalancedWeights;
      std::vector<double> ratios, generations;
      std::size_t reached = 0;
      for (const Scenario& row : map.scenarios) {
        const GeneticReport report = evolve(testing::problem_between(map.grid, row.start, row.goal), {}, options);
        reached += report.result.outcome == Outcome::kReached ? 1 : 0;
        generations.push_back(static_cast<double>(report.result.statistics.steps));
        if (row.optimum > 0.0) ratios.push_back(report.result.length_m / row.optimum);
      }
      fmt::print("| {} | {} | {} of {} | {:.5f} | {:.4f} | {:.4f} | {:.0f} |\n", map.name, balanced ? "balanced" : "length",
                 reached, map.scenarios.size(), mean(ratios), percentile(ratios, 95), percentile(ratios, 100), mean(generations));
    }
  }
}

void genetic_among_patrols() {
  const auto& arena = testing::benchmarks()[0];
  fmt::print("\n| patrols | rows | feasible | median arrival | p95 | worst | collisions |\n|---|---|---|---|---|---|---|\n");
  for (const int patrols : {10, 40, 100, 200}) {
    std::vector<double> ratios;
    std::size_t asked = 0, feasible = 0, collisions = 0;
    for (std::size_t i = 0; i < arena.scenarios.size(); ++i) {
      const Scenario& row = arena.scenarios[i];
      const Movers movers = testing::make_patrols(arena.grid, patrols, 120, row.start, i);
      const auto best =
          search_space_time(arena.grid, movers, {.from = row.start, .to = row.goal}, steps_to(arena.grid, row.goal));
      if (best.size() < 2) continue;
      Problem problem = testing::problem_between(arena.grid, row.start, row.goal);
      problem.movers = &movers;
      const Result result = evolve(problem, {}).result;
      ++asked;
      if (result.outcome != Outcome::kReached) continue;
      ++feasible;
      collisions += check_walk(arena.grid, &movers, testing::cells_of(arena.grid, result)) ? 1 : 0;
      ratios.push_back(static_cast<double>(result.path.size() - 1) / static_cast<double>(best.size() - 1));
    }
    fmt::print("| {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {} |\n", patrols, asked, feasible, percentile(ratios, 50),
               percentile(ratios, 95), percentile(ratios, 100), collisions);
  }
}

void fairway_and_bug() {
  fmt::print("\n| map | unknown cells | right | reached | median ratio | p95 | computed anew |\n|---|---|---|---|---|---|---|\n");
  for (const auto& map : testing::benchmarks()) {
    for (const int unknown : {10, 40}) {
      std::vector<double> ratios;
      std::size_t right = 0, reached = 0, asked = 0;
      double loops = 0.0;
      for (std::size_t i = 0; i < map.scenarios.size(); ++i) {
        const Scenario& row = map.scenarios[i];
        Grid actual = map.grid;
        Dice dice(i);
        for (int k = 0; k < unknown; ++k) {
          const Cell cell = actual.cell(dice.below(actual.size()));
          if (!(cell == row.start) && !(cell == row.goal)) actual.set_blocked(cell, true);
        }
        Astar search(actual);
        const bool way = !search.search(row.start, row.goal).empty();
        const Result result = fairway_bug(testing::problem_between(map.grid, row.start, row.goal), actual, {});
        ++asked;
        right += (result.outcome == Outcome::kReached) == way ? 1 : 0;
        loops += result.statistics.more.at(1).second;
        if (result.outcome != Outcome::kReached) continue;
        ++reached;
        if (search.length() > 0.0) ratios.push_back(result.length_m / search.length());
      }
      fmt::print("| {} | {} | {} of {} | {} | {:.3f} | {:.3f} | {:.0f} times |\n", map.name, unknown, right, asked, reached,
                 percentile(ratios, 50), percentile(ratios, 95), loops);
    }
  }
}

// ---- pictures

class Drawing {
 public:
  Drawing(double width, double height, double scale) : height_(height), scale_(scale) {
    text_ = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\">\n"
                        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                        width * scale, height * scale, width * scale);
  }
  void blocked(const Grid& grid) {
    for (std::int32_t y = 0; y < grid.height(); ++y) {
      for (std::int32_t x = 0; x < grid.width();) {
        const std::int32_t first = x;
        while (x < grid.width() && grid.blocked({x, y})) ++x;
        if (x > first) {
          text_ += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#bbb\"/>\n", first * scale_,
                               (height_ - y - 1) * scale_, (x - first) * scale_, scale_);
        }
        x += x == first ? 1 : 0;
      }
    }
  }
  void line(const std::vector<Point>& points, const char* colour, double width, bool closed = false, const char* fill = "none") {
    text_ += fmt::format("<path fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\" d=\"M", fill, colour, width);
    for (const Point p : points) text_ += fmt::format(" {:.2f},{:.2f}", p.x * scale_, (height_ - p.y) * scale_);
    text_ += closed ? " Z\"/>\n" : "\"/>\n";
  }
  void disc(Point p, const char* colour) {
    text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"{}\"/>\n", p.x * scale_, (height_ - p.y) * scale_, colour);
  }
  void save(const std::string& name) { std::ofstream(name) << text_ << "</svg>\n"; }

 private:
  double height_, scale_;
  std::string text_;
};

void draw_spiral(const std::string& folder) {
  const auto& den = testing::benchmarks()[1];
  // The shortest question on which the literal mode takes more than 30 times the optimum and Bug2 less than 6 times.
  for (const Scenario& row : den.scenarios) {
    if (row.optimum < 15.0) continue;
    const Problem problem = testing::problem_between(den.grid, row.start, row.goal);
    const Result literal = modified_bug(problem, {}, {.leave = LeaveRule::kLiteral});
    const Result guarded = modified_bug(problem, {}, {.hand = HandRule::kSmallerTurn});
    if (literal.length_m < 30.0 * row.optimum || guarded.length_m > 3.0 * row.optimum) continue;
    for (const auto& [result, name] : {std::pair(&literal, "literal"), std::pair(&guarded, "guarded")}) {
      Drawing drawing(den.grid.width(), den.grid.height(), 8.0);
      drawing.blocked(den.grid);
      drawing.line(result->path, "#c22", 1.0);
      drawing.disc(problem.start, "#080");
      drawing.disc(problem.goal, "#00c");
      drawing.save(folder + "/bug_" + name + ".svg");
    }
    fmt::print("\npictures: line {} of den312d: literal {:.1f}, guarded {:.1f} times the optimum\n", row.line,
               literal.length_m / row.optimum, guarded.length_m / row.optimum);
    return;
  }
}

void draw_genetic(const std::string& folder) {
  const auto& den = testing::benchmarks()[1];
  const Scenario& row = den.scenarios[den.scenarios.size() - 3];
  const Problem problem = testing::problem_between(den.grid, row.start, row.goal);
  Drawing drawing(den.grid.width(), den.grid.height(), 8.0);
  drawing.blocked(den.grid);
  drawing.line(evolve(problem, {}, {.max_generations = 0}).result.path, "#e90", 1.0);
  drawing.line(evolve(problem, {}, {.max_generations = 3}).result.path, "#393", 1.0);
  drawing.line(evolve(problem, {}).result.path, "#c22", 2.0);
  drawing.disc(problem.start, "#080");
  drawing.disc(problem.goal, "#00c");
  drawing.save(folder + "/genetic_path.svg");
}

void draw_rectangle(const std::string& folder) {
  constexpr Rectangle kRobot{1.0, 0.4};
  const Point shift{7.0, 2.5};
  ShapeClearance shapes;
  const std::vector<std::vector<Point>> walls = {{{0.0, 0.24}, {4.0, 0.24}, {4.0, 2.5}, {0.0, 2.5}},
                                                 {{0.0, -0.24}, {0.0, -2.5}, {4.0, -2.5}, {4.0, -0.24}}};
  Drawing drawing(14.0, 5.0, 60.0);
  for (const auto& wall : walls) {
    shapes.add_polygon(wall);
    std::vector<Point> shown;
    for (const Point p : wall) shown.push_back(p + shift);
    drawing.line(shown, "#777", 2.0, true, "#bbb");
  }
  PotentialParameters narrow;
  narrow.attraction = Attraction::kParabolic;
  narrow.zone_cells = 1.0;
  narrow.balance_cells = 0.2;
  narrow.least_cells = 0.01;
  RectangleDrive how;
  how.tolerance_m = 0.02;
  const RectangleField to_mouth(shapes, kRobot, {-1.0, 0.0}, 0.0, 0.1, narrow), through(shapes, kRobot, {6.0, 0.0}, 0.0, 0.1, narrow);
  Pose pose{{-6.0, 1.5}, 1.4};
  int shown = 0;
  for (const RectangleField* field : {&to_mouth, &through}) {
    const RectangleResult result = drive_rectangle(*field, pose, how, {});
    for (const Pose& at : result.poses) {
      if (shown++ % 12 != 0) continue;
      const auto points = control_points(kRobot, at);
      drawing.line({points[0] + shift, points[1] + shift, points[2] + shift, points[3] + shift}, "#c22", 1.0, true);
    }
    pose = result.poses.back();
  }
  drawing.save(folder + "/rectangle.svg");
}

}  // namespace
}  // namespace kb::planners

int main(int count, char** arguments) {
  using namespace kb::planners;
  if (count > 1) {
    draw_spiral(arguments[1]);
    draw_genetic(arguments[1]);
    draw_rectangle(arguments[1]);
    return 0;
  }
  bugs_on_maps();
  bugs_among_separate_obstacles();
  genetic_on_maps();
  genetic_among_patrols();
  fairway_and_bug();
  return 0;
}
