// Places by their ids. Private to this folder.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

/// An index of places, which must not move. Of two with one id, the first counts.
class PlaceIndex {
 public:
  explicit PlaceIndex(const std::vector<Place>& places) {
    for (const Place& place : places) {
      index_.try_emplace(place.id, &place);
      for (const std::string& id : place.also) index_.try_emplace(id, &place);
    }
  }
  /// Null if there is none.
  [[nodiscard]] const Place* find(std::string_view id) const {
    const auto found = index_.find(id);
    return found == index_.end() ? nullptr : found->second;
  }

 private:
  std::unordered_map<std::string_view, const Place*> index_;
};

/// Whether a line ends at that place within half a metre, the tolerance of an arriving vehicle. True if there is no such place.
inline bool ends_at(Point end, const Place* place) {
  return place == nullptr || distance(place->at, end) <= 0.5;
}

}  // namespace kb::layout
