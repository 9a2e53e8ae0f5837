// Verifying an image: cells, atoms, nodes, timers, groups, the state of start-up. Part of runtime/image.h.
#pragma once

#include <initializer_list>

#include "image_check_rules.h"

namespace mts::image {

/// Atoms in order: the two constants, then those of the cells, cell by cell, then timers, then nodes. Checks those of one cell after another: those that are not 0 must be the next ones in some order, each once.
struct NextAtoms {
  std::uint32_t next;
  std::uint32_t count = 0, seen = 0;
  bool good = true;
  void take(std::uint32_t atom) {
    if (atom == 0) return;
    const std::uint32_t place = atom - next;
    if (place >= 6 || (seen >> place & 1u) != 0) good = false;
    else seen |= 1u << place;
    ++count;
  }
  /// To the next cell. False if the atoms of this one have gaps.
  [[nodiscard]] bool close() {
    if (!good || seen != (1u << count) - 1u) return false;
    next += count;
    count = seen = 0;
    return true;
  }
};

template <class Ix>
bool atoms_fit(const Subject<Ix>& s) {
  const Shape& n = s.n();
  NextAtoms atoms{2};
  for (std::uint32_t c = 0; c < n.cells(); ++c) {
    const CellAtoms<Ix>& x = s.t.cell_atoms[c];
    atoms.take(x.high), atoms.take(x.low), atoms.take(x.zero);
    if (c < n.facts) {
      const FactAtoms<Ix>& f = s.t.fact_atoms[c];
      atoms.take(f.seen), atoms.take(f.event), atoms.take(f.lost);
    }
    if (!atoms.close()) return false;
  }
  return atoms.next == s.n().first_timer();
}

/// A fact comes into view above `plain` and stays in view above `attended`: 0 <= attended <= plain <= 1.
template <class Ix>
bool facts_fit(const Subject<Ix>& s) {
  for (std::uint32_t f = 0; f < s.n().facts; ++f) {
    const FactAtoms<Ix>& x = s.t.fact_atoms[f];
    if (!(x.attended >= 0.0f && x.attended <= x.plain && x.plain <= 1.0f)) return false;
  }
  return true;
}

/// Lists laid end to end, whose members ascend and are smaller than `limit`.
template <class Ix>
bool lists_fit(const Ix* begin, std::uint32_t lists, const Ix* members, std::uint32_t count, std::uint32_t limit) {
  if (begin[0] != 0) return false;
  for (std::uint32_t i = 0; i < lists; ++i) {
    if (begin[i + 1] < begin[i] || begin[i + 1] > count) return false;
    for (std::uint32_t k = begin[i]; k < begin[i + 1]; ++k) {
      if (members[k] >= limit || (k > begin[i] && members[k] <= members[k - 1])) return false;
    }
  }
  return begin[lists] == count;
}

/// Whether a literal holds at start-up.
template <class Ix>
[[nodiscard]] bool holds_initially(const Subject<Ix>& s, std::uint32_t literal) {
  return bits::test(s.t.initial_truth, literal >> 1) != ((literal & 1u) != 0);
}

/// A node's parts have smaller numbers than the node, `need` is 1 or the number of parts, and the initial count is that of the parts
/// that hold at start-up. `scratch` by node: first how many of its parts hold, then how many it has.
template <class Ix>
ImageStatus nodes_fit(const Subject<Ix>& s) {
  const std::uint32_t base = s.n().first_node();
  ImageStatus status = ImageStatus::kOk;
  for (std::uint32_t a = 0; a < s.n().atoms && status == ImageStatus::kOk; ++a) {
    for (std::uint32_t i = s.t.atoms[a].parents; i < s.t.atoms[a + 1].parents; ++i) {
      const std::uint32_t parent = s.t.parents[i], node = parent >> 1;
      const bool ascending = i == s.t.atoms[a].parents || parent > s.t.parents[i - 1];
      if (a <= kFalseAtom || node >= s.n().nodes || base + node <= a || !ascending) {
        status = ImageStatus::kNodes;
        break;
      }
      s.scratch[node] += holds_initially(s, a << 1 | (parent & 1u)) ? 1u : 0u;
    }
  }
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) {
    const Word holding = s.scratch[k];
    s.scratch[k] = 0;
    if (status != ImageStatus::kOk) continue;
    const bool truth = holding >= s.t.nodes[k].need;
    if (s.t.initial_count[k] != holding || bits::test(s.t.initial_truth, base + k) != truth) status = ImageStatus::kInitial;
  }
  if (status != ImageStatus::kOk) return status;
  for (std::uint32_t i = 0; i < s.h.parents; ++i) ++s.scratch[s.t.parents[i] >> 1];
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) {
    const Word parts = s.scratch[k];
    s.scratch[k] = 0;
    if (parts == 0 || (s.t.nodes[k].need != 1 && s.t.nodes[k].need != parts)) status = ImageStatus::kNodes;
  }
  return status;
}

