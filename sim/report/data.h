// A recording as the page's script reads it (page/data.js is the other side).
//
// Two parts: what is fixed for a drive, and frames in chunks. A page from a file holds one chunk; a live page is sent one
// after the other. All is JSON. Names of keys are short, as they are few, and columns are long:
//
//   a column    the frames' values as integers (see `html` in report.h), the first as it is, then differences; null: unknown
//   a sparse    [frames, values]: ascending frames of the drive as differences, the first as it is; the value from each on
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/recording.h"
#include "sim/report/spans.h"

namespace kb::sim::report {

/// Title, picture, names, legs: all but frames, stays and the outcome.
[[nodiscard]] nlohmann::ordered_json data_of_drive(const Recording& recording);

/// The frames of `of`, with the stays and the outcome as they are known by now. What came before `of` is not needed.
[[nodiscard]] nlohmann::ordered_json data_of_frames(const Recording& recording, Span of);

/// Compact JSON that may stand in a `<script>`.
[[nodiscard]] std::string print_data(const nlohmann::ordered_json& data);

}  // namespace kb::sim::report
