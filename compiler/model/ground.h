// The roads of a map as they lie on the ground: for what writes maps for others.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/model/model.h"

namespace kb::model {

/// A road in one direction. Names are in `Model::texts`.
struct GroundRoad {
  RowId row = RowId::kNone;
  std::string_view from, to;             ///< landmarks
  std::string_view exit, approach, by;   ///< `approach` and `by` are empty if its relation has no such field
  std::vector<Point> course;             ///< the place of `from`, the road's bends, the place of `to`
  float limit_m_per_s = 0.0f;            ///< 0: none
  double begins_apart_rad = 0.0, ends_apart_rad = 0.0;   ///< where it begins and ends, the angle to the road beside it that is nearest, up to pi: none is
};

/// The same road from its other end.
[[nodiscard]] GroundRoad reversed(const GroundRoad& road);

/// A straight stretch of a course.
struct GroundPiece { double heading_rad = 0.0, length_m = 0.0; };
/// A course of two points or more, without what is shorter than 1 cm unless there is nothing else: at least one piece.
[[nodiscard]] std::vector<GroundPiece> pieces_of(std::span<const Point> course);

/// The roads of the map, in its order. Nothing if its relations are the user's own and do not say where things lie: landmarks need `at`,
/// roads `from`, `to` and `exit`. O(n log n).
[[nodiscard]] std::optional<std::vector<GroundRoad>> ground_roads(const Model& model, const Map& map);
/// What `{file}` lacks, for messages: "`{file}` has no {ground_lacking}": the place of one landmark, or such a map at all.
[[nodiscard]] std::string ground_lacking(const Model& model, const Map& map);

}  // namespace kb::model
