// What happens if several rules of a level write one cell: zero-order Takagi-Sugeno. Part of runtime/engine.h.
//
//   cf_X := sum(alpha_r * v_r) / sum(alpha_r)     over the fired rules r that write v_r to X
//
// If all writers agree, that value is taken as it is; the strengths alpha are computed only if they do not.
#pragma once

#include "engine.h"

namespace mts {

template <class S, class T>
inline bool Engine<S, T>::clears([[maybe_unused]] std::uint32_t rule, [[maybe_unused]] std::uint32_t cell) const {
  if constexpr (!kCompact) {
    if (t->group_of == nullptr || t->group_of[cell - shape().facts] == 0) return false;
    const std::uint32_t group = t->group_of[cell - shape().facts] - 1u;
    for (std::uint32_t i = t->rules[rule].clears; i < t->rules[rule + 1].clears; ++i) {
      if (t->clears[i] == group) return true;
    }
  }
  return false;
}

/// Whether the rule writes the satellite, and what: by a write of its own, else -1 by clearing its group, else by `reset`.
template <class S, class T>
inline bool Engine<S, T>::writes(std::uint32_t rule, std::uint32_t level, std::uint32_t cell, float& value) const {
  const auto [begin, end] = writes_of(rule);
  std::uint32_t low = begin, high = end;
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (t->writes[middle].cell < cell) low = middle + 1;
    else high = middle;
  }
  if (low < end && t->writes[low].cell == cell) {
    value = t->values[t->writes[low].value];
    return true;
  }
  if (clears(rule, cell)) {
    value = -1.0f;
    return true;
  }
  if (resets(rule, level) && !bits::test(t->keep, cell - shape().facts)) {
    value = t->initial[cell - shape().facts];
    return true;
  }
  return false;
}

template <class S, class T>
inline bool Engine<S, T>::blended(std::uint32_t cell) const {
  for (std::uint32_t i = 0; i < s.blends; ++i) {
    if (blend_cell(i) == cell) return true;
  }
  return false;
}

/// Notes the cell for blending if its writers in this level do not all write the same.
template <class S, class T>
inline void Engine<S, T>::compare_writers(std::uint32_t level, std::uint32_t first, std::uint32_t cell) {
  bool any = false;
  float common = 0.0f, value = 0.0f;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    if (!writes(s.fired_list[i], level, cell, value)) continue;
    if (any && !same(value, common)) return note_blend(cell);
    any = true;
    common = value;
  }
}

/// Finds the cells that need blending, and fills `written_set` with the satellites that the fired rules write themselves.
template <class S, class T>
inline void Engine<S, T>::find_blends(std::uint32_t level, std::uint32_t first) {
  if (s.fired == first + 1u) return each_written(first, [&](std::uint32_t satellite, std::uint32_t) { bits::set(s.written_set, satellite); });
  bool clearing = false, resetting = false;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    clearing = clearing || has_clears(rule);
    resetting = resetting || resets(rule, level);
  }
  each_written(first, [&](std::uint32_t satellite, [[maybe_unused]] std::uint32_t value) __attribute__((always_inline)) {
    const std::uint32_t cell = shape().facts + satellite;
    const bool again = bits::test(s.written_set, satellite);
    bits::set(s.written_set, satellite);
    if (resetting || (clearing && t->group_of[satellite] != 0)) {
      if (!blended(cell)) compare_writers(level, first, cell);
    } else if constexpr (kCompact) {
      if (again && !blended(cell)) compare_writers(level, first, cell);
    } else if (Change<Ix>& noted = s.changes[satellite]; !again) {   // the list is made only when the tick ends, so it is free here
      noted = {static_cast<Ix>(value), 0.0f};
    } else if (noted.cell != value && noted.value == 0.0f) {
      noted.value = 1.0f;
      note_blend(cell);
    }
  });
  // Two resets, one of which also clears a large group, may disagree about cells that neither of them names.
  if (!clearing || shape().groups == 0 || !resets(s.fired_list[first], level)) return;
  for (std::uint32_t i = 0; i < shape().satellites; ++i) {
    if (!bits::test(s.written_set, i)) {
      const std::uint32_t blends = s.blends;
      compare_writers(level, first, shape().facts + i);
      if (s.blends != blends) bits::set(s.written_set, i);
    }
  }
}

