// The little that the demonstration needs of the board: a counter, the stack, and a way to print.
//
// MPS2 with image AN385: a Cortex-M3 at 25 MHz, flash at 0, memory at 0x2000'0000 (Arm, Application Note AN385).
#pragma once

#include <cstdint>

namespace board {

/// How far the processor's SysTick has counted: steps of the processor's clock, modulo 2^24. It counts down in hardware;
/// here it is turned round.
[[nodiscard]] std::uint32_t ticks();
inline constexpr std::uint32_t kTicksMask = 0x00FF'FFFF;
/// Starts the counter.
void start_ticks();

/// What start-up fills the stack with.
inline constexpr std::uint32_t kPaint = 0x5AFE57AC;
/// Bytes of the stack that have been used at any time since start-up, and that there are. Start-up paints the stack; the
/// first byte from below that has lost its paint says how deep it was.
[[nodiscard]] std::uint32_t stack_used();
[[nodiscard]] std::uint32_t stack_size();

/// Prints on the console of the debugger or emulator (semihosting). A processor without either stops here.
void print(const char* text);
void print(std::uint32_t number, int width = 0);
void print_hex(std::uint64_t number);
/// Ends the emulation; `code` is the exit code of the emulator.
[[noreturn]] void stop(std::uint32_t code);

}  // namespace board
