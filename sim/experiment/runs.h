// The runs of the experiment: which labyrinth, route, disturbance and method each is, and what came of it.
//
// note [what a run depends on]
// On the seed, its number, how many labyrinths there are and the maze: each labyrinth, each route and each case has a stream of
// random numbers of its own. Not on how many scenarios there are, nor on what ran before it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"
#include "sim/batch/ending.h"
#include "sim/experiment/cases.h"
#include "sim/experiment/town.h"

namespace kb::sim::experiment {

enum class Method : std::uint8_t { kMts, kProgrammed, kBug };
inline constexpr std::array<std::string_view, 3> kMethodNames{"mts", "programmed", "bug2"};

struct Setup {
  std::uint32_t scenarios = 1000;
  std::uint32_t labyrinths = 20;
  std::uint64_t seed = 1;
  const planners::Grid* maze = nullptr;   ///< every fourth labyrinth is a window of it
  std::string library;                    ///< folder of the standard library
};

/// What came of one run. Everything but the texts is what the judge saw, not what the robot believes.
struct Row : batch::Ending {
  std::uint32_t scenario = 0;
  Method method{};
  std::uint32_t labyrinth = 0, route = 0;
  Class what{};
  std::string kinds;                      ///< of disturbance: see Case
  double shortest_s = 0.0, shortest_m = 0.0;   ///< along the roads that are not closed for good: see extent_of
};

/// A line of CSV without its end, and back; nothing if it is no such line.
inline constexpr std::string_view kRowHeader =
    "scenario,method,labyrinth,route,class,kinds,outcome,reports,time_s,length_m,shortest_s,shortest_m,collisions,bans_broken,lost_unaware";
[[nodiscard]] std::string print(const Row& row);
[[nodiscard]] std::optional<Row> parse_row(std::string_view line);

/// Scenarios that share a labyrinth and a route: one knowledge base.
struct Group {
  std::uint32_t labyrinth = 0, route = 0;
  std::vector<std::uint32_t> scenarios;
};
[[nodiscard]] std::vector<Group> groups_of(const Setup& setup);

/// A labyrinth, as a map and as a floor to plan routes on.
struct Ground {
  Sketch sketch;
  Labyrinth floor;
};
/// The labyrinth of this number: the first that is drawn for it and has room. Throws std::runtime_error if there is none.
[[nodiscard]] Ground ground_of_number(const Setup& setup, std::uint32_t labyrinth, const source::FileSystem& files);

/// The labyrinths of a setup, each drawn and compiled once, when it is first asked for, by any thread. What it refers to must outlive it.
class Grounds {
 public:
  Grounds(const Setup& setup, const source::FileSystem& files);
  /// Throws as above; then the next who asks tries again.
  [[nodiscard]] const Ground& of(std::uint32_t labyrinth);

 private:
  struct Once {
    std::once_flag flag;
    std::optional<Ground> ground;
  };
  const Setup& setup_;
  const source::FileSystem& files_;
  std::deque<Once> all_;   // by number
};

/// Everything about one group: the knowledge base, and the case of each scenario.
class Prepared {
 public:
  /// `ground` is that of the group's labyrinth; it must outlive this, as routes point into it. Throws std::runtime_error if what was
  /// made up cannot be compiled or laid out: a bug of ours.
  Prepared(const Setup& setup, const Group& group, const Ground& ground, const source::FileSystem& files);
  [[nodiscard]] const std::string& mission() const { return town_->text(); }
  [[nodiscard]] Case case_of(std::uint32_t scenario) const;
  [[nodiscard]] Row drive(std::uint32_t scenario, Method method);
  [[nodiscard]] const RoutePlan& route() const { return route_; }

 private:
  const Setup& setup_;
  Group group_;
  const Labyrinth& floor_;
  RoutePlan route_;
  Labyrinth::End start_;
  std::optional<Town> town_;
};

struct RunControl {
  unsigned jobs = 1;
  std::function<bool(std::uint32_t scenario, Method method)> skip;   ///< was done before
  std::function<bool(const Row&)> take;    ///< each result, one at a time, in any order; false stops all
  std::function<bool()> go_on;             ///< asked before each run
};
/// All runs, on `jobs` threads. Rethrows what a thread threw.
void run_all(const Setup& setup, const source::FileSystem& files, const RunControl& control);

}  // namespace kb::sim::experiment
