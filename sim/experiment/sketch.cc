#include "sim/experiment/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/experiment/lattice.h"
#include "sim/world/geometry.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kLeastLandmarks = 5;

/// A grid of which a share of the roads is taken away, each only if the rest stays connected.
Lattice thinned_grid(const GridForm& form, Random& random) {
  Lattice lattice(form.columns, form.rows);
  std::vector<std::pair<int, int>> roads;
  for (int node = 0; node < lattice.size(); ++node) {
    for (const int side : {0, 1}) {
      if (lattice.beside(node, side) < 0) continue;
      lattice.set_road(node, side, true);
      roads.emplace_back(node, side);
    }
  }
  for (std::size_t i = roads.size(); i > 1; --i) std::swap(roads[i - 1], roads[random.next() % i]);
  auto surplus = static_cast<std::size_t>((1.0 - form.roads) * static_cast<double>(roads.size()));
  for (const auto& [node, side] : roads) {
    if (surplus == 0) break;
    lattice.set_road(node, side, false);
    if (lattice.part_of(0).size() == static_cast<std::size_t>(lattice.size())) --surplus;
    else lattice.set_road(node, side, true);
  }
  return lattice;
}

std::string number(double metres) { return fmt::format("{:g}", std::round(metres * 100.0) / 100.0 + 0.0); }

}  // namespace

Sketch sketch_of_grid(const GridForm& form, Random& random) {
  for (;;) {
    const Lattice lattice = thinned_grid(form, random);
    SketchRules rules;
    rules.methods = {"mark", "mark", "dist", "azimuth"};
    for (int node = 0; node < lattice.size(); ++node) {
      rules.plain.push_back(random.chance(static_cast<float>(form.bends)));
      const auto aside = [&] { return form.slant_m * static_cast<double>(random.signed_unit()); };
      const double x_m = node % form.columns + aside(), y_m = node / form.columns + aside();
      rules.place.push_back({x_m, y_m});
    }
    int hub = 0;
    for (int node = 1; node < lattice.size(); ++node) {
      if (lattice.degree(node) > lattice.degree(hub)) hub = node;
    }
    Sketch sketch = sketch_of(lattice, hub, rules, random);
    const bool ring = std::any_of(sketch.roads.begin(), sketch.roads.end(), [](const auto& road) { return road.from == road.to; });
    if (ring || sketch.landmarks.size() < kLeastLandmarks) continue;
    sketch.origin = fmt::format("grid {} x {}{}", form.columns, form.rows, form.slant_m > 0.0 ? ", slanted" : "");
    return sketch;
  }
}

std::string print(const Sketch& sketch) {
  std::string text = "map Town {\n";
  for (const auto& landmark : sketch.landmarks) {
    text += fmt::format("    landmark {} at ({}, {})\n", landmark.name, number(landmark.at.x_m), number(landmark.at.y_m));
  }
  for (const auto& road : sketch.roads) {
    text += fmt::format("    road {}.{} -- {}.{} by {}", sketch.landmarks[road.from].name, road.exit, sketch.landmarks[road.to].name, road.approach, road.method);
    for (std::size_t i = 0; i < road.through.size(); ++i) {
      text += fmt::format("{}({}, {})", i == 0 ? " through " : ", ", number(road.through[i].x_m), number(road.through[i].y_m));
    }
    text += "\n";
  }
  return text + "}\n";
}

}  // namespace kb::sim::experiment
