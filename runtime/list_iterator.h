// An iterator for those lists of a tick whose items are made only when they are asked for.
#pragma once

#include <cstddef>

namespace mts {

/// A forward iterator over `Items`, a list of `Item` as small as one to three pointers. It holds a copy of the list, so it may outlive the
/// list, but not what the list shows. For range-based `for`, and for algorithms and containers of the standard library.
template <class Items, class Item>
class ListIterator {
 public:
  using value_type = Item;
  using difference_type = std::ptrdiff_t;

  constexpr ListIterator() = default;
  constexpr ListIterator(const Items& items, std::size_t at) : items_(items), at_(at) {}
  [[nodiscard]] constexpr Item operator*() const { return items_[at_]; }
  constexpr ListIterator& operator++() {
    ++at_;
    return *this;
  }
  constexpr ListIterator operator++(int) {
    const ListIterator before = *this;
    ++at_;
    return before;
  }
  /// Only for two iterators over the same list.
  [[nodiscard]] constexpr bool operator==(const ListIterator& other) const { return at_ == other.at_; }

 private:
  Items items_;
  std::size_t at_ = 0;
};

}  // namespace mts
