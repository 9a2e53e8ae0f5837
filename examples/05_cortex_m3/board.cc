#include "board.h"

// The linker script says where these are; only their addresses mean something.
extern "C" std::uint32_t __stack_begin, __stack_end;

namespace board {
namespace {

struct SysTick { volatile std::uint32_t control, reload, now, calibration; };
SysTick& systick() { return *reinterpret_cast<SysTick*>(0xE000'E010); }

// Arm, "Semihosting for AArch32 and AArch64": the number of the call in r0, its argument in r1, then BKPT 0xAB.
constexpr std::uint32_t kWriteText = 0x04, kExitExtended = 0x20;
constexpr std::uint32_t kApplicationExit = 0x20026;

std::uint32_t call(std::uint32_t number, const void* argument) {
  register std::uint32_t r0 asm("r0") = number;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

}  // namespace

std::uint32_t ticks() { return kTicksMask - systick().now; }

void start_ticks() {
  systick().reload = kTicksMask;
  systick().now = 0;
  systick().control = 5;  // on, the processor's clock, no interrupt
}

std::uint32_t stack_size() {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&__stack_end) - reinterpret_cast<std::uintptr_t>(&__stack_begin));
}

std::uint32_t stack_used() {
  const std::uint32_t* p = &__stack_begin;
  while (p != &__stack_end && *p == kPaint) ++p;
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&__stack_end) - reinterpret_cast<std::uintptr_t>(p));
}

void print(const char* text) { call(kWriteText, text); }

void print(std::uint32_t number, int width) {
  char text[12];
  char* p = text + sizeof text;
  *--p = '\0';
  do {
    *--p = static_cast<char>('0' + number % 10);
    number /= 10;
    --width;
  } while (number != 0);
  while (width-- > 0 && p != text) *--p = ' ';
  print(p);
}

void print_hex(std::uint64_t number) {
  char text[19] = "0x";
  for (int i = 17; i > 1; --i) {
    text[i] = "0123456789abcdef"[number & 15u];
    number >>= 4;
  }
  print(text);
}

void stop(std::uint32_t code) {
  const std::uint32_t why[] = {kApplicationExit, code};
  for (;;) call(kExitExtended, why);
}

}  // namespace board
