// The edges of a layout, by id, on the roads made from them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

/// What a fleet's master names by the ids of its layout: nodes, which are places, and edges, which may run over places. Does not move.
class Edges {
 public:
  /// `map` must outlive it and not change; it must have roads for all ways of its layout except those that lead nowhere. O(layout log
  /// layout).
  explicit Edges(const Map& map);
  Edges(const Edges&) = delete;
  Edges& operator=(const Edges&) = delete;

  /// The place of a node, as an index into Layout::places; all nodes at one spot have the same. Nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> place(std::string_view node) const;

  struct Drive {
    std::vector<Visit> visits;   ///< its beginning and the places it runs over, not its end. Empty: both ends are at one spot
    bool round = false;          ///< ... but it leads round in a loop, so it is no road
    bool twice = false;          ///< the layout has another of this id between these places, by another side; the first is taken
  };
  /// How an edge is driven from one place to another. Nothing if the layout has none of that id there. O(log layout + ways between these
  /// places + pieces of the way taken).
  [[nodiscard]] std::optional<Drive> find(std::string_view edge, std::uint32_t from, std::uint32_t to) const;
  /// Another edge that leads there, for a message about one that does not. Nothing if there is none.
  [[nodiscard]] std::optional<std::string> instead_of(std::string_view edge, std::uint32_t from, std::uint32_t to) const;

  /// Where a way (or one piece of a way over places) begins, and by which side its road leaves. Nothing if no road was made from it.
  [[nodiscard]] std::optional<Visit> begin_of(const Way& way) const;

 private:
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  [[nodiscard]] const std::vector<const Way*>& ways(std::uint32_t from, std::uint32_t to) const;

  const Map& map_;
  PlaceIndex places_;
  std::map<Ends, std::vector<const Road*>> roads_;   // by their ends, the lower index first
  std::map<Ends, std::vector<const Way*>> ways_;     // by from and to; the first piece of ways over places
};

}  // namespace kb::layout
