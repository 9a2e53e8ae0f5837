// Makes the roads of a map from the ways that can be driven: ways on the same ground are one road, and each end of a road gets a side.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>

#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

// note [sides of roads]
// Each road of a landmark leaves it by another of its eight sides. The n ends of roads at a landmark are sorted clockwise by direction, or,
// if that is the same, by where they part later; they get n sides in the same clockwise order, so that what is to the left of a robot stays
// to its left. Of these choices, (8 over n) * n at most, the one with the least sum of squared differences between direction and side is
// taken; of several, the first.

constexpr double kFarthest_m = 1e8;
constexpr double kSameBearing = 1e-6;   // sides

bool is_far(Point p) { return !(std::abs(p.x_m) <= kFarthest_m && std::abs(p.y_m) <= kFarthest_m); }

struct End {
  std::vector<Point> chain;   // from the landmark
  double bearing;          // in sides, clockwise from the north
  std::uint32_t* side;     // where its side is to be written
};

double bearing_of(Point from, Point to) {
  const double turns = std::atan2(to.x_m - from.x_m, to.y_m - from.y_m) / (2.0 * std::numbers::pi);
  const double sides = (turns < 0.0 ? turns + 1.0 : turns) * kSideCount;
  return sides < kSideCount - kSameBearing ? sides : 0.0;
}

void give_sides(std::vector<End>& ends) {
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::abs(a.bearing - b.bearing) > kSameBearing ? a.bearing < b.bearing : parts_to_the_left(a.chain, b.chain);
  });
  const auto n = static_cast<std::uint32_t>(ends.size());
  double least = 1e9;
  for (std::uint32_t used = 0; used < 1u << kSideCount; ++used) {
    if (std::popcount(used) != static_cast<int>(n)) continue;
    std::uint32_t sides[kSideCount], count = 0;
    for (std::uint32_t s = 0; s < kSideCount; ++s) {
      if ((used >> s & 1u) != 0) sides[count++] = s;
    }
    for (std::uint32_t first = 0; first < n; ++first) {
      double sum = 0.0;
      for (std::uint32_t i = 0; i < n; ++i) {
        const double d = sides_apart(ends[i].bearing, sides[(first + i) % n]);
        sum += d * d;
      }
      if (sum >= least - 1e-9) continue;
      least = sum;
      for (std::uint32_t i = 0; i < n; ++i) *ends[i].side = sides[(first + i) % n];
    }
  }
}

class RoadMaker {
 public:
  RoadMaker(const Layout& layout, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics)
      : layout_(layout), index_(layout.places), adaptations_(adaptations), diagnostics_(diagnostics) {}

  std::optional<std::vector<Road>> run() {
    for (const Place& place : layout_.places) {
      if (is_far(place.at)) diagnostics_.report(Kind::kLayoutFar, place.span, {place.id});
      check_once(place, place.id);
      for (const std::string& id : place.also) check_once(place, id);
    }
    for (const Way& way : layout_.ways) add(way);
    if (diagnostics_.failed()) return std::nullopt;
    give_all_sides();
    if (diagnostics_.failed()) return std::nullopt;
    return std::move(roads_);
  }

 private:
  void check_once(const Place& place, const std::string& id) {
    const Place* first = index_.find(id);
    if (first != &place) diagnostics_.report(Kind::kLayoutTwice, place.span, {id}).note(Kind::kFirstDeclaredHere, first->span);
  }

  void add(const Way& way) {
    const auto from = find(way.from, way.from_span), to = find(way.to, way.to_span);
    if (!from || !to) return;
    if (std::any_of(way.through.begin(), way.through.end(), is_far)) diagnostics_.report(Kind::kLayoutFar, way.from_span, {way.id});
    if (*from == *to) return adaptations_.note("way that ends where it begins: left out", way.from_span);
    const std::vector<Point> there = course_of(layout_, *from, way.through, *to);
    std::vector<std::uint32_t>& known = between_[std::minmax(*from, *to)];
    for (const std::uint32_t r : known) {
      Road& road = roads_[r];
      if (!lies_on(layout_, road, *from, there)) continue;
      road.both = road.both || road.from != *from;
      road.marked = road.marked || way.marked;
      limit(road, way);
      return;
    }
    if (known.size() > kSideCount) return;   // more roads than a landmark has sides: that will be reported
    known.push_back(static_cast<std::uint32_t>(roads_.size()));
    roads_.push_back({*from, *to, false, way.through, way.marked, 0, 0, way.limit_m_s});
  }

  void limit(Road& road, const Way& way) {
    if (road.limit_m_s == way.limit_m_s) return;
    adaptations_.note("ways on the same ground with different speed limits: the lowest", way.from_span);
    road.limit_m_s = lower_limit(road.limit_m_s, way.limit_m_s);
  }

  std::optional<std::uint32_t> find(const std::string& id, source::Span span) {
    if (const Place* place = index_.find(id)) return static_cast<std::uint32_t>(place - layout_.places.data());
    diagnostics_.report(Kind::kLayoutUnknownPlace, span, {id});
    return std::nullopt;
  }

  void give_all_sides() {
    std::vector<std::vector<End>> ends(layout_.places.size());
    for (Road& road : roads_) {
      std::vector<Point> there = course_of(layout_, road), back = reversed(there);
      const double exit = bearing_of(there[0], there[1]), approach = bearing_of(back[0], back[1]);
      ends[road.from].push_back({std::move(there), exit, &road.exit});
      ends[road.to].push_back({std::move(back), approach, &road.approach});
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const Place& place = layout_.places[i];
      if (ends[i].size() <= kSideCount) give_sides(ends[i]);
      else diagnostics_.report(Kind::kLayoutManyRoads, place.span, {place.id});
    }
  }

  const Layout& layout_;
  PlaceIndex index_;
  Adaptations& adaptations_;
  diagnostics::Diagnostics& diagnostics_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> between_;   // indexes of roads, by the places of their two ends
  std::vector<Road> roads_;
};

}  // namespace

void Adaptations::note(std::string_view what, source::Span at) {
  const auto [found, is_new] = index_.try_emplace(std::string(what), all_.size());
  if (is_new) all_.push_back({found->first, at, 0});
  ++all_[found->second].times;
}

void Adaptations::report(diagnostics::Diagnostics& diagnostics) const {
  for (const One& one : all_) {
    diagnostics.report(Kind::kLayoutAdapted, one.first, {one.what, one.times == 1 ? "once" : fmt::format("{} times", one.times)});
  }
}

std::optional<std::vector<Road>> roads_of(const Layout& layout, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics) {
  return RoadMaker(layout, adaptations, diagnostics).run();
}

}  // namespace kb::layout
