// What people look at after a drive: a page that replays it, a picture, a trace for Perfetto, a table.
//
// All of them are made from a `Recording` alone, in memory, without clock, locale or network: the same recording gives the
// same bytes. Names and notes may hold anything; what is not UTF-8 becomes U+FFFD. Each form shows numbers that are
// not finite as unknown in its own way. None of these functions fails; an empty recording gives an empty drive.
#pragma once

#include <string>

#include "sim/recording.h"

namespace kb::sim::report {

/// One HTML page that needs nothing else and works from a file: a player of the drive. It holds the frames as integers (lengths in
/// millimetres, ranges in centimetres, angles in milliradians, certainties in 1e-4), each column as differences; about 100 bytes a frame.
/// Memory and time are linear in the frames: ten minutes at 10 Hz take less than a megabyte.
[[nodiscard]] std::string html(const Recording& recording);

/// The floor from above with what stood on it at the end, and the track in the colours and dashes of the strategies. Notes are
/// numbered, each where the robot was at the time.
[[nodiscard]] std::string svg(const Recording& recording);

/// Chrome's trace event format, for https://ui.perfetto.dev: strategies, legs and statuses as slices, rules and notes as
/// instants, facts as counters. A rule that fires at tick after tick is one instant, at the first of them.
[[nodiscard]] std::string chrome_trace(const Recording& recording);

/// One row for each frame: `t`, the true pose, the senses, the facts by name, then `strategy`, `leg`, `status`, `notes`, `tick`. SI units.
/// A sensor that is silent leaves its fields empty; a fact that is not a number says `nan`. A fact that is called as another column stands
/// there as `fact:NAME`. `tick` is the number that the trace and `kbc why` give the decision of this row; empty while the mind rests.
[[nodiscard]] std::string csv(const Recording& recording);

/// The facts that the mind was given, as `kbc run --facts` reads them: `t`, then each fact that was given at some tick; one row for
/// each tick, certainties with all digits, an empty field for 0. Replayed to the same knowledge base it gives the same decisions.
/// While power is off, or the robot waits, the mind does not tick: there are no rows, and `t` stands still.
[[nodiscard]] std::string facts(const Recording& recording);

}  // namespace kb::sim::report
