// CRC-32C (Castagnoli): the checksum of images. Detects every change of up to 32 adjacent bits, and so every single bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mts {

/// Takes bytes in pieces. The polynomial is 0x1EDC6F41, reflected; begins with all ones and ends inverted, as in iSCSI
/// (RFC 3720, appendix B.4). Cost: a table of 1 KiB, a look-up a byte.
class Crc32c {
 public:
  constexpr void take(const std::uint8_t* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) state_ = step(state_, bytes[i]);
  }
  /// As many zero bytes: what a checksum counts in its own place.
  constexpr void take_zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) state_ = step(state_, 0);
  }
  [[nodiscard]] constexpr std::uint32_t value() const { return ~state_; }

  /// What one byte makes of a state. Linear over exclusive-or in both arguments together, so that the effect of a changed
  /// bit can be followed without the other bytes.
  [[nodiscard]] static constexpr std::uint32_t step(std::uint32_t state, std::uint8_t byte) {
    return (state >> 8) ^ kTable.of[(state ^ byte) & 0xFFu];
  }

 private:
  struct Table { std::uint32_t of[256]; };
  static constexpr Table kTable = [] {
    Table table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t x = i;
      for (int k = 0; k < 8; ++k) x = (x >> 1) ^ ((x & 1u) != 0 ? 0x82F63B78u : 0u);
      table.of[i] = x;
    }
    return table;
  }();

  std::uint32_t state_ = 0xFFFFFFFFu;
};

}  // namespace mts
