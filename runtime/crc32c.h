// CRC-32C (Castagnoli): the checksum of images. Detects every change of up to 32 adjacent bits, and so every single bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mts {

/// Takes bytes in pieces. The polynomial is 0x1EDC6F41, reflected; begins with all ones and ends inverted, as in iSCSI
/// (RFC 3720, appendix B.4). Cost: in a hosted program tables of 8 KiB and eight look-ups for eight bytes, none of which waits
/// for another; in a freestanding one a table of 1 KiB and a look-up for each byte, which waits for the one before.
class Crc32c {
 public:
  constexpr void take(const std::uint8_t* bytes, std::size_t count) {
    for (; kSlices == 8 && count >= 8; bytes += 8, count -= 8) {
      const std::uint32_t low = state_ ^ load(bytes), high = load(bytes + 4);
      state_ = 0;
      for (std::uint32_t i = 0; i < 4; ++i) {
        state_ ^= kTables.of[(7 - i) % kSlices][low >> (8 * i) & 0xFFu] ^ kTables.of[(3 - i) % kSlices][high >> (8 * i) & 0xFFu];
      }
    }
    for (std::size_t i = 0; i < count; ++i) state_ = step(state_, bytes[i]);
  }
  /// Takes so many zero bytes, which stand for the checksum itself.
  constexpr void take_zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) state_ = step(state_, 0);
  }
  [[nodiscard]] constexpr std::uint32_t value() const { return ~state_; }

  /// The state after one more byte. It is linear over exclusive-or in both arguments together, so the effect of a changed bit can be
  /// followed without the other bytes.
  [[nodiscard]] static constexpr std::uint32_t step(std::uint32_t state, std::uint8_t byte) {
    return (state >> 8) ^ kTables.of[0][(state ^ byte) & 0xFFu];
  }

 private:
#if __STDC_HOSTED__
  static constexpr std::uint32_t kSlices = 8;
#else
  static constexpr std::uint32_t kSlices = 1;   // flash is scarcer than time
#endif
  static constexpr std::uint32_t load(const std::uint8_t* b) {
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
  }

  /// `of[k][b]` is the state after the byte b and k zero bytes, from a state of zero.
  struct Tables { std::uint32_t of[kSlices][256]; };
  static constexpr Tables kTables = [] {
    Tables tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t x = i;
      for (int k = 0; k < 8; ++k) x = (x >> 1) ^ ((x & 1u) != 0 ? 0x82F63B78u : 0u);
      tables.of[0][i] = x;
    }
    for (std::uint32_t k = 1; k < kSlices; ++k) {
      for (std::uint32_t i = 0; i < 256; ++i) {
        const std::uint32_t before = tables.of[k - 1][i];
        tables.of[k][i] = (before >> 8) ^ tables.of[0][before & 0xFFu];
      }
    }
    return tables;
  }();

  std::uint32_t state_ = 0xFFFFFFFFu;
};

}  // namespace mts
