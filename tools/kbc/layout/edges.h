// Edges of a layout, by their ids, on the roads that were made of them.
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

/// What the master of a fleet calls by the ids of its layout: nodes, which are places, and edges, which may run over some. Does not move.
class Edges {
 public:
  /// `map`, which must outlive it and stay as it is, has roads for all ways of its layout but those that lead nowhere. O(layout log layout).
  explicit Edges(const Map& map);
  Edges(const Edges&) = delete;
  Edges& operator=(const Edges&) = delete;

  /// The place of a node, as an index of Layout::places; of those at one spot each has it. Nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> place(std::string_view node) const;

  struct Drive {
    std::vector<Visit> visits;   ///< of where it begins and what it runs over, not of where it ends. Empty: both ends are at one spot
    bool round = false;          ///< ... but it leads round and back, and so is no road
    bool twice = false;          ///< the layout has it again between these places, and it leaves by another side: the first is taken
  };
  /// How an edge is driven from one place to another. Nothing if the layout has none of that id there. O(log layout), and the ways
  /// between these places and the pieces of the one that is taken.
  [[nodiscard]] std::optional<Drive> find(std::string_view edge, std::uint32_t from, std::uint32_t to) const;
  /// Another edge that leads there, for who has named one that does not. Nothing if there is none.
  [[nodiscard]] std::optional<std::string> instead_of(std::string_view edge, std::uint32_t from, std::uint32_t to) const;

  /// Where one way (of those over places: one piece) begins, and by which side its road leaves. Nothing if none was made of it.
  [[nodiscard]] std::optional<Visit> begin_of(const Way& way) const;

 private:
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  [[nodiscard]] const std::vector<const Way*>& ways(std::uint32_t from, std::uint32_t to) const;

  const Map& map_;
  PlaceIndex places_;
  std::map<Ends, std::vector<const Road*>> roads_;   // by their ends, the lower index first
  std::map<Ends, std::vector<const Way*>> ways_;     // from, to; of those over places the first piece
};

}  // namespace kb::layout