/// Computes the i-th blend; if its writers contradict each other, reports the conflict and marks them.
///
/// Products and sums are in double: the product of two floats is exact there, so contraction cannot change the result. In
/// compact form, where values are -1, 0 and 1, alpha is a whole number of 2^-24 and so are the sums: see whole_ratio.
template <class S, class T>
inline void Engine<S, T>::blend(std::uint32_t level, std::uint32_t first, std::uint32_t i) {
  const std::uint32_t cell = blend_cell(i);
  std::conditional_t<T::kWholeValues, std::int64_t, double> sum{}, weight{};
  bool raised = false, lowered = false;
  float value = 0.0f;
  for (std::uint32_t f = first; f < s.fired; ++f) {
    const std::uint32_t rule = s.fired_list[f];
    if (!writes(rule, level, cell, value)) continue;
    const bool up = !at_least(0.0f, value), down = !at_least(value, 0.0f);
    if constexpr (T::kWholeValues) {
      const std::int64_t alpha = compact::in_2_to_minus_24(strength(rule));
      sum += up ? alpha : down ? -alpha : 0;
      weight += alpha;
    } else {
      const double alpha = static_cast<double>(strength(rule));
      sum += alpha * static_cast<double>(value);
      weight += alpha;
    }
    raised = raised || up;
    lowered = lowered || down;
  }
  if constexpr (T::kWholeValues) set_blend(i, compact::whole_ratio(sum, weight));
  else set_blend(i, static_cast<float>(sum / weight));
  if (raised && lowered) contradict(level, first, cell);
}

template <class S, class T>
inline void Engine<S, T>::contradict(std::uint32_t level, std::uint32_t first, std::uint32_t cell) {
  s.conflict_list[s.conflicts++] = {static_cast<Ix>(cell), static_cast<Ix>(level)};
  s.busy = true;
  float value = 0.0f;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    if (!writes(rule, level, cell, value)) continue;
    const Place at = place(rule, level);
    s.rules[at.word].bad |= at.bit;
  }
}

/// Degree of a literal that is no node, or a negated one.
template <class S, class T>
inline float Engine<S, T>::leaf_degree(std::uint32_t l) const {
  if ((l & 1u) != 0) return literal(l) ? 1.0f : 0.0f;
  return term_of(l >> 1);
}

/// Degree of a literal: a term's membership, the minimum over an `and`, the maximum over an `or`; 1 or 0 for everything else, also
/// for negations. Walks nodes with a stack of its own (see kMaxDepth).
template <class S, class T>
inline float Engine<S, T>::degree(std::uint32_t root) const {
  if (shape().nodes == 0) return leaf_degree(root);
  struct Frame { float value; J node, child; };
  Frame stack[kStackDepth];
  std::uint32_t depth = 0;
  const std::uint32_t first_node = shape().first_node();
  const auto leaf = [&](std::uint32_t l) { return (l & 1u) != 0 || (l >> 1) < first_node; };
  std::uint32_t l = root;
  for (;;) {
    float result = 0.0f;
    if (!leaf(l) && depth < kStackDepth) {
      const std::uint32_t node = (l >> 1) - first_node;
      stack[depth++] = {t->is_and[node] ? 1.0f : 0.0f, static_cast<J>(node), static_cast<J>(t->child_begin[node])};
    } else {
      result = leaf_degree(l);
      if (depth == 0) return result;
      raise_or_lower(stack[depth - 1].value, result, t->is_and[stack[depth - 1].node]);
    }
    while (stack[depth - 1].child == t->child_begin[stack[depth - 1].node + 1]) {
      result = stack[--depth].value;
      if (depth == 0) return result;
      raise_or_lower(stack[depth - 1].value, result, t->is_and[stack[depth - 1].node]);
    }
    l = t->children[stack[depth - 1].child++];
  }
}

/// alpha of a rule that fires: the minimum over its conditions, never below `firing`.
template <class S, class T>
inline float Engine<S, T>::strength(std::uint32_t rule) const {
  float alpha = 1.0f;
  const auto [begin, end] = conditions_of(rule);
  for (std::uint32_t i = begin; i < end; ++i) raise_or_lower(alpha, degree(t->conditions[i]), true);
  return at_least(alpha, t->firing) ? alpha : t->firing;
}

}  // namespace mts
