#include "tools/kbc/live_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "sim/live/live_page.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using Clock = std::chrono::steady_clock;

// All names are valid: LivePage passes only names that are in the recording.
void obey(const sim::Command& command, sim::Drive& drive, const sim::Labyrinth& labyrinth, const program::Program& program) {
  using What = sim::Command::What;
  sim::Action action;
  if (command.what == What::kPress) {
    const auto cell = std::find_if(program.cells.begin(), program.cells.end(), [&](const auto& c) { return c.name == command.name; });
    action.kind = sim::Action::Kind::kPress;
    action.cell = program::CellId{static_cast<std::uint32_t>(cell - program.cells.begin())};
    drive.act(action, fmt::format("{} pressed", command.name));
    return;
  }
  const bool closes = command.what == What::kCloseRoad;
  const auto road = std::find_if(labyrinth.roads.begin(), labyrinth.roads.end(), [&](const auto& r) { return r.name == command.name; });
  action.kind = closes ? sim::Action::Kind::kClose : sim::Action::Kind::kOpen;
  action.road = sim::RoadId{static_cast<std::uint32_t>(road - labyrinth.roads.begin())};
  drive.act(action, fmt::format("road {} {}", command.name, closes ? "closed" : "open again"));
}

}  // namespace

// At a hundredth of the speed a tick takes some seconds.
void wait_until(Clock::time_point when) {
  constexpr auto kLook = std::chrono::milliseconds(100);
  for (auto now = Clock::now(); now < when && !Interrupts::came(); now = Clock::now()) std::this_thread::sleep_until(std::min(when, now + kLook));
}

int drive_live(sim::Drive& drive, const sim::Recording& recording, const sim::Labyrinth& labyrinth,
                const program::Program& program, const LiveOptions& options, const std::function<int()>& conclude, Session& session) {
  sim::LivePage page(recording);
  if (!page.start(options.port)) {
    session.report(diagnostics::Kind::kSimPortTaken, {fmt::format("{}", options.port)});
    return kErrors;
  }
  session.announce(fmt::format("http://127.0.0.1:{}/  (Ctrl-C ends)", page.port()));
  const auto tick = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.dt_us / 1e6 / options.speed));
  bool paused = false, more = true;
  for (auto next = Clock::now(); more && !Interrupts::came(); wait_until(next)) {
    for (const sim::Command& command : page.commands()) {
      if (command.what == sim::Command::What::kPause || command.what == sim::Command::What::kResume) {
        paused = command.what == sim::Command::What::kPause;
      } else {
        obey(command, drive, labyrinth, program);
      }
    }
    if (!paused) more = drive.step();
    page.append(recording);
    next = std::max(next + tick, Clock::now());   // lost time is not made up for
  }
  page.finish(recording);
  if (more) return kInterrupted;
  const int code = conclude();
  session.flush_output();   // with --quiet nothing follows that would
  session.remark("the drive is over; the page stays until Ctrl-C");
  wait_until(Clock::time_point::max());
  return code;
}

}  // namespace kb::cli
