// Several rules of one level that write one cell: zero-order Takagi-Sugeno (mts.md section 4). Part of runtime/engine.h.
//
//   cf_X := sum(alpha_r * v_r) / sum(alpha_r)     over the fired rules r that write v_r to X
//
// Writers that agree give the value itself; the strength alpha is computed only where they do not.
#pragma once

#include "runtime/engine.h"

namespace mts {

template <class S, class T>
inline bool Engine<S, T>::clears(std::uint32_t rule, std::uint32_t cell) const {
  if (t->group_of == nullptr || t->group_of[cell - shape().facts] == 0) return false;
  const std::uint32_t group = t->group_of[cell - shape().facts] - 1u;
  for (std::uint32_t i = t->rules[rule].clears; i < t->rules[rule + 1].clears; ++i) {
    if (t->clears[i] == group) return true;
  }
  return false;
}

/// Whether the rule writes the satellite, and what: its own write, else -1 by clearing its group, else by `reset`.
template <class S, class T>
inline bool Engine<S, T>::writes(std::uint32_t rule, std::uint32_t level, std::uint32_t cell, float& value) const {
  std::uint32_t low = t->rules[rule].writes, high = t->rules[rule + 1].writes;
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (t->writes[middle].cell < cell) low = middle + 1;
    else high = middle;
  }
  if (low < t->rules[rule + 1].writes && t->writes[low].cell == cell) {
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
    if (s.blend_list[i].cell == cell) return true;
  }
  return false;
}

/// Blends the cell if its writers in this level do not all write the same.
template <class S, class T>
inline void Engine<S, T>::compare_writers(std::uint32_t level, std::uint32_t first, std::uint32_t cell) {
  bool any = false;
  float common = 0.0f, value = 0.0f;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    if (!writes(s.fired_list[i], level, cell, value)) continue;
    if (any && value != common) return blend(level, first, cell);
    any = true;
    common = value;
  }
}

/// Finds the cells that need blending, and fills `written_set` with the satellites that the fired rules write themselves.
template <class S, class T>
inline void Engine<S, T>::find_blends(std::uint32_t level, std::uint32_t first) {
  const bool several = s.fired > first + 1u;
  bool background = false;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    background = background || t->rules[rule].clears != t->rules[rule + 1].clears || resets(rule, level);
  }
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    for (std::uint32_t k = t->rules[rule].writes; k < t->rules[rule + 1].writes; ++k) {
      const std::uint32_t cell = t->writes[k].cell;
      const std::uint32_t satellite = cell - shape().facts;
      if (satellite >= shape().satellites) continue;
      const bool again = bits::test(s.written_set, satellite);
      bits::set(s.written_set, satellite);
      if (several && (again || background) && !blended(cell)) compare_writers(level, first, cell);
    }
  }
  // Two resets, one of which clears a large group, may disagree about cells that neither names.
  if (!several || !background || shape().groups == 0 || !resets(s.fired_list[first], level)) return;
  for (std::uint32_t i = 0; i < shape().satellites; ++i) {
    if (!bits::test(s.written_set, i)) {
      const std::uint32_t blends = s.blends;
      compare_writers(level, first, shape().facts + i);
      if (s.blends != blends) bits::set(s.written_set, i);
    }
  }
}

/// Computes the blend of one cell and, if its writers contradict each other, reports the conflict and marks them.
/// Products and sums are in double: the product of two floats is exact there, so contraction cannot change the result.
template <class S, class T>
inline void Engine<S, T>::blend(std::uint32_t level, std::uint32_t first, std::uint32_t cell) {
  double sum = 0.0, weight = 0.0;
  bool raised = false, lowered = false;
  float value = 0.0f;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    if (!writes(rule, level, cell, value)) continue;
    const double alpha = static_cast<double>(strength(rule));
    sum += alpha * static_cast<double>(value);
    weight += alpha;
    raised = raised || value > 0.0f;
    lowered = lowered || value < 0.0f;
  }
  s.blend_list[s.blends++] = {static_cast<I>(cell), static_cast<float>(sum / weight)};
  if (!raised || !lowered) return;
  s.conflict_list[s.conflicts++] = {static_cast<I>(cell), static_cast<I>(level)};
  s.busy = true;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const std::uint32_t rule = s.fired_list[i];
    if (!writes(rule, level, cell, value)) continue;
    const Place at = place(rule, level);
    s.bad_rules[at.word] |= at.bit;
  }
}

/// Membership of a term's atom: high(x) = max(0, x), low(x) = max(0, -x), zero(x) = 1 - |x|; other atoms are 0 or 1.
template <class S, class T>
inline float Engine<S, T>::term_degree(std::uint32_t atom) const {
  const std::uint32_t cell = t->atom_cell[atom];
  if (cell >= shape().cells()) return truth(atom) ? 1.0f : 0.0f;
  const float x = s.cf[cell];
  switch (t->atom_term[atom]) {
    case 0: return x < 0.0f ? -x : 0.0f;
    case 1: return 1.0f - (x < 0.0f ? -x : x);
    default: return x > 0.0f ? x : 0.0f;
  }
}

/// Degree of a literal: a term's membership, min over an `and`, max over an `or`; 1 or 0 for everything else, negations
/// among it. Walks nodes with a stack of its own (see kMaxDepth).
template <class S, class T>
inline float Engine<S, T>::degree(std::uint32_t root) const {
  struct Frame { std::uint32_t node, child; float value; };
  Frame stack[kMaxDepth];
  std::uint32_t depth = 0;
  const std::uint32_t first_node = shape().atoms - shape().nodes;
  const auto leaf = [&](std::uint32_t l) { return (l & 1u) != 0 || (l >> 1) < first_node; };
  const auto leaf_degree = [&](std::uint32_t l) {
    return (l & 1u) != 0 ? (literal(l) ? 1.0f : 0.0f) : term_degree(l >> 1);
  };
  const auto push = [&](std::uint32_t l) {
    const std::uint32_t node = (l >> 1) - first_node;
    stack[depth++] = {node, t->child_begin[node], t->is_and[node] != 0 ? 1.0f : 0.0f};
  };
  if (leaf(root)) return leaf_degree(root);
  push(root);
  for (;;) {
    Frame& top = stack[depth - 1];
    const bool is_and = t->is_and[top.node] != 0;
    float result = top.value;
    if (top.child < t->child_begin[top.node + 1]) {
      const std::uint32_t l = t->children[top.child++];
      if (!leaf(l) && depth < kMaxDepth) {
        push(l);
        continue;
      }
      result = leaf_degree(l);
      if (is_and ? result < top.value : result > top.value) top.value = result;
      continue;
    }
    if (--depth == 0) return result;
    Frame& parent = stack[depth - 1];
    const bool parent_and = t->is_and[parent.node] != 0;
    if (parent_and ? result < parent.value : result > parent.value) parent.value = result;
  }
}

/// alpha of a rule that fires: the minimum over its conditions, never below `firing`.
template <class S, class T>
inline float Engine<S, T>::strength(std::uint32_t rule) const {
  float alpha = 1.0f;
  for (std::uint32_t i = t->rules[rule].conditions; i < t->rules[rule + 1].conditions; ++i) {
    const float d = degree(t->conditions[i]);
    if (d < alpha) alpha = d;
  }
  return alpha < t->firing ? t->firing : alpha;
}

}  // namespace mts
