// A drive for spectators: at the speed of a clock, with a page that shows it and whose buttons act on it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "sim/drive/drive.h"
#include "tools/kbc/support.h"

namespace kb::cli {

struct LiveOptions {
  std::uint16_t port = 0;      ///< 0: any that is free
  double speed = 1.0;          ///< seconds of the drive per second of the clock; above 0
  std::uint32_t dt_us = 0;     ///< of a tick
};

/// Returns at that time, or on an interrupt.
void wait_until(std::chrono::steady_clock::time_point when);

/// Drives to the end, calls `conclude`, which says how it ended, and serves the page until the user interrupts (Ctrl-C, SIGTERM). An interrupt
/// during the drive breaks it off. The caller must hold an `Interrupts`. `recording` is the one that `drive` writes. kErrors if the port is
/// not available (reported), kInterrupted if the drive has not come to its end, else what `conclude` returns.
[[nodiscard]] int drive_live(sim::Drive& drive, const sim::Recording& recording, const sim::Labyrinth& labyrinth,
                              const program::Program& program, const LiveOptions& options, const std::function<int()>& conclude, Session& session);

}  // namespace kb::cli
