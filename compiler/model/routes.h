// Stops, roads between them, and legs: what routes and detours share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {

/// The landmarks of stops on map `map`. Nothing if one is missing, which is reported.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> landmarks_of(Draft& draft, const std::vector<syntax::Stop>& stops, std::uint32_t map);

/// The roads from each stop to the next; the stops, at least one, are at `landmarks`. Nothing if no road leads to the next stop or the
/// exit must be named, which is reported.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> roads_along(Draft& draft, const std::vector<syntax::Stop>& stops,
                                                                    const std::vector<std::uint32_t>& landmarks);

/// A new leg of `route` along a directed road.
std::uint32_t add_leg(Draft& draft, std::uint32_t route, std::string name, std::uint32_t road, source::Span at);
/// Notes what a leg leads along: a row of `Road`, or kNone. Limits of 0 and infinity are none.
void lay_leg(Draft& draft, RowId leg, RowId road, float limit_m_per_s);
/// Makes `next` follow `leg`.
void link_legs(Draft& draft, std::uint32_t leg, std::uint32_t next);
/// Adds legs along `roads`, named `name.0:A>B` and so on, after which the route continues as after the leg `target`. Returns the
/// first; the others have the indexes after it.
std::uint32_t add_chain(Draft& draft, std::uint32_t route, const std::vector<std::uint32_t>& roads, std::uint32_t target,
                        const std::string& name, source::Span at);

/// The name of a landmark.
[[nodiscard]] std::string_view landmark_name(const Draft& draft, std::uint32_t landmark);

}  // namespace kb::model
