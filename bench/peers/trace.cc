#include "bench/peers/trace.h"

#include <array>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>

namespace peers {
namespace {

using paper::Fact;

constexpr std::size_t kFactCount = paper::Knowledge::kShape.facts;
constexpr std::array kMissions{
    "02_an_obstacle_inside_a_crossing_without_end_is_reported", "03_the_marking_is_lost_and_found",
    "05_abort_inside_a_crossing_is_the_state_of_start_up", "06_a_command_during_a_mission_is_ignored",
    "07_an_unknown_place_is_never_crossed_blindly", "08_of_two_landmarks_that_look_alike_the_awaited_one_counts",
    "09_a_later_landmark_in_view_moves_nothing"};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') fields.emplace_back();
    else fields.back() += c;
  }
  return fields;
}

/// What the disturbances of this fact are like: how often one begins, and which values it may take.
struct Weakness { double rate; std::vector<float> values; };

Weakness weakness(Fact fact) {
  if (fact >= Fact::In_N && fact <= Fact::In_W) return {0.0, {}};            // exclusive: the sensors promise it
  if (fact >= Fact::MoveBy_mark && fact <= Fact::MoveBy_azimuth) return {0.0, {}};
  if (fact >= Fact::LM1 && fact <= Fact::LM15) return {0.001, {0.9f, 0.6f, 0.6f, -0.9f}};
  if (fact == Fact::Abort) return {0.0002, {1.0f}};
  if (fact == Fact::Start1) return {0.004, {1.0f}};
  if (fact == Fact::Safe) return {0.01, {1.0f, 1.0f, -1.0f, 0.0f}};
  if (fact >= Fact::Closed_N && fact <= Fact::Closed_W) return {0.001, {1.0f}};
  return {0.004, {0.9f, 0.6f, 0.0f, -0.9f}};
}

}  // namespace

Trace read_trace(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<std::string, Fact> facts;
  for (std::uint32_t f = 0; f < kFactCount; ++f) facts[paper::name(static_cast<Fact>(f))] = static_cast<Fact>(f);
  Trace trace{path, {}};
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = split(line);
  std::vector<float> last(columns.size(), 0.0f);
  for (double before = 0.0; std::getline(file, line);) {
    const std::vector<std::string> fields = split(line);
    const double now = std::stod(fields.at(0));
    Step step{{}, static_cast<std::uint32_t>((now - before) * 1e6 + 0.5)};
    before = now;
    for (std::size_t i = 1; i < columns.size(); ++i) {
      const float value = fields.at(i).empty() ? 0.0f : std::stof(fields[i]);
      const auto fact = facts.find(columns[i]);
      if (value == last[i] || fact == facts.end()) continue;
      step.changes.push_back({fact->second, value});
      last[i] = value;
    }
    trace.steps.push_back(std::move(step));
  }
  return trace;
}

Trace disturbed(const Trace& trace, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&random](std::uint64_t n) { return static_cast<std::size_t>(random() % n); };
  const auto happens = [&random](double p) { return static_cast<double>(random() >> 11) * 0x1p-53 < p; };
  Trace out{trace.name + ", disturbed " + std::to_string(seed), {}};
  std::array<float, kFactCount> real{}, given{};
  std::array<int, kFactCount> ticks_left{};
  for (const Step& step : trace.steps) {
    Step made{{}, step.dt_us};
    for (const Change& change : step.changes) real[static_cast<std::size_t>(change.fact)] = change.value;
    for (std::size_t f = 0; f < kFactCount; ++f) {
      const Weakness w = weakness(static_cast<Fact>(f));
      float value = real[f];
      if (ticks_left[f] > 0) {
        --ticks_left[f];
        value = given[f];
      } else if (happens(w.rate)) {
        ticks_left[f] = static_cast<int>(below(8));
        value = w.values[below(w.values.size())];
      }
      if (value != given[f]) made.changes.push_back({static_cast<Fact>(f), value});
      given[f] = value;
    }
    out.steps.push_back(std::move(made));
  }
  return out;
}

std::vector<Trace> all_traces(const std::string& sources, int disturbances) {
  std::vector<Trace> traces{read_trace(sources + "/examples/01_route1/mission.facts.csv")};
  traces.back().name = "Table 1";
  for (const char* mission : kMissions) {
    traces.push_back(read_trace(sources + "/tests/golden/traces/" + mission + "/mission.facts.csv"));
    traces.back().name = mission;
  }
  const std::size_t recorded = traces.size();
  for (int seed = 1; seed <= disturbances; ++seed) {
    for (std::size_t i = 0; i < recorded; ++i) traces.push_back(disturbed(traces[i], static_cast<std::uint64_t>(seed)));
  }
  return traces;
}

}  // namespace peers
