// The mission of example 1 on a bare Cortex-M3: no operating system, no heap, no C library. All that a knowledge base needs
// at run time is the object `mind`; everything else here feeds it, counts and prints.
#include "board.h"
#include "mission.h"
#include "paper.kb.h"
#include "storm.h"
#include "trace_hash.h"

namespace {

paper::Mind mind;
mission::TraceHash trace;

/// How many instructions ticks of one kind took.
struct Count {
  std::uint32_t sum = 0;
  std::uint16_t ticks = 0, least = 0xFFFF, most = 0;

  void add(std::uint32_t n) {
    ++ticks;
    sum += n;
    if (n < least) least = static_cast<std::uint16_t>(n);
    if (n > most) most = static_cast<std::uint16_t>(n);
  }
  void print(const char* name) const {
    board::print(name);
    board::print(ticks, 7);
    board::print(least, 7);
    board::print(ticks == 0 ? 0 : (sum + ticks / 2u) / ticks, 7);
    board::print(most, 7);
    board::print("\n");
  }
};

// note [counting instructions]
//   qemu -icount shift=6 lets 64 ns pass for each instruction, and SysTick counts at 25 MHz, every 40 ns: 1.6 steps an
//   instruction, so the count follows exactly. What reading the counter takes itself is measured and taken off.
//   On a board the same lines count cycles: set both to 1.
constexpr std::uint32_t kNsPerStep = 40, kNsPerInstruction = 64;

std::uint32_t instructions(std::uint32_t from, std::uint32_t to) {
  return (((to - from) & board::kTicksMask) * kNsPerStep + kNsPerInstruction / 2) / kNsPerInstruction;
}

[[gnu::noinline]] void run_mission() {
  Count event, change, calm;
  const std::uint32_t before = board::ticks();
  const std::uint32_t nothing = instructions(before, board::ticks());
  for (std::uint32_t tick = 0; tick < mission::kTicks; ++tick) {
    for (std::uint32_t i = mission::kBegin[tick]; i < mission::kBegin[tick + 1]; ++i) {
      mind.give(mission::kSamples[i].fact, mission::kSamples[i].certainty);
    }
    const std::uint32_t from = board::ticks();
    const auto decision = mind.tick(mts::milliseconds(mission::kPeriodMs));
    const std::uint32_t n = instructions(from, board::ticks()) - nothing;
    trace.add(decision);
    if (!decision.events().empty()) event.add(n);
    else if (mission::kBegin[tick] != mission::kBegin[tick + 1]) change.add(n);
    else calm.add(n);
  }
  board::print("trace ");
  board::print_hex(trace.value());
  board::print("\ninstructions        ticks  least   mean   most\n");
  event.print("  event           ");
  change.print("  facts change    ");
  calm.print("  no fact changes ");
}

[[gnu::noinline]] void run_storm() {
  mind.reset();
  const std::uint32_t contradictions = mission::storm(mind, trace);
  board::print("storm ");
  board::print_hex(trace.value());
  board::print(" with ");
  board::print(contradictions);
  board::print(" contradictions\n");
}

void print_stack(const char* when) {
  board::print("stack ");
  board::print(board::stack_used());
  board::print(" of ");
  board::print(board::stack_size());
  board::print(" bytes after ");
  board::print(when);
  board::print("\n");
}

}  // namespace

int main() {
  board::start_ticks();
  run_mission();
  print_stack("the mission");
  run_storm();
  print_stack("the storm");
  return 0;
}
