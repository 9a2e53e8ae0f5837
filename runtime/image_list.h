// Lists of a mind whose indexes have 2 or 4 bytes, which is known only when an image is taken.
#pragma once

#include <cstddef>
#include <cstdint>

#include "list_iterator.h"
#include "state.h"

namespace mts {

namespace detail {
[[nodiscard]] constexpr std::uint32_t widened(std::uint16_t number) { return number; }
[[nodiscard]] constexpr Change<std::uint32_t> widened(const Change<std::uint16_t>& change) { return {change.cell, change.value}; }
[[nodiscard]] constexpr Conflict<std::uint32_t> widened(const Conflict<std::uint16_t>& conflict) { return {conflict.cell, conflict.level}; }
}  // namespace detail

/// What a tick of an ImageMind says, item by item: numbers, `Change<std::uint32_t>` or `Conflict<std::uint32_t>`. Valid until the mind's
/// next tick, its next image, its reset or its end. `Narrow` and `Wide` are the rows that the mind keeps; without `kWide` only the former.
template <class Narrow, class Wide, bool kWide>
class ImageList {
 public:
  using Item = Wide;
  using Iterator = ListIterator<ImageList, Item>;

  constexpr ImageList() = default;
  constexpr ImageList(const Narrow* rows, std::size_t size) : narrow_(rows), size_(size) {}
  constexpr ImageList(const Wide* rows, std::size_t size) requires(kWide) : wide_(rows), size_(size) {}

  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr Item operator[](std::size_t i) const {
    if constexpr (kWide) {
      if (wide_ != nullptr) return wide_[i];
    }
    return detail::widened(narrow_[i]);
  }
  [[nodiscard]] constexpr Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] constexpr Iterator end() const { return {*this, size_}; }

 private:
  const Narrow* narrow_ = nullptr;
  const Wide* wide_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace mts
