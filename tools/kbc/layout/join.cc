// What lies on each other in a layout: several places at one spot, and ways that run over a place.
#include <algorithm>
#include <map>

#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {
namespace {

// note [ways over places]
// Route graphs have ways for those who do not stop in between: from A to C, beside those from A to B and from B to C. A robot that
// reads signs sees B's on the way, and roads do not lie on each other. So the way becomes two, of which the second is the rest of
// the first (Way::goes_on), and where there are such roads already, they serve.

constexpr double kOver_m = 0.15;   // a place is not farther from the middle of a road that runs over it

double distance(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

/// The places in a rectangle. O(log places), and those that lie in the narrower of its two strips.
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
  std::vector<const Place*> by_x_, by_y_;   // no place is NaN: readers have numbers only
};

/// Where a way runs over a place: on its piece number `piece`, at this share of it.
struct Cut {
  std::size_t piece;
  double share;
  const Place* place;
};

/// Appends what a piece of a way runs over; not what lies at the ends of the way.
void look_below(const std::vector<Point>& chain, std::size_t piece, const Ground& ground, std::vector<Cut>& cuts) {
  const Point a = chain[piece], b = chain[piece + 1];
  const Point low{std::min(a.x_m, b.x_m) - kOver_m, std::min(a.y_m, b.y_m) - kOver_m};
  const Point high{std::max(a.x_m, b.x_m) + kOver_m, std::max(a.y_m, b.y_m) + kOver_m};
  const double square = (b.x_m - a.x_m) * (b.x_m - a.x_m) + (b.y_m - a.y_m) * (b.y_m - a.y_m);
  for (const Place* place : ground.within(low, high)) {
    const Point p = place->at;
    if (distance(p, chain.front()) <= kOver_m || distance(p, chain.back()) <= kOver_m) continue;
    const double along = ((p.x_m - a.x_m) * (b.x_m - a.x_m) + (p.y_m - a.y_m) * (b.y_m - a.y_m)) / (square > 0.0 ? square : 1.0);
    const double share = std::clamp(along, 0.0, 1.0);
    if (distance(p, {std::lerp(a.x_m, b.x_m, share), std::lerp(a.y_m, b.y_m, share)}) <= kOver_m) cuts.push_back({piece, share, place});
  }
}

/// The places that a way runs over, in its order, each once.
std::vector<Cut> cuts_of(const std::vector<Point>& chain, const Ground& ground) {
  std::vector<Cut> cuts, first;
  for (std::size_t piece = 0; piece + 1 < chain.size(); ++piece) look_below(chain, piece, ground, cuts);
  std::stable_sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return std::pair(a.piece, a.share) < std::pair(b.piece, b.share); });
  for (const Cut& cut : cuts) {
    if (std::none_of(first.begin(), first.end(), [&](const Cut& other) { return other.place == cut.place; })) first.push_back(cut);
  }
  return first;
}

/// The bends of a way between two cuts: not those that lie at the places where it is cut.
std::vector<Point> bends_between(const std::vector<Point>& chain, std::size_t first, std::size_t last, Point from, Point to) {
  std::vector<Point> bends;
  for (std::size_t i = first; i < last; ++i) {
    if (distance(chain[i], from) > kOver_m && distance(chain[i], to) > kOver_m) bends.push_back(chain[i]);
  }
  return bends;
}

void add_pieces(const Way& way, const std::vector<Point>& chain, const std::vector<Cut>& cuts, std::vector<Way>& ways) {
  Way piece = way;
  Point from = chain.front();
  std::size_t bend = 1;
  for (const Cut& cut : cuts) {
    piece.to = cut.place->id;
    piece.through = bends_between(chain, bend, cut.piece + 1, from, cut.place->at);
    piece.goes_on = true;
    ways.push_back(piece);
    piece.from = cut.place->id;
    from = cut.place->at;
    bend = cut.piece + 1;
  }
  piece.to = way.to;
  piece.through = bends_between(chain, bend, chain.size() - 1, from, chain.back());
  piece.goes_on = false;
  ways.push_back(std::move(piece));
}

/// Of places at one spot the first stays, and answers to the ids of the others.
std::vector<Place> one_for_each_spot(const std::vector<Place>& places, Adaptations& adaptations) {
  std::map<std::pair<double, double>, std::size_t> index;
  std::vector<Place> out;
  for (const Place& place : places) {
    const auto [at, is_new] = index.try_emplace({place.at.x_m, place.at.y_m}, out.size());
    if (is_new || out[at->second].id == place.id) {   // twice the same: roads_of tells it
      out.push_back(place);
      continue;
    }
    adaptations.note("place at the very spot of another: one landmark with it", place.span);
    out[at->second].also.push_back(place.id);
  }
  return out;
}

}  // namespace

Layout joined(Layout layout, Adaptations& adaptations) {
  layout.places = one_for_each_spot(layout.places, adaptations);
  const PlaceIndex index(layout.places);
  const Ground ground(layout.places);
  std::vector<Way> ways;
  for (Way& way : layout.ways) {
    const Place *from = index.find(way.from), *to = index.find(way.to);
    if (from == nullptr || to == nullptr || from == to) {   // roads_of tells it
      ways.push_back(std::move(way));
      continue;
    }
    std::vector<Point> chain{from->at};
    chain.insert(chain.end(), way.through.begin(), way.through.end());
    chain.push_back(to->at);
    const auto cuts = cuts_of(chain, ground);
    if (!cuts.empty()) adaptations.note("way over another place: it leads there, and on", way.from_span);
    if (cuts.empty()) ways.push_back(std::move(way));
    else add_pieces(way, chain, cuts, ways);
  }
  layout.ways = std::move(ways);
  return layout;
}

}  // namespace kb::layout
