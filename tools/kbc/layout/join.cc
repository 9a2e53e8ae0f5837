// Makes places at one spot one place, and splits ways that run over a place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {
namespace {

// note [ways over places]
// Beside ways from A to B and from B to C a route graph may have one from A to C over B, for vehicles that do not stop at B. But a robot
// that reads signs reads B's in any case, and a map cannot have two roads on the same ground. So the way is split at B into two, of which
// the second continues the first (Way::goes_on). Pieces that coincide with other ways become one road with them.

/// Finds the places in a rectangle. O(log places + places in its row or in its column, whichever are fewer).
class Ground {
 public:
  explicit Ground(const std::vector<Place>& places) {
    for (const Place& place : places) by_x_.push_back(&place);
    by_y_ = by_x_;
    std::stable_sort(by_x_.begin(), by_x_.end(), [](const Place* a, const Place* b) { return a->at.x_m < b->at.x_m; });
    std::stable_sort(by_y_.begin(), by_y_.end(), [](const Place* a, const Place* b) { return a->at.y_m < b->at.y_m; });
  }

  [[nodiscard]] std::vector<const Place*> within(Point low, Point high) const {
    const auto columns = strip(by_x_, &Point::x_m, low, high), rows = strip(by_y_, &Point::y_m, low, high);
    std::vector<const Place*> found;
    for (const Place* place : columns.size() < rows.size() ? columns : rows) {
      const Point at = place->at;
      if (at.x_m >= low.x_m && at.x_m <= high.x_m && at.y_m >= low.y_m && at.y_m <= high.y_m) found.push_back(place);
    }
    return found;
  }

 private:
  static std::span<const Place* const> strip(const std::vector<const Place*>& sorted, double Point::*along, Point low, Point high) {
    const auto first = std::partition_point(sorted.begin(), sorted.end(), [&](const Place* p) { return p->at.*along < low.*along; });
    const auto last = std::partition_point(first, sorted.end(), [&](const Place* p) { return p->at.*along <= high.*along; });
    return {first, last};
  }
  std::vector<const Place*> by_x_, by_y_;   // can be sorted: no coordinate is NaN, as readers accept numbers only
};

constexpr std::size_t kMostCuts = 300'000;   // over all ways: a file of some kilobytes could ask for billions

/// Where a way runs over a place: on which piece, at what share of its length, and how far beside the middle of the place.
struct Cut {
  std::size_t piece;
  double share, off_m;
  const Place* place;
  friend bool operator<(const Cut& a, const Cut& b) { return std::pair(a.piece, a.share) < std::pair(b.piece, b.share); }
};

/// Appends the places that a piece of a way runs over, including those at its ends.
void look_below(const std::vector<Point>& chain, std::size_t piece, const Ground& ground, std::vector<Cut>& cuts) {
  const Point a = chain[piece], b = chain[piece + 1];
  const Point low{std::min(a.x_m, b.x_m) - kOver_m, std::min(a.y_m, b.y_m) - kOver_m};
  const Point high{std::max(a.x_m, b.x_m) + kOver_m, std::max(a.y_m, b.y_m) + kOver_m};
  for (const Place* place : ground.within(low, high)) {
    const Near near = nearest(place->at, a, b);
    if (near.distance_m <= kOver_m) cuts.push_back({piece, near.share, near.distance_m, place});
  }
}

/// Where a way comes to places other than those at which it begins and ends, in order. It may come to a place several times; each time, the
/// point nearest to the place counts.
class Cuts {
 public:
  Cuts(const std::vector<Point>& chain, const Ground& ground) : chain_(chain) {
    for (std::size_t piece = 0; piece + 1 < chain.size() && !too_many(); ++piece) look_below(chain, piece, ground, all_);
    std::stable_sort(all_.begin(), all_.end());
  }
  [[nodiscard]] bool too_many() const { return all_.size() > kMostCuts; }

  [[nodiscard]] std::vector<Cut> run() {
    std::vector<Cut> visits;
    for (const Cut& cut : all_) {
      const auto [there, is_new] = there_since_.try_emplace(cut.place, Visit{});
      Visit& last = there->second;
      const bool same = stays(*cut.place, last.since, cut.piece + 1);   // it has not left the place in between, so it does not come to it again
      last.since = cut.piece + 1;
      if (same && last.index < visits.size() && cut.off_m < visits[last.index].off_m) visits[last.index] = cut;
      if (same || ends_there(cut)) continue;
      last.index = visits.size();
      visits.push_back(cut);
    }
    std::stable_sort(visits.begin(), visits.end());
    return visits;
  }

 private:
  /// Whether the points [from, to) of the way are all at the place.
  [[nodiscard]] bool stays(const Place& place, std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i < to; ++i) {
      if (distance(chain_[i], place.at) > kOver_m) return false;
    }
    return true;
  }
  [[nodiscard]] bool ends_there(const Cut& cut) {
    const auto [there, is_new] = ends_from_.try_emplace(cut.place, chain_.size());
    while (is_new && there->second > 0 && distance(chain_[there->second - 1], cut.place->at) <= kOver_m) --there->second;
    return cut.piece + 1 >= there->second;
  }

