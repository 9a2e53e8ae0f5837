// Verifying an image: names, and the order in which they are found. Part of runtime/image.h.
#pragma once

#include "image_layout.h"

namespace mts::image {

/// Names as an image holds them.
struct NameTables {
  const std::uint32_t* begin = nullptr;
  const std::uint32_t* order = nullptr;
  const TimerKey* timer_key = nullptr;
  const std::uint32_t* timer_order = nullptr;
  const char* bytes = nullptr;
};

/// Like strcmp: compares unsigned bytes. Both texts end with a zero.
[[nodiscard]] constexpr int compare(const char* a, const char* b) {
  for (;; ++a, ++b) {
    const auto x = static_cast<unsigned char>(*a), y = static_cast<unsigned char>(*b);
    if (x != y) return x < y ? -1 : 1;
    if (x == 0) return 0;
  }
}

/// Length in bytes of the character that begins here; 0 if it is a control character or no UTF-8 (RFC 3629). The bytes end with a
/// zero, which ends every sequence.
[[nodiscard]] constexpr std::uint32_t character(const char* at) {
  const auto byte = [at](int i) { return static_cast<unsigned char>(at[i]); };
  const auto more = [&byte](int i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  if (first < 0xC2 || first > 0xF4 || !more(1)) return 0;
  if (first < 0xE0) return 2;
  if (!more(2)) return 0;
  const unsigned second = byte(1);
  if (first < 0xF0) return (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ? 0 : 3;
  if (!more(3) || (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  return 4;
}

/// Each name consists of some characters and a zero, and the next one follows.
[[nodiscard]] inline bool texts_fit(const ImageHead& h, const NameTables& t) {
  if (t.begin[0] != 0 || t.begin[h.names()] != h.name_bytes) return false;
  for (std::uint32_t i = 0; i < h.names(); ++i) {
    const std::uint32_t begin = t.begin[i], end = t.begin[i + 1];
    if (end <= begin || end - begin < 2 || end > h.name_bytes || t.bytes[end - 1] != 0) return false;
    std::uint32_t at = begin;
    while (at < end - 1) {
      const std::uint32_t length = character(t.bytes + at);
      if (length == 0) return false;
      at += length;
    }
    if (at != end - 1) return false;
  }
  return true;
}

/// The names from `first` on must be in ascending order. Names that may repeat (those of rules) are then ordered by number.
[[nodiscard]] inline bool order_fits(const NameTables& t, std::uint32_t first, std::uint32_t count, bool repeat) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    const std::uint32_t name = t.order[i];
    if (name < first || name - first >= count) return false;
    if (i == first) continue;
    const int before = compare(t.bytes + t.begin[t.order[i - 1]], t.bytes + t.begin[name]);
    if (before > 0 || (before == 0 && (!repeat || name <= t.order[i - 1]))) return false;
  }
  return true;
}

[[nodiscard]] inline bool timer_order_fits(const NameTables& t, std::uint32_t timers) {
  for (std::uint32_t i = 0; i < timers; ++i) {
    if (t.timer_order[i] >= timers) return false;
    if (i == 0) continue;
    const TimerKey &before = t.timer_key[t.timer_order[i - 1]], &here = t.timer_key[t.timer_order[i]];
    if (here.before(before) || (here == before && t.timer_order[i] <= t.timer_order[i - 1])) return false;
  }
  return true;
}

[[nodiscard]] inline bool names_fit(const ImageHead& h, const NameTables& t) {
  const Shape& n = h.shape;
  return texts_fit(h, t) && order_fits(t, 0, n.facts, false) && order_fits(t, n.facts, n.satellites, false) &&
         order_fits(t, n.facts + n.satellites, n.strategies, false) && order_fits(t, n.cells(), n.rules, true) &&
         order_fits(t, n.cells() + n.rules, n.levels, false) && timer_order_fits(t, n.timers);
}

}  // namespace mts::image
