// The present state of the floor: what the line array sees, and what the landmarks' memories say. A scenario changes it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/world/labyrinth.h"

namespace kb::sim {

/// What a tag says of the crossing it belongs to. Never changed after it is made, as a robot may keep what it has read.
struct Memory {
  struct Exit {
    std::string name;                ///< `N`
    bool closed = false;             ///< the road must not be taken
  };
  std::string landmark;
  bool safe = true;                  ///< the crossing may be entered
  std::vector<std::string> methods;  ///< those by which it can be crossed
  std::vector<Exit> exits;           ///< in the order of the crossing's arms
};

class Floor {
 public:
  /// `labyrinth` must outlive it.
  explicit Floor(const Labyrinth& labyrinth);

  /// How dark the floor is under a sensor that sees a spot of `radius_m`: 0 no paint, 1 paint all over. O(strokes near by).
  [[nodiscard]] float darkness(Spot spot, double radius_m) const;

  /// What a reader reads above a spot: the arm of a crossing and what the tag says. Null if no readable tag is near.
  struct Reading {
    std::shared_ptr<const Memory> memory;
    std::uint32_t arm = 0;           ///< index into the memory's exits: the arm on whose road the tag lies
  };
  [[nodiscard]] const Reading* tag_near(Spot spot) const;

  /// What the tags of that crossing say now.
  [[nodiscard]] const std::shared_ptr<const Memory>& memory(CrossingId crossing) const { return memories_[at(crossing)]; }

  // ---- what a scenario does
  /// The cause of a change that may be undone later. Undoing by a cause undoes only its own changes; undoing by kNobody undoes all.
  using Cause = std::uint32_t;
  static constexpr Cause kNobody = 0;
  void set_closed(RoadId road, bool closed, Cause cause = kNobody);
  void set_safe(CrossingId crossing, bool safe, Cause cause = kNobody);
  /// Sets how a crossing can be driven; without `mark` its paint is removed too. For the beginning of a drive.
  void set_methods(CrossingId crossing, std::vector<std::string> methods);
  /// A stretch of a road's marking that cannot be seen, between two distances from its first landmark's stop line.
  struct Worn { RoadId road{}; double from_m = 0.0, to_m = 0.0; Cause cause = kNobody; };
  void wear_off(Worn stretch) { worn_.push_back(stretch); }
  void mend(RoadId road, Cause cause = kNobody);
  enum class TagState : std::uint8_t { kWell, kUnreadable, kWrong };
  /// Sets the tag of one arm. kWrong: it claims to be at `instead`, on the arm of the same name if there is one.
  void set_tag(CrossingId crossing, std::uint32_t arm, TagState state, CrossingId instead = CrossingId::kNone);

  [[nodiscard]] bool closed(RoadId road) const { return !closed_by_[at(road)].empty(); }
  [[nodiscard]] bool safe(CrossingId crossing) const { return unsafe_by_[at(crossing)].empty(); }
  [[nodiscard]] const std::vector<Worn>& worn() const { return worn_; }

 private:
  struct Cell { std::uint32_t first = 0, count = 0; };
  void lay_grid();
  /// The grid cell of a spot; nothing outside the floor.
  [[nodiscard]] std::optional<std::size_t> place_of(Spot spot) const;
  [[nodiscard]] std::shared_ptr<const Memory> memory_of(CrossingId crossing) const;
  /// The crossing that a tag claims to belong to.
  [[nodiscard]] CrossingId says(std::size_t tag) const;
  void write_tag(std::size_t tag);
  void remember(CrossingId crossing);
  [[nodiscard]] bool is_worn(const Paint& paint, Spot spot) const;

  const Labyrinth& labyrinth_;
  std::vector<std::vector<Cause>> closed_by_, unsafe_by_;
  std::vector<bool> unpainted_;
  std::vector<std::vector<std::string>> methods_;
  std::vector<Worn> worn_;
  struct TagNow { TagState state = TagState::kWell; Reading reading; CrossingId instead = CrossingId::kNone; };
  std::vector<TagNow> tags_;                             // by the labyrinth's tags
  std::vector<std::shared_ptr<const Memory>> memories_;  // by crossing

  // A grid of squares, each with the paint and the tags that reach into it.
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> paint_cells_, tag_cells_;
  std::vector<std::uint32_t> paint_list_, tag_list_;
  std::vector<Paint> paint_;                             // lines, then stop lines
};

}  // namespace kb::sim
