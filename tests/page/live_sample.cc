// A drive that goes on while it is served: its frames are those of the small drive, a tick every MS milliseconds (20).
//
//   live_sample [MS [PORT [STOP]]]     says `port N`, then a line for each command; ends when its input does. It waits for a
//                                      line of its input before it goes beyond tick STOP
//
// How the drive ended it says half a second after the last tick, as a real drive says it later than its pages may have all ticks.
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "sim/live/live_page.h"
#include "tests/unit/sim_report/small_drive.h"

namespace {

enum class Input { kNothing, kByte, kEnd };

Input look_at_input() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char byte = 0;
  if (poll(&input, 1, 0) <= 0) return Input::kNothing;
  return read(STDIN_FILENO, &byte, 1) == 1 ? Input::kByte : Input::kEnd;
}

}  // namespace

int main(int argc, char** argv) {
  using kb::sim::Command;
  using Clock = std::chrono::steady_clock;
  const kb::sim::Recording whole = kb::sim::testing::small_drive();
  kb::sim::Recording so_far = whole;
  so_far.frames.clear();
  so_far.stays.clear();
  so_far.outcome.clear();

  kb::sim::LivePage page(so_far);
  if (!page.start(static_cast<std::uint16_t>(argc > 2 ? std::atoi(argv[2]) : 0))) {
    std::puts("no port");
    return 1;
  }
  std::printf("port %u\n", page.port());
  std::fflush(stdout);
  const int tick_ms = argc > 1 ? std::atoi(argv[1]) : 20;
  std::size_t stop = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : whole.frames.size();
  bool paused = false;
  Clock::time_point end = Clock::time_point::max();
  for (Input input = look_at_input(); input != Input::kEnd; input = look_at_input()) {
    if (input == Input::kByte) stop = whole.frames.size();
    for (const Command& command : page.commands()) {
      constexpr const char* kWords[] = {"close", "open", "press", "pause", "resume"};
      std::printf("%s %s\n", kWords[static_cast<int>(command.what)], command.name.c_str());
      std::fflush(stdout);
      if (command.what == Command::What::kPause || command.what == Command::What::kResume) paused = command.what == Command::What::kPause;
    }
    const std::size_t next = so_far.frames.size();
    if (!paused && next < stop) {
      so_far.frames.push_back(whole.frames[next]);
      for (const auto& stay : whole.stays) {
        if (stay.first == next) so_far.stays.push_back(stay);
      }
      page.append(so_far);
      if (next + 1 == whole.frames.size()) end = Clock::now() + std::chrono::milliseconds(500);
    }
    if (Clock::now() >= end) {
      so_far.outcome = whole.outcome;
      page.finish(so_far);
      end = Clock::time_point::max();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(tick_ms));
  }
}
