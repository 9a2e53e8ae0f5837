// Shared by all builders of tables: indexes, bits, lists laid end to end.
#pragma once

#include <cstddef>
#include <vector>

#include <waymark/runtime/bits.h>
#include <waymark/runtime/table.h>
#include "compiler/tables/form.h"

namespace kb::tables {

[[nodiscard]] inline I number(std::size_t n) { return static_cast<I>(n); }
/// Rounded once, from the double that the compiler computed.
[[nodiscard]] inline float to_float(double x) { return static_cast<float>(x); }

/// Lists of items by an index, laid end to end: the shape of most tables. The items are kept in order of
/// arrival, whatever list they belong to, and laid out by counting; no list allocates memory of its own.
template <class T>
class Lists {
 public:
  explicit Lists(std::size_t n) : last_(n, kNone), size_(n, 0) {}

  void add(std::size_t list, T item) {
    last_[list] = number(items_.size());
    ++size_[list];
    items_.push_back({number(list), item});
  }
  /// The item that was added to the list last, or null.
  [[nodiscard]] T* last(std::size_t list) { return last_[list] == kNone ? nullptr : &items_[last_[list]].item; }

  /// Appends all lists to `items`; the beginning of each, and the end of the last.
  [[nodiscard]] std::vector<I> flatten(std::vector<T>& items) const {
    std::vector<I> begin;
    begin.reserve(size_.size() + 1);
    std::size_t end = items.size();
    for (std::size_t list = 0; list < size_.size(); ++list) {
      begin.push_back(number(end));
      end += size_[list];
    }
    begin.push_back(number(end));
    items.resize(end);
    std::vector<I> next(begin.begin(), begin.end() - 1);
    for (const Entry& entry : items_) items[next[entry.list]++] = entry.item;
    return begin;
  }

 private:
  static constexpr I kNone = 0xFFFFFFFFu;
  struct Entry { I list; T item; };
  std::vector<Entry> items_;
  std::vector<I> last_, size_;   // by list
};

/// The literals of each node, in the order of atoms. Read from the parents, which every form of the tables has.
[[nodiscard]] inline std::vector<std::vector<I>> parts_of_nodes(const Tables& t) {
  std::vector<std::vector<I>> parts(t.shape.nodes);
  for (I a = 0; a < t.shape.atoms; ++a) {
    for (I i = t.atoms[a].parents; i < t.atoms[a + 1].parents; ++i) parts[t.parents[i] >> 1].push_back(a << 1 | (t.parents[i] & 1u));
  }
  return parts;
}

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
