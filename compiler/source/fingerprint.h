// A number that tells one text, or one set of texts, from another. It guards against mistakes, not against malice.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace kb::source {

/// FNV-1a with 64 bits (Fowler, Noll, Vo).
class Fingerprint {
 public:
  void mix(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001B3ull;
  }
  void mix(std::string_view text) { mix({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }
  /// Its length too, so that bytes of one file cannot pass for those of the next.
  void mix_file(std::string_view bytes) {
    mix(std::to_string(bytes.size()) + "\n");
    mix(bytes);
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325ull;
};

}  // namespace kb::source
