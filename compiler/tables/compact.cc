#include "compiler/tables/compact.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include <waymark/runtime/compact_state.h>

namespace kb::tables {
namespace {

/// The most cells that the rules of one level may have to blend because they write different values to them.
std::uint32_t most_blends(const Tables& t) {
  std::uint32_t most = 0;
  for (const mts::Level<I>& level : t.levels) {
    if (level.first_word == level.end_word) continue;
    const I begin = t.word_rule[level.first_word];
    const I end = level.end_word < t.word_rule.size() ? t.word_rule[level.end_word] : static_cast<I>(t.rules.size() - 1);
    std::map<I, std::set<I>> values;
    std::size_t resets = 0;
    for (I r = begin; r < end; ++r) {
      const I offset = r - begin;
      resets += t.reset_rules[level.first_word + offset / mts::kWordBits] >> (offset % mts::kWordBits) & 1u;
      for (I k = t.rules[r].writes; k < t.rules[r + 1].writes; ++k) values[t.writes[k].cell].insert(t.writes[k].value);
    }
    // Two resets may disagree about every cell that one of them writes.
    const auto blended = [&](const auto& cell) { return cell.second.size() > 1 || resets > 1; };
    most = std::max(most, static_cast<std::uint32_t>(std::count_if(values.begin(), values.end(), blended)));
  }
  return most;
}

template <class Ix>
std::size_t state_bytes(const mts::Shape& shape, const mts::CompactShape& bounds) {
  using namespace mts;   // for the types in the macro
  std::size_t total = sizeof(Scalars<Ix>);
  const auto add = [&total](std::size_t align, std::size_t row, std::size_t length) {
    total = (total + align - 1) / align * align + row * std::max<std::size_t>(length, 1);
  };
  if (shape.words > kWordBits) add(alignof(Word), 2 * sizeof(Word), Shape::summary_for(shape.words));
#define KB_ARRAY(name, type, length) add(alignof(type), sizeof(type), length);
  MTS_COMPACT_ARRAYS(KB_ARRAY)
#undef KB_ARRAY
  return (total + alignof(Scalars<Ix>) - 1) / alignof(Scalars<Ix>) * alignof(Scalars<Ix>);
}

}  // namespace

std::size_t compact_state_bytes(const mts::Shape& shape, const mts::CompactShape& bounds) {
  const std::uint32_t most = mts::compact::largest(shape);
  if (most <= 0xFF) return state_bytes<std::uint8_t>(shape, bounds);
  return most <= 0xFFFF ? state_bytes<std::uint16_t>(shape, bounds) : state_bytes<std::uint32_t>(shape, bounds);
}

mts::CompactShape compact_shape(const Tables& t) {
  std::set<I> written;
  for (const mts::Write<I>& w : t.writes) {
    if (w.cell < t.shape.facts + t.shape.satellites) written.insert(w.cell);
  }
  return {.written = static_cast<std::uint32_t>(written.size()), .blends = most_blends(t)};
}

std::string against_compact(const Tables& t, const program::Program& program) {
  if (!program.perception.perceived.empty()) return "facts that are perceived";
  if (t.shape.groups != 0) return "an `exclusive` group of more than 64 members";
  if (t.shape.words > mts::kMostCompactWords || !t.broad.empty()) {
    return fmt::format("{} rules in {} words of 32; the compact form holds {} words", t.shape.rules, t.shape.words,
                       mts::kMostCompactWords);
  }
  constexpr std::uint32_t kMostUs = 0x7FFF'FFFF;
  if (std::any_of(t.queue_us.begin(), t.queue_us.end(), [](std::uint32_t us) { return us > kMostUs; })) {
    return "a `for` of more than 35 minutes";
  }
  return {};
}

}  // namespace kb::tables
