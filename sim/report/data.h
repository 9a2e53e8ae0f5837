// A recording as the page's script reads it (page/data.js is the other side).
//
// Two parts: what is fixed for a drive, and frames in chunks. A page from a file holds one chunk; a live page is sent chunk after
// chunk. All is JSON, made of keys with short names and long columns:
//
//   a column    the frames' values as integers (see `html` in report.h), the first as it is, then differences; null: unknown; empty: none is known
//   a sparse    [frames, values]: ascending frames of the drive as differences, the first as it is; the value from each on
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/recording.h"
#include "sim/report/spans.h"

namespace kb::sim::report {

/// Title, picture, names, legs: everything except frames, stays and the outcome.
[[nodiscard]] nlohmann::ordered_json data_of_drive(const Recording& recording);

/// The frames of `of`, with the stays and the outcome as known by now. Earlier frames are not needed.
[[nodiscard]] nlohmann::ordered_json data_of_frames(const Recording& recording, Span of);

/// Compact JSON that may stand in a `<script>`.
[[nodiscard]] std::string print_data(const nlohmann::ordered_json& data);

}  // namespace kb::sim::report
