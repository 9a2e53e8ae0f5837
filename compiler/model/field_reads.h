// Which fields of rows a reference or a condition reads: rows may be written in any order, and say what other rows say.
#pragma once

#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {

struct FieldPlace {
  RowId row = RowId::kNone;
  std::size_t field = 0;
};

/// The fields that a reference or a condition reads, as far as the rows on the way are known. `leg`: what `leg` stands for in it.
[[nodiscard]] std::vector<FieldPlace> fields_read(const Draft& draft, const syntax::Tree& tree, syntax::RefId ref, RowId leg = RowId::kNone);
[[nodiscard]] std::vector<FieldPlace> fields_read(const Draft& draft, const syntax::Tree& tree, syntax::CondId cond, RowId leg);

/// Makes `count` things, each after those that it needs. `need(i)` is one that `i` still needs, or kNone32; `make(i)` makes it; `circle(i)` is
/// called instead if `i` needs itself. After either, nothing needs `i` any more. Things that need nothing are made in their order. Without
/// recursion.
template <class Need, class Make, class Circle>
void make_in_order_of_need(std::size_t count, Need&& need, Make&& make, Circle&& circle) {
  enum class State : std::uint8_t { kNew, kBegun, kOver };
  std::vector<State> states(count, State::kNew);
  std::vector<std::uint32_t> begun;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (states[first] == State::kNew) begun.push_back(first);
    while (!begun.empty()) {
      const std::uint32_t one = begun.back();
      states[one] = State::kBegun;
      const std::uint32_t next = need(one);
      if (next != kNone32 && states[next] == State::kNew) {
        begun.push_back(next);
        continue;
      }
      if (next != kNone32) circle(one);
      else make(one);
      states[one] = State::kOver;
      begun.pop_back();
    }
  }
}

}  // namespace kb::model
