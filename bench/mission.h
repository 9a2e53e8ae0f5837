// A recorded mission of Route1 as changes of facts, for benchmarks.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "route1.kb.h"

namespace bench {

struct Change { route1::Fact fact; float value; };
struct Step { std::vector<Change> changes; std::uint32_t dt_us; };

/// A step for each tick, ten a second. `path`: what the sensors of a robot said that drove in closed loop.
inline std::vector<Step> read_mission(const std::string& path) {
  std::map<std::string, route1::Fact> facts;
  for (std::uint32_t f = 0; f < route1::Knowledge::kShape.facts; ++f) {
    facts[route1::name(static_cast<route1::Fact>(f))] = static_cast<route1::Fact>(f);
  }
  std::ifstream file(path);
  std::vector<route1::Fact> columns;
  std::vector<std::string> last;
  std::vector<Step> steps;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',') fields.emplace_back();
      else fields.back() += c;
    }
    if (columns.empty()) {
      columns.push_back(route1::Fact{});  // t
      for (std::size_t i = 1; i < fields.size(); ++i) columns.push_back(facts.at(fields[i]));
      last.resize(fields.size());
      continue;
    }
    Step step{{}, 100'000};
    for (std::size_t i = 1; i < fields.size(); ++i) {
      if (fields[i] == last[i]) continue;
      step.changes.push_back({columns[i], fields[i].empty() ? 0.0f : std::stof(fields[i])});
      last[i] = fields[i];
    }
    steps.push_back(std::move(step));
  }
  if (steps.empty()) std::abort();
  return steps;
}

}  // namespace bench