/// Strengths are computed by walking through a condition as if it were written out, so a part that two others share is walked twice.
/// No node may need more steps than kMaxDepth times the bytes of the file: otherwise a small file, whose parts are shared again and
/// again, could make a tick take years. `scratch` by node: its steps so far.
template <class Ix>
bool walks_fit(const Subject<Ix>& s) {
  const std::uint32_t base = s.n().first_node();
  const std::uint64_t limit = std::uint64_t{kMaxDepth} * s.h.bytes, most = limit < 0xFFFF'FFFFu ? limit : 0xFFFF'FFFFu;
  bool good = true;
  for (std::uint32_t a = 0; a < s.n().atoms; ++a) {
    const std::uint64_t steps = a < base ? 1u : std::uint64_t{1} + s.scratch[a - base];
    for (std::uint32_t i = s.t.atoms[a].parents; i < s.t.atoms[a + 1].parents; ++i) {
      Word& sum = s.scratch[s.t.parents[i] >> 1];
      good = good && sum + steps <= most;
      if (good) sum += static_cast<Word>(steps);
    }
  }
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) s.scratch[k] = 0;
  return good;
}

/// Stages partition timers and queues, level by level; a queue's timers have one duration; every timer is in the list of
/// the atom that it times.
template <class Ix>
bool timers_fit(const Subject<Ix>& s) {
  std::uint32_t stage = 0, timer = 0, queue = 0;
  for (std::uint32_t l = 0; l < s.n().levels; ++l) {
    const Level<Ix>& level = s.t.levels[l];
    if (level.first_stage == level.end_stage) {
      if (level.first_stage != 0) return false;
      continue;
    }
    if (level.first_stage != stage || level.end_stage < stage || level.end_stage > s.h.stages) return false;
    for (; stage < level.end_stage; ++stage) {
      const Stage<Ix>& x = s.t.stages[stage];
      if (x.first_timer != timer || x.end_timer <= timer || x.end_timer > s.n().timers) return false;
      if (x.first_queue != queue || x.end_queue <= queue || x.end_queue > s.n().queues) return false;
      for (; timer < x.end_timer; ++timer) {
        const std::uint32_t q = s.t.timers[timer].queue;
        if (timer != x.first_timer && q == queue + 1u && q < x.end_queue && s.t.queue_us[q] > s.t.queue_us[queue]) ++queue;
        if (q != queue || s.t.timers[timer].input >> 1 >= s.n().atoms) return false;
      }
      if (++queue != x.end_queue) return false;
    }
  }
  return stage == s.h.stages && timer == s.n().timers && queue == s.n().queues;
}