  struct Visit {
    std::size_t since = 0;                                          // the first point behind the last cut
    std::size_t index = std::numeric_limits<std::size_t>::max();    // of its last visit; none yet: a number that no index reaches
  };
  const std::vector<Point>& chain_;
  std::vector<Cut> all_;
  std::unordered_map<const Place*, Visit> there_since_;
  std::unordered_map<const Place*, std::size_t> ends_from_;   // the first point from which on the way stays at the place to its end
};

void add_pieces(const Way& way, const std::vector<Point>& chain, const std::vector<Cut>& cuts, Adaptations& adaptations, std::vector<Way>& ways) {
  Way piece = way;
  Point from = chain.front();
  auto bend = chain.begin() + 1;
  const auto add = [&](const std::string& to_id, Point to, std::vector<Point>::const_iterator end) {
    piece.to = to_id;
    piece.through = bends_of(plain(chain_of(from, {bend, end}, to)));
    if (piece.from == piece.to) adaptations.note("way that comes back to a place: not round the loop", way.to_span);
    else ways.push_back(piece);
    piece.from = to_id, from = to, bend = end;
  };
  const std::size_t before = ways.size();
  piece.goes_on = true;
  for (const Cut& cut : cuts) add(cut.place->id, cut.place->at, chain.begin() + static_cast<std::ptrdiff_t>(cut.piece) + 1);
  add(way.to, chain.back(), chain.end() - 1);
  if (ways.size() > before) ways.back().goes_on = false;
}

/// Finds one of the places kept so far that is at the spot of another place. O(log places).
class Spots {
 public:
  /// The nearest one.
  [[nodiscard]] std::optional<std::size_t> find(Point at, const std::vector<Place>& kept) const {
    std::optional<std::size_t> nearest;
    double least_m = kOneSpot_m;
    for (const double dx : {-1.0, 0.0, 1.0}) {
      for (const double dy : {-1.0, 0.0, 1.0}) {
        const auto there = cells_.find({cell(at.x_m) + dx, cell(at.y_m) + dy});
        if (there == cells_.end()) continue;
        for (const std::size_t one : there->second) {
          const double away_m = distance(kept[one].at, at);
          if (away_m < least_m || (away_m == least_m && !nearest)) nearest = one, least_m = away_m;
        }
      }
    }
    return nearest;
  }
  void add(Point at, std::size_t index) { cells_[{cell(at.x_m), cell(at.y_m)}].push_back(index); }

 private:
  /// A sign is read from farther away: nobody could drive from one such place to the other.
  static constexpr double kOneSpot_m = 0.05;
  [[nodiscard]] static double cell(double m) { return std::floor(m / kOneSpot_m); }
  std::map<std::pair<double, double>, std::vector<std::size_t>> cells_;   // few in each, since no two are at one spot
};

/// Of places at one spot, keeps the first and gives it the ids of the others.
std::vector<Place> one_for_each_spot(const std::vector<Place>& places, Adaptations& adaptations) {
  Spots spots;
  std::unordered_set<std::string_view> ids;
  std::vector<Place> out;
  for (const Place& place : places) {
    const auto first = spots.find(place.at, out);
    if (!ids.insert(place.id).second || !first) {
      if (!first) spots.add(place.at, out.size());
      out.push_back(place);   // if its id occurs twice, roads_of reports that
      continue;
    }
    const bool same = as_written(place.at.x_m) == as_written(out[*first].at.x_m) && as_written(place.at.y_m) == as_written(out[*first].at.y_m);
    adaptations.note(same ? "place at the very spot of another: one landmark with it" : "place within 5 cm of another: one landmark with it", place.span);
    out[*first].also.push_back(place.id);
  }
  return out;
}

}  // namespace

std::optional<Layout> joined(Layout layout, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics) {
  layout.places = one_for_each_spot(layout.places, adaptations);
  const PlaceIndex index(layout.places);
  const Ground ground(layout.places);
  std::vector<Way> ways;
  std::size_t cut = 0;
  for (Way& way : layout.ways) {
    const Place *from = index.find(way.from), *to = index.find(way.to);
    if (from == nullptr || to == nullptr || from == to) {   // roads_of reports it
      ways.push_back(std::move(way));
      continue;
    }
    way.from = from->id, way.to = to->id;
    const std::vector<Point> chain = plain(chain_of(from->at, way.through, to->at));
    Cuts over(chain, ground);
    const auto cuts = over.run();
    cut += cuts.size();
    if (over.too_many() || cut > kMostCuts) {
      diagnostics.report(diagnostics::Kind::kLayoutManyCuts, way.from_span, {fmt::format("{}", kMostCuts)});
      return std::nullopt;
    }
    if (!cuts.empty()) adaptations.note("way over another place: it leads there, and on", way.from_span);
    add_pieces(way, chain, cuts, adaptations, ways);
  }
  layout.ways = std::move(ways);
  return layout;
}

}  // namespace kb::layout
