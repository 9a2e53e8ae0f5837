// A number that tells one text, or one set of texts, from another. Against mistakes, not against malice.
#pragma once

#include <cstdint>
#include <string_view>

namespace kb::source {

/// FNV-1a with 64 bits (Fowler, Noll, Vo).
class Fingerprint {
 public:
  void mix(std::string_view bytes) {
    for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325ull;
};

}  // namespace kb::source
