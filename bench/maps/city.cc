// A city: a grid of streets, thinned to the wanted number of roads round a random spanning tree.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bench/maps/dice.h"
#include "bench/maps/road_map.h"

namespace kb::bench {
namespace {

constexpr double kRoadsOfALandmark = 1.4;   ///< roads to landmarks, before bends are made
constexpr float kBends = 0.3f;              ///< of the landmarks with two roads, so many become mere bends or straights

/// Which landmarks are joined so far; paths are halved as they are walked.
class Parts {
 public:
  explicit Parts(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  /// False if they were joined already.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
};

class CityMaker {
 public:
  CityMaker(std::uint32_t roads, std::uint64_t seed) : wanted_(std::max(roads, kFewestRoads)), dice_(seed) {}

  RoadMap make() {
    map_.name = "City";
    lay_out();
    pave();
    smooth();
    // What the bends have used up comes back as roads between what is left.
    for (; count_ < wanted_ && next_ < spare_.size(); ++next_) add(spare_[next_]);
    return compact();
  }

 private:
  struct Link { std::uint32_t from = 0; bool north = false; };   ///< to the neighbour in the north, or in the east

  void lay_out() {
    const auto landmarks = static_cast<std::uint32_t>(wanted_ / kRoadsOfALandmark);
    width_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(landmarks)));
    const std::uint32_t height = (landmarks + width_ - 1) / width_;
    const std::vector<double> xs = places(width_), ys = places(height);
    for (std::uint32_t i = 0; i < landmarks; ++i) map_.landmarks.push_back({'J', {xs[i % width_], ys[i / width_]}});
    for (std::uint32_t i = 0; i < width_ + height; ++i) street_.push_back(dice_.pick({6, 3, 1}));
  }

  /// Streets 2 to 4 metres apart, in steps of a decimetre.
  std::vector<double> places(std::uint32_t n) {
    std::vector<double> at;
    std::uint32_t decimetres = 0;
    for (std::uint32_t i = 0; i < n; ++i, decimetres += 20 + dice_.below(21)) at.push_back(decimetres / 10.0);
    return at;
  }

  [[nodiscard]] std::uint32_t target(Link link) const { return link.north ? link.from + width_ : link.from + 1; }

  /// A tree that reaches every landmark, then links at random until there are enough roads.
  void pave() {
    const auto n = static_cast<std::uint32_t>(map_.landmarks.size());
    std::vector<Link> links;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (i + width_ < n) links.push_back({i, true});
      if ((i + 1) % width_ != 0 && i + 1 < n) links.push_back({i, false});
    }
    dice_.shuffle(links);
    Parts parts(n);
    for (const Link link : links) {
      if (parts.join(link.from, target(link))) add(link);
      else spare_.push_back(link);
    }
    for (; count_ < wanted_ && next_ < spare_.size(); ++next_) add(spare_[next_]);
  }

  void add(Link link) {
    const End a{link.from, link.north ? Side::kN : Side::kE};
    const End b{target(link), opposite(a.side)};
    if (gone(a.landmark) || gone(b.landmark) || beside(a.landmark, b.landmark)) return;
    const std::uint32_t street = link.north ? link.from % width_ : width_ + link.from / width_;
    put(static_cast<std::uint32_t>(map_.roads.size()), {a, b, static_cast<Method>(street_[street]), {}});
    ++count_;
  }

  void put(std::uint32_t id, Road road) {
    if (id == map_.roads.size()) map_.roads.push_back(road);
    else map_.roads[id] = road;
    for (const End& end : {road.a, road.b}) map_.landmarks[end.landmark].road[static_cast<std::size_t>(end.side)] = id;
  }

  [[nodiscard]] bool gone(std::uint32_t landmark) const { return map_.landmarks[landmark].letter == 0; }
  [[nodiscard]] std::vector<Side> sides(std::uint32_t landmark) const {
    std::vector<Side> out;
    for (unsigned s = 0; s < 4; ++s) {
      if (map_.landmarks[landmark].road[s] != kNoRoad) out.push_back(static_cast<Side>(s));
    }
    return out;
  }
  [[nodiscard]] bool beside(std::uint32_t a, std::uint32_t b) const {
    const auto all = sides(a);
    return std::any_of(all.begin(), all.end(), [&](Side side) { return map_.across({a, side}).landmark == b; });
  }

  /// Some landmarks with two roads vanish: their roads become one, with a bend where they met at a corner. Each takes a road,
  /// and two links that could have replaced it; so there are only so many.
  void smooth() {
    std::size_t left = (spare_.size() - next_) / 4;
    for (std::uint32_t i = 0; i < map_.landmarks.size() && left > 0; ++i) {
      const auto open = sides(i);
      if (open.size() != 2 || !dice_.chance(kBends)) continue;
      const End a = map_.across({i, open[0]}), b = map_.across({i, open[1]});
      const auto& own = map_.landmarks[i].road;
      const std::uint32_t first = own[static_cast<std::size_t>(open[0])], second = own[static_cast<std::size_t>(open[1])];
      if (a.landmark == b.landmark || beside(a.landmark, b.landmark)) continue;
      if (map_.roads[first].bend || map_.roads[second].bend) continue;
      Road joined{a, b, map_.roads[first].by, {}};
      if (open[1] != opposite(open[0])) joined.bend = map_.landmarks[i].at;
      map_.landmarks[i].letter = 0;
      map_.roads[second].a = map_.roads[second].b;   // gone
      put(first, joined);
      --count_;
      --left;
    }
  }

  /// Without what is gone, the roads by the landmarks where they begin.
  RoadMap compact() const {
    RoadMap out{map_.name, {}, {}};
    std::vector<std::uint32_t> number(map_.landmarks.size(), kNoRoad);
    for (std::uint32_t i = 0; i < map_.landmarks.size(); ++i) {
      if (gone(i)) continue;
      number[i] = static_cast<std::uint32_t>(out.landmarks.size());
      out.landmarks.push_back({map_.landmarks[i].letter, map_.landmarks[i].at});
    }
    std::vector<Road> roads = map_.roads;
    std::sort(roads.begin(), roads.end(), [](const Road& x, const Road& y) {
      return std::pair(x.a.landmark, x.a.side) < std::pair(y.a.landmark, y.a.side);
    });
    for (Road& road : roads) {
      if (road.a.landmark == road.b.landmark) continue;
      for (End* end : {&road.a, &road.b}) {
        end->landmark = number[end->landmark];
        out.landmarks[end->landmark].road[static_cast<std::size_t>(end->side)] = static_cast<std::uint32_t>(out.roads.size());
      }
      out.roads.push_back(road);
    }
    return out;
  }

  std::uint32_t wanted_;
  Dice dice_;
  RoadMap map_;
  std::uint32_t width_ = 0;
  std::uint32_t count_ = 0;           ///< roads that are there
  std::vector<std::uint32_t> street_; ///< methods: of the columns, then of the rows
  std::vector<Link> spare_;           ///< links outside of the tree, in random order
  std::size_t next_ = 0;              ///< the first of them that was not tried yet
};

}  // namespace

RoadMap make_city(std::uint32_t roads, std::uint64_t seed) { return CityMaker(roads, seed).make(); }

}  // namespace kb::bench
