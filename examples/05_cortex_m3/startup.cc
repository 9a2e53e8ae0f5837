// From reset to main(): the table of vectors, memory as C++ expects it, and the two functions that a compiler may call for
// plain loops. No interrupt is used; every fault ends the program.
#include <cstddef>
#include <cstdint>

#include "board.h"

int main();

extern "C" {

// From the linker script.
extern std::uint32_t __stack_begin, __stack_end, __data_begin, __data_end, __data_image, __bss_begin, __bss_end;
using Constructor = void (*)();
extern const Constructor __init_array_start[], __init_array_end[];

[[noreturn]] void reset_handler();

void* memset(void* to, int value, std::size_t n) {
  auto* p = static_cast<unsigned char*>(to);
  while (n-- != 0) {
    *p++ = static_cast<unsigned char>(value);
    asm volatile("" : "+r"(p));  // else the compiler sees a memset here, and calls it
  }
  return to;
}

void* memcpy(void* to, const void* from, std::size_t n) {
  auto* p = static_cast<unsigned char*>(to);
  const auto* q = static_cast<const unsigned char*>(from);
  while (n-- != 0) {
    *p++ = *q++;
    asm volatile("" : "+r"(p));
  }
  return to;
}

}  // extern "C"

namespace {

void fault_handler() { board::stop(3); }

using Vector = void (*)();

/// What the processor reads at address 0: where the stack begins, then whom to call for reset and for each of the faults.
struct Vectors {
  std::uint32_t* stack;
  Vector reset, nmi, hard, memory, bus, usage;
};

[[gnu::section(".vectors"), gnu::used]] const Vectors kVectors = {
    &__stack_end, reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler};

}  // namespace

// The stack is painted up to the frame that is being used.
[[noreturn]] void reset_handler() {
  for (auto* p = &__stack_begin; p < static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 8; ++p) *p = board::kPaint;
  const std::uint32_t* from = &__data_image;
  for (auto* p = &__data_begin; p != &__data_end; ++p) *p = *from++;
  for (auto* p = &__bss_begin; p != &__bss_end; ++p) *p = 0;
  for (auto* constructor = __init_array_start; constructor != __init_array_end; ++constructor) (*constructor)();
  main();
  board::stop(0);
}
