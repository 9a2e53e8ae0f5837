// Demands on the results of a batch.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/batch/batch.h"
#include "sim/batch/demands.h"

namespace kb::sim::batch {

/// What a run can be counted for: outcomes, and other things that happen to it.
[[nodiscard]] std::span<const std::string_view> countable();

/// What rows of the table do not meet, in the order of the rows, which are the scenarios, then of the demands. O(runs * demands).
[[nodiscard]] std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Batch& batch, const std::vector<Run>& runs);

}  // namespace kb::sim::batch
