// Landmarks that no robot can get to: no road leads there, or only roads from others of that kind.
#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>

#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class Islands {
 public:
  explicit Islands(Draft& draft) : draft_(draft), reached_(draft.landmarks.size(), false) {}

  void run() {
    for (std::uint32_t l = 0; l < reached_.size(); ++l) {
      const LandmarkInfo& landmark = draft_.landmarks[l];
      if (landmark.in > 0 || !is_whole(landmark.map)) continue;
      const Row& row = draft_.model[landmark.row];
      draft_.diagnostics.report(Kind::kUnreachedLandmark, row.declared, {row.name});
      reach(l);   // what else lies behind it follows from that
    }
    if (draft_.diagnostics.errors() > 0) return;   // a route or a road that could not be read may lead there
    begin_on_routes();
    if (std::find(has_routes_.begin(), has_routes_.end(), false) != has_routes_.end()) begin_in_largest_parts();
    if (std::find(reached_.begin(), reached_.end(), false) != reached_.end()) report_what_is_left();
  }

 private:
  using Sets = boost::disjoint_sets_with_storage<>;

  [[nodiscard]] bool is_whole(std::uint32_t map) const { return !draft_.broken_maps[map] && draft_.model.maps[map].landmarks.size() >= 2; }

  /// Marks `start` and all that roads lead to from there.
  void reach(std::uint32_t start) {
    waiting_.push_back(start);
    while (!waiting_.empty()) {
      const std::uint32_t at = waiting_.back();
      waiting_.pop_back();
      if (reached_[at]) continue;
      reached_[at] = true;
      for (const std::uint32_t road : draft_.landmarks[at].out) waiting_.push_back(draft_.roads[road].to);
    }
  }

  void begin_on_routes() {
    has_routes_.assign(draft_.model.maps.size(), false);
    for (const LegInfo& leg : draft_.legs) {
      has_routes_[draft_.landmarks[leg.to].map] = true;
      reach(leg.to);
    }
  }

  /// The missions of a map without routes are orders.
  void begin_in_largest_parts() {
    Sets parts = parts_of([](std::uint32_t) { return true; });
    std::vector<std::uint32_t> size(reached_.size(), 0);
    std::vector<std::uint32_t> largest(draft_.model.maps.size(), kNone32);   // by map
    for (std::uint32_t l = 0; l < reached_.size(); ++l) ++size[parts.find_set(l)];
    for (std::uint32_t l = 0; l < reached_.size(); ++l) {
      std::uint32_t& best = largest[draft_.landmarks[l].map];
      const auto part = static_cast<std::uint32_t>(parts.find_set(l));
      if (best == kNone32 || size[part] > size[best]) best = part;
    }
    for (std::uint32_t l = 0; l < reached_.size(); ++l) {
      const std::uint32_t map = draft_.landmarks[l].map;
      if (!has_routes_[map] && parts.find_set(l) == largest[map]) reach(l);
    }
  }

  /// One message for all that are joined by roads, at the first of them.
  void report_what_is_left() {
    Sets parts = parts_of([this](std::uint32_t l) { return !reached_[l]; });
    std::vector<std::vector<std::uint32_t>> members(reached_.size());
    for (std::uint32_t l = 0; l < reached_.size(); ++l) {
      if (!reached_[l] && is_whole(draft_.landmarks[l].map)) members[parts.find_set(l)].push_back(l);
    }
    std::erase_if(members, [](const auto& part) { return part.empty(); });
    std::ranges::sort(members);
    for (const std::vector<std::uint32_t>& part : members) {
      const Row& row = draft_.model[draft_.landmarks[part.front()].row];
      const std::uint32_t map = draft_.landmarks[part.front()].map;
      const std::string others = part.size() == 1   ? ""
                                 : part.size() == 2 ? fmt::format(", nor to `{}`", draft_.model[draft_.landmarks[part.back()].row].name)
                                                    : fmt::format(", nor to the {} that it is joined with", part.size() - 1);
      draft_.diagnostics.report(Kind::kIslandOfLandmarks, row.declared,
                                {row.name, others, has_routes_[map] ? "the routes" : "the other landmarks", draft_.model.maps[map].name});
    }
  }

  /// The parts of the maps that hang together by roads between landmarks that are `asked` for.
  Sets parts_of(auto asked) const {
    Sets parts(reached_.size());
    for (const DirectedRoad& road : draft_.roads) {
      if (asked(road.from) && asked(road.to)) parts.union_set(road.from, road.to);
    }
    return parts;
  }

  Draft& draft_;
  std::vector<bool> reached_;               // by landmark
  std::vector<std::uint32_t> waiting_;      // reached, but not what they lead to
  std::vector<bool> has_routes_;            // by map
};

}  // namespace

void report_islands(Draft& draft) { Islands(draft).run(); }

}  // namespace kb::model
