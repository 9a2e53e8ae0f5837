// The beginning of a drive when the scenario does not give it.
#pragma once

#include <optional>

#include "sim/scenario/scenario.h"

namespace kb::sim {

/// The first route of the knowledge base; null if there is none.
[[nodiscard]] const model::Row* first_route(const model::Model& model);
/// The first route's command is pressed after a second; the robot stands nowhere yet. If there
/// is no route, see MissionsBy; nothing if one is required (reported).
[[nodiscard]] std::optional<Scenario> unplaced_scenario(const Knowledge& knowledge, const model::Model& model, diagnostics::Diagnostics& diagnostics,
                                                        MissionsBy by);
/// Before the stop line of the landmark at which `route` begins (it has one), heading there. Nothing if no road leads there (reported).
[[nodiscard]] std::optional<Pose> start_before(const model::Row& route, const Labyrinth& labyrinth, const model::Model& model,
                                               diagnostics::Diagnostics& diagnostics);

}  // namespace kb::sim
