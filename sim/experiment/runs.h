// The runs of the experiment: the labyrinth, route, disturbance and method of each, and its result.
//
// note [what a run depends on]
// A run depends on the seed, its number, the number of labyrinths and the maze: each labyrinth, route and case has its own stream of
// random numbers. It does not depend on the number of scenarios, nor on earlier runs.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"
#include "sim/batch/ending.h"
#include "sim/experiment/cases.h"
#include "sim/experiment/town.h"
#include "sim/scenario/setting.h"

namespace kb::sim::experiment {

/// A way to drive.
struct Method {
  enum class Control : std::uint8_t { kMind, kProgrammed, kBug } control{};
  std::string name;                       ///< as in the rows: no comma
  std::string mind;                       ///< kMind: the file whose rules drive; empty: the experiment's own rules
};
/// `mts`, `programmed`, `bug2`.
[[nodiscard]] const std::vector<Method>& built_in_methods();

struct Setup {
  std::uint32_t scenarios = 1000;
  std::uint32_t labyrinths = 20;
  std::uint64_t seed = 1;
  const planners::Grid* maze = nullptr;   ///< if not null, every fourth labyrinth is a window of it
  std::string library;                    ///< folder of the standard library
  std::vector<Method> methods = built_in_methods();
  Combinations set{{}};                   ///< each method drives each scenario with each of these; never empty
};

/// The result of one run. Everything except the texts is what the judge saw, not what the robot believes.
struct Row : batch::Ending {
  std::uint32_t scenario = 0;
  std::string method;                     ///< its name
  std::size_t set = 0;                    ///< index into Setup::set
  std::uint32_t labyrinth = 0, route = 0;
  Class what{};
  std::string kinds;                      ///< of disturbance: see Case
  std::uint64_t noise = 0;                ///< the seed of all noise: see Case
  double shortest_s = 0.0, shortest_m = 0.0;   ///< along the roads that are not closed for good: see extent_of
};

/// Orders rows by method (built-in ones first, then by name), then by what is set; nothing else counts.
[[nodiscard]] bool way_before(const Row& a, const Row& b);
/// Orders rows by scenario, then as above.
[[nodiscard]] inline bool before(const Row& a, const Row& b) { return a.scenario != b.scenario ? a.scenario < b.scenario : way_before(a, b); }

/// The header, a row as a line of CSV without line break, and a line read back; nothing if it is not as `print` writes it, or no run of this
/// setup can have led to it. Rows of any method are taken.
[[nodiscard]] std::string row_header(const Combinations& set);
[[nodiscard]] std::string print(const Row& row, const Combinations& set);
[[nodiscard]] std::optional<Row> parse_row(std::string_view line, const Setup& setup);

/// The robot's size by the settings; 1 if they do not set it.
[[nodiscard]] float size_of(const std::vector<Setting>& settings);

/// Scenarios that share a labyrinth and a route: one knowledge base.
struct Group {
  std::uint32_t labyrinth = 0, route = 0;
  std::vector<std::uint32_t> scenarios;
};
[[nodiscard]] std::vector<Group> groups_of(const Setup& setup);
/// What a scenario's number alone says of it.
struct Place { std::uint32_t labyrinth = 0, route = 0; Class what{}; };
[[nodiscard]] Place place_of(const Setup& setup, std::uint32_t scenario);

/// A drive may take kPatience seconds and kTimes the shortest time.
inline constexpr double kPatience = 300.0, kTimes = 4.0;

/// A labyrinth, as a map and as a floor to plan routes on.
struct Ground {
  Sketch sketch;
  Labyrinth floor;
};
/// Whether the labyrinth of this number is a window of the maze.
[[nodiscard]] inline bool in_maze(const Setup& setup, std::uint32_t labyrinth) { return setup.maze != nullptr && labyrinth % 4 == 3; }
/// Thrown if no window of the maze is a labyrinth.
struct MazeFails : std::runtime_error {
  MazeFails() : std::runtime_error("no window of the maze has enough junctions") {}
};
/// The labyrinth of this number: the first that is drawn for it and has room. Throws MazeFails.
[[nodiscard]] Ground ground_of_number(const Setup& setup, std::uint32_t labyrinth, const source::FileSystem& files);

/// The labyrinths of a setup, each drawn and compiled once, when it is first asked for, by any thread. The setup and the file system must
/// outlive it.
class Grounds {
 public:
  Grounds(const Setup& setup, const source::FileSystem& files);
  /// Throws as above; the next call then tries again.
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
  /// `ground` is that of the group's labyrinth; it must outlive this, as routes point into it. Throws std::runtime_error if
  /// the generated text cannot be compiled or laid out, which is a bug of the experiment.
  Prepared(const Setup& setup, const Group& group, const Ground& ground, const source::FileSystem& files);
  /// The text of `mission.kb`, which drives by the rules of the file `mind`, given relative to its own folder.
  [[nodiscard]] std::string mission(const std::string& mind = {}, float size = 1.0f) const;
  [[nodiscard]] Case case_of(std::uint32_t scenario, float size = 1.0f) const;
  /// The text of `scenario.toml`, settings included: with it `kbc sim` drives the mission as `drive` does. For a robot of another size than 1 it
  /// also needs the `--scale` that the first line, a comment, tells.
  [[nodiscard]] std::string scenario_text(std::uint32_t scenario, const std::vector<Setting>& settings) const;
  /// `set`: index into Setup::set. Throws MindFails.
  [[nodiscard]] Row drive(std::uint32_t scenario, const Method& method, std::size_t set = 0);
  [[nodiscard]] const RoutePlan& route() const { return route_; }

 private:
  [[nodiscard]] Town& town_of(const std::string& mind, float size, std::uint32_t scenario);
  const Setup& setup_;
  const source::FileSystem& files_;
  Group group_;
  const Ground& ground_;
  const Labyrinth& floor_;
  RoutePlan route_;
  Labyrinth::End start_;
  std::map<std::pair<std::string, float>, Town> towns_;   // by mind and size
};

/// Thrown if a user's rules do not fit a mission of the experiment.
struct MindFails : std::runtime_error {
  MindFails(std::string file, std::uint32_t in, const std::string& messages) : std::runtime_error(messages), mind(std::move(file)), scenario(in) {}
  std::string mind;
  std::uint32_t scenario;
};

struct RunControl {
  unsigned jobs = 1;
  /// Whether the run was done before. `method` and `set` are indexes.
  std::function<bool(std::uint32_t scenario, std::size_t method, std::size_t set)> skip;
  std::function<bool(const Row&)> take;    ///< gets each result, one at a time, in any order; false stops all runs
  std::function<bool()> go_on;             ///< asked before each run
};
/// All runs, on `jobs` threads. Throws MindFails; rethrows what a thread threw.
void run_all(const Setup& setup, const source::FileSystem& files, const RunControl& control);

}  // namespace kb::sim::experiment