/// A timer whose condition contains another timer is in a later stage than that one, so no condition contains itself. `scratch` by
/// node: one more than the last stage of the timers in it.
template <class Ix>
bool timers_are_ordered(const Subject<Ix>& s) {
  const std::uint32_t base = s.n().first_node(), timers = s.n().first_timer();
  const auto tell_parents = [&](std::uint32_t atom, Word stage) {
    for (std::uint32_t i = s.t.atoms[atom].parents; i < s.t.atoms[atom + 1].parents; ++i) {
      Word& last = s.scratch[s.t.parents[i] >> 1];
      if (stage > last) last = stage;
    }
  };
  for (std::uint32_t g = 0; g < s.h.stages; ++g) {
    for (std::uint32_t i = s.t.stages[g].first_timer; i < s.t.stages[g].end_timer; ++i) tell_parents(timers + i, g + 1);
  }
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) tell_parents(base + k, s.scratch[k]);
  bool good = true;
  for (std::uint32_t g = 0; g < s.h.stages; ++g) {
    const Stage<Ix>& stage = s.t.stages[g];
    for (std::uint32_t i = stage.first_timer; i < stage.end_timer; ++i) {
      const std::uint32_t atom = s.t.timers[i].input >> 1;
      if (atom >= base) good = good && s.scratch[atom - base] <= g;
      else good = good && (atom < timers || atom - timers < stage.first_timer);
    }
  }
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) s.scratch[k] = 0;
  return good;
}

template <class Ix>
bool timer_inputs_fit(const Subject<Ix>& s) {
  for (std::uint32_t a = 0; a < s.n().atoms; ++a) {
    for (std::uint32_t i = s.t.atoms[a].timers; i < s.t.atoms[a + 1].timers; ++i) {
      const std::uint32_t timer = s.t.timer_inputs[i];
      if (timer >= s.n().timers || s.t.timers[timer].input >> 1 != a) return false;
      if (i > s.t.atoms[a].timers && timer <= s.t.timer_inputs[i - 1]) return false;
    }
  }
  return true;  // there are as many entries as timers and none is there twice, so all are there
}

/// Groups' members are numbered by their slots, in ascending order. `scratch` by group: members so far.
template <class Ix>
bool groups_fit(const Subject<Ix>& s) {
  const Shape& n = s.n();
  if (n.groups == 0) return n.group_members == 0;
  bool good = s.t.group_begin[0] == 0;
  for (std::uint32_t g = 0; g < n.groups; ++g) good = good && s.t.group_begin[g + 1] > s.t.group_begin[g];
  good = good && s.t.group_begin[n.groups] == n.group_members;
  for (std::uint32_t i = 0; good && i < n.satellites; ++i) {
    const std::uint32_t group = s.t.group_of[i];
    if (group == 0) good = s.t.group_slot[i] == 0;
    else good = group <= n.groups && s.t.group_slot[i] == s.scratch[group - 1]++;
  }
  for (std::uint32_t g = 0; g < n.groups; ++g) {
    good = good && s.scratch[g] == static_cast<Word>(s.t.group_begin[g + 1] - s.t.group_begin[g]);
    s.scratch[g] = 0;
  }
  return good;
}

template <class Ix>
bool priority_fits(const Subject<Ix>& s) {
  bool good = true;
  for (std::uint32_t i = 0; i < s.n().strategies; ++i) {
    const std::uint32_t strategy = s.t.priority[i];
    good = good && strategy < s.n().strategies && s.scratch[strategy] == 0;
    if (good) s.scratch[strategy] = 1;
  }
  for (std::uint32_t i = 0; i < s.n().strategies; ++i) s.scratch[i] = 0;
  return good;
}

/// Bits of a set beyond its `count` members.
[[nodiscard]] inline bool has_stray_bits(const Word* set, std::uint32_t count) {
  return count % kWordBits != 0 && (set[count / kWordBits] >> (count % kWordBits)) != 0;
}

