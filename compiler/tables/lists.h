// What all builders of tables use: indexes, bits, lists laid end to end.
#pragma once

#include <cstddef>
#include <vector>

#include "compiler/tables/form.h"
#include "runtime/bits.h"
#include "runtime/table.h"

namespace kb::tables {

[[nodiscard]] inline I number(std::size_t n) { return static_cast<I>(n); }
/// Rounded once, from the double that the compiler computed.
[[nodiscard]] inline float to_float(double x) { return static_cast<float>(x); }

/// Lists of items by an index, laid end to end: the shape of most tables.
template <class T>
struct Lists {
  explicit Lists(std::size_t n) : of(n) {}
  std::vector<std::vector<T>> of;
  /// Appends all lists to `items`; the beginning of each, and the end of the last.
  [[nodiscard]] std::vector<I> flatten(std::vector<T>& items) const {
    std::vector<I> begin;
    begin.reserve(of.size() + 1);
    for (const auto& list : of) {
      begin.push_back(number(items.size()));
      items.insert(items.end(), list.begin(), list.end());
    }
    begin.push_back(number(items.size()));
    return begin;
  }
};

inline void set_bit(std::vector<mts::Word>& words, std::size_t i) {
  words[i / mts::kWordBits] |= mts::Word{1} << (i % mts::kWordBits);
}
[[nodiscard]] inline bool test_bit(const std::vector<mts::Word>& words, std::size_t i) {
  return (words[i / mts::kWordBits] >> (i % mts::kWordBits) & 1u) != 0;
}
[[nodiscard]] inline std::vector<mts::Word> words_for(std::size_t bits) {
  return std::vector<mts::Word>(mts::Shape::words_for(number(bits)) + (bits == 0 ? 1 : 0), 0);
}

}  // namespace kb::tables
