#include "tests/world/facts.h"

#include <algorithm>
#include <string>

namespace kb::world {

FactMap::FactMap(const Knowledge& knowledge, const Map& map) : knowledge_(knowledge) {
  const auto add = [&](const std::string& name) { cells_.push_back(knowledge.find(name)); };
  const auto add_all = [&](const std::string& group, const auto& members) {
    for (const std::string_view member : members) add(group + "." + std::string(member));
  };
  for (const Landmark& landmark : map.landmarks) add(landmark.name);
  for (const char* name : {"Line", "Obst", "Turned", "Safe"}) add(name);
  add_all("In", kDirectionNames);
  add_all("Closed", kDirectionNames);
  add_all("Track", kMethodNames);
  add_all("CrossBy", kMethodNames);
  add_all("MoveBy", kMethodNames);
  values_.resize(knowledge.program().facts);
}

std::span<const float> FactMap::facts(const Readings& now) {
  std::fill(values_.begin(), values_.end(), 0.0f);
  const auto put = [&](program::CellId cell, float value) {
    if (cell != program::CellId::kNone) values_[program::index(cell)] = value;
  };
  std::size_t next = 0;
  now.each([&](float value, bool) { put(cells_[next++], value); });
  for (const auto& [name, value] : now.host) put(knowledge_.cell(name), value);
  return values_;
}

}  // namespace kb::world
