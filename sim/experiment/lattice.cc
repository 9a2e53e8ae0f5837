#include "sim/experiment/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace kb::sim::experiment {
namespace {

constexpr char kSides[] = {'N', 'E', 'S', 'W'};

/// The side by which a walk that arrives going `going` leaves a node of two roads.
int onward(const Lattice& lattice, int node, int going) {
  for (int side = 0; side < 4; ++side) {
    if (side != (going + 2) % 4 && lattice.road(node, side)) return side;
  }
  return going;
}

}  // namespace

int Lattice::beside(int node, int side) const {
  const int column = node % columns_ + (side == 1 ? 1 : side == 3 ? -1 : 0);
  const int row = node / columns_ + (side == 0 ? 1 : side == 2 ? -1 : 0);
  return column >= 0 && row >= 0 && column < columns_ && row < rows_ ? this->node(column, row) : -1;
}

void Lattice::set_road(int node, int side, bool there) {
  const int other = beside(node, side);
  if (other < 0) return;
  roads_[static_cast<std::size_t>(node)][static_cast<std::size_t>(side)] = there;
  roads_[static_cast<std::size_t>(other)][static_cast<std::size_t>((side + 2) % 4)] = there;
}

int Lattice::degree(int node) const {
  const auto& sides = roads_[static_cast<std::size_t>(node)];
  return static_cast<int>(std::count(sides.begin(), sides.end(), true));
}

std::vector<int> Lattice::part_of(int node) const {
  std::vector<int> part{node};
  std::vector<bool> found(roads_.size(), false);
  found[static_cast<std::size_t>(node)] = true;
  for (std::size_t next = 0; next < part.size(); ++next) {
    for (int side = 0; side < 4; ++side) {
      const int other = road(part[next], side) ? beside(part[next], side) : -1;
      if (other < 0 || found[static_cast<std::size_t>(other)]) continue;
      found[static_cast<std::size_t>(other)] = true;
      part.push_back(other);
    }
  }
  std::sort(part.begin(), part.end());
  return part;
}

Sketch sketch_of(const Lattice& lattice, int hub, const SketchRules& rules, Random& random) {
  Sketch sketch;
  std::map<int, std::size_t> landmarks;
  for (const int node : lattice.part_of(hub)) {
    const auto n = static_cast<std::size_t>(node);
    if (rules.plain[n] && lattice.degree(node) == 2) continue;
    landmarks[node] = sketch.landmarks.size();
    sketch.landmarks.push_back({fmt::format("L{}", sketch.landmarks.size() + 1), rules.place[n]});
  }
  std::map<std::pair<int, int>, bool> done;   // by node and side
  for (const auto& [node, from] : landmarks) {
    for (int side = 0; side < 4; ++side) {
      if (!lattice.road(node, side) || done[{node, side}]) continue;
      Sketch::Road road;
      road.from = from;
      road.exit = kSides[side];
      int at = lattice.beside(node, side), going = side;
      while (!landmarks.contains(at)) {   // on through nodes without a landmark
        if (!lattice.straight(at)) road.through.push_back(rules.place[static_cast<std::size_t>(at)]);
        going = onward(lattice, at, going);
        at = lattice.beside(at, going);
      }
      const int arrival = (going + 2) % 4;
      done[{node, side}] = done[{at, arrival}] = true;
      road.to = landmarks[at];
      road.approach = kSides[arrival];
      road.method = rules.methods[random.next() % rules.methods.size()];
      sketch.roads.push_back(std::move(road));
    }
  }
  return sketch;
}

}  // namespace kb::sim::experiment