/// At start-up facts are 0, satellites have their initial values, strategies are -1; nothing is seen and no timer has run.
/// (Nodes follow: nodes_fit.)
template <class Ix>
bool initial_fits(const Subject<Ix>& s) {
  const Shape& n = s.n();
  const Word* truth = s.t.initial_truth;
  if (has_stray_bits(s.t.keep, n.satellites) || has_stray_bits(truth, n.atoms)) return false;
  for (std::uint32_t i = 0; i < n.satellites; ++i) {
    if (!(s.t.initial[i] >= -1.0f && s.t.initial[i] <= 1.0f)) return false;
  }
  if (!bits::test(truth, kTrueAtom) || bits::test(truth, kFalseAtom)) return false;
  for (std::uint32_t c = 0; c < n.cells(); ++c) {
    const CellAtoms<Ix>& a = s.t.cell_atoms[c];
    const float x = c < n.facts ? 0.0f : c < n.facts + n.satellites ? s.t.initial[c - n.facts] : -1.0f;
    const float distance = 1.0f - (x < 0.0f ? -x : x);
    if (a.high != 0 && bits::test(truth, a.high) != (x >= s.t.firing)) return false;
    if (a.low != 0 && bits::test(truth, a.low) != (x <= -s.t.firing)) return false;
    if (a.zero != 0 && bits::test(truth, a.zero) != (distance >= s.t.firing)) return false;
    if (c >= n.facts) continue;
    const FactAtoms<Ix>& f = s.t.fact_atoms[c];
    for (const Ix sighting : {f.seen, f.event, f.lost}) {
      if (sighting != 0 && bits::test(truth, sighting)) return false;
    }
  }
  for (std::uint32_t a = s.n().first_timer(); a < s.n().first_node(); ++a) {
    if (bits::test(truth, a)) return false;
  }
  return true;
}

/// `atom_cell` and `atom_term`, which say for each atom of which cell it is which term, must agree with `cell_atoms`. An atom that is no
/// term has the number of cells, and 2.
template <class Ix>
bool atom_terms_fit(const Subject<Ix>& s) {
  const std::uint32_t cells = s.n().cells();
  std::uint32_t terms = 0, named = 0;
  for (std::uint32_t a = 0; a < s.n().atoms; ++a) {
    const std::uint32_t cell = s.t.atom_cell[a], term = s.t.atom_term[a];
    if (cell > cells || term > 2 || (cell == cells && term != 2)) return false;
    if (cell == cells) continue;
    ++named;
    const CellAtoms<Ix>& x = s.t.cell_atoms[cell];
    if (a != (term == 2 ? x.high : term == 0 ? x.low : x.zero)) return false;
  }
  for (std::uint32_t c = 0; c < cells; ++c) {
    const CellAtoms<Ix>& x = s.t.cell_atoms[c];
    terms += (x.high != 0 ? 1u : 0u) + (x.low != 0 ? 1u : 0u) + (x.zero != 0 ? 1u : 0u);
  }
  return terms == named;
}

/// `children` must be the inverse of `parents`, in ascending order. `scratch` by node: children so far.
template <class Ix>
bool children_fit(const Subject<Ix>& s) {
  if (s.h.children != s.h.parents || s.t.child_begin[0] != 0) return false;
  bool good = true;
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) {
    const std::uint32_t begin = s.t.child_begin[k], end = s.t.child_begin[k + 1];
    good = good && begin <= end && end <= s.h.children;
    // A node with a single part counts as an `and`.
    if (good) good = s.t.is_and[k] == (s.t.nodes[k].need == end - begin ? 1 : 0);
  }
  good = good && s.t.child_begin[s.n().nodes] == s.h.children;
  for (std::uint32_t a = 0; good && a < s.n().atoms; ++a) {
    for (std::uint32_t i = s.t.atoms[a].parents; good && i < s.t.atoms[a + 1].parents; ++i) {
      const std::uint32_t node = s.t.parents[i] >> 1;
      const std::uint32_t at = s.t.child_begin[node] + s.scratch[node]++;
      good = at < s.t.child_begin[node + 1] && s.t.children[at] == (a << 1 | (s.t.parents[i] & 1u));
    }
  }
  for (std::uint32_t k = 0; k < s.n().nodes; ++k) s.scratch[k] = 0;
  return good;
}

}  // namespace mts::image
