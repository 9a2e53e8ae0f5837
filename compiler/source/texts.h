// Texts that a compilation makes, and short lists. Both come by the million, so neither allocates each item separately.
#pragma once

#if defined(__GNUC__) && !defined(__clang__)   // a list is moved with the bytes that it does not use, and g++ 12 minds
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <absl/container/inlined_vector.h>
#pragma GCC diagnostic pop
#else
#include <absl/container/inlined_vector.h>
#endif

#include <algorithm>
#include <initializer_list>
#include <memory_resource>
#include <string_view>
#include <vector>

namespace kb::source {

/// Keeps texts until it is destroyed, one after another in a few large pieces; none is moved or freed before. Not for two
/// threads at once. Cost of `keep`: that of the copy.
class Texts {
 public:
  /// The parts, one after another, as one text.
  [[nodiscard]] std::string_view keep(std::initializer_list<std::string_view> parts) {
    std::size_t size = 0;
    for (const std::string_view part : parts) size += part.size();
    char* const begin = static_cast<char*>(memory_.allocate(std::max<std::size_t>(size, 1), 1));
    char* end = begin;
    for (const std::string_view part : parts) end = std::copy(part.begin(), part.end(), end);
    return {begin, size};
  }
  [[nodiscard]] std::string_view keep(std::string_view text) { return keep({text}); }

 private:
  std::pmr::monotonic_buffer_resource memory_;
};

/// A list that mostly has N items or fewer: up to N are stored inline, more on the heap.
template <class T, std::size_t N>
using Few = absl::InlinedVector<T, N>;

/// Empties the list and gives its memory back, which `items = {}` would keep.
template <class T>
void release(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

/// Sorts the items, and keeps one of those that are equal.
template <class T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace kb::source
