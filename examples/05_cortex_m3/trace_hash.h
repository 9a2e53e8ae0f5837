// One number for all that a mind has decided, tick by tick. The same header is compiled for the microcontroller and for the
// host: if both come to the same number, they have decided the same.
#pragma once

#include <bit>
#include <cstdint>

namespace mission {

/// FNV-1a with 64 bits, over words instead of bytes (Fowler, Noll, Vo). A hash against mistakes, not against malice.
class TraceHash {
 public:
  [[nodiscard]] std::uint64_t value() const { return hash_; }

  /// Adds a tick: its number, what came into view and went out of view, which rules fired, which satellites were set to
  /// what, which cells were contradicted, which strategy drives, and the status.
  template <class Decision>
  void add(const Decision& decision) {
    word(static_cast<std::uint32_t>(decision.tick()));
    unordered(decision.events(), [](auto fact) { return mix(static_cast<std::uint32_t>(fact), 0); });
    unordered(decision.lost(), [](auto fact) { return mix(static_cast<std::uint32_t>(fact), 0); });
    for (const auto rule : decision.fired()) word(static_cast<std::uint32_t>(rule));
    unordered(decision.changed(), [](const auto& set) { return mix(set.cell, std::bit_cast<std::uint32_t>(set.value)); });
    unordered(decision.conflicts(), [](const auto& conflict) { return mix(conflict.cell, conflict.level); });
    word(decision.drives() ? static_cast<std::uint32_t>(decision.strategy()) : ~0u);
    word(static_cast<std::uint32_t>(decision.status()));
  }

 private:
  void word(std::uint32_t w) { hash_ = (hash_ ^ w) * 0x0000'0100'0000'01B3u; }

  /// Two words well stirred into one, so that their sums over a list tell one list from another (the last steps of MurmurHash3).
  [[nodiscard]] static std::uint32_t mix(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = (a + 1) * 0x9E37'79B1u ^ b;
    x = (x ^ x >> 16) * 0x85EB'CA6Bu;
    x = (x ^ x >> 13) * 0xC2B2'AE35u;
    return x ^ x >> 16;
  }

  /// Lists that come in no order: their length and the sum of what their items give.
  template <class List, class Of>
  void unordered(const List& list, Of of) {
    std::uint32_t n = 0, sum = 0;
    for (const auto& item : list) {
      sum += of(item);
      ++n;
    }
    word(n);
    word(sum);
  }

  std::uint64_t hash_ = 0xCBF2'9CE4'8422'2325u;
};

}  // namespace mission
