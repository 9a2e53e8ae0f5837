// The tables of a knowledge base in half the flash. The C++ compiler makes them from the ordinary tables while it compiles the
// emitted source; the engine reads them through the same names.
//
// note [compact tables]
//   Of a mask of 32 rules mostly only one byte is not 0. Only such bytes are kept, each with its place, and all those of an atom in
//   one list. Rules that write the same share one list. An index takes as many bytes as the largest of its array needs. What a search
//   finds soon enough is not kept at all: which cell a term belongs to, which satellites draw attention. What all rows have in common
//   is a constant in the code. Reading costs some instructions more, so programs for large machines keep the ordinary tables.
//   A C++ compiler counts the steps of each constant (clang: to a million), so each is computed in one pass over what it is made of.
#pragma once

#include <bit>
#include <cstdint>

#include "bits.h"
#include "compact_arrays.h"
#include "table.h"

namespace mts {

/// The largest number of words of rules that compact tables can hold.
inline constexpr std::uint32_t kMostCompactWords = 64;

/// Bounds that determine the size of a compact mind's memory. The compiler emits them.
struct CompactShape {
  std::uint32_t written = 0;  ///< satellites that some rule writes; the others keep their initial value for ever
  std::uint32_t blends = 0;   ///< cells that rules of one level write differently, in the level that has most of them
};

/// The tables of `K` as the engine reads them. Only where `K::kTables` is a constant: in the emitted source.
template <class K>
class CompactTables {
 public:
  using Ix = typename K::Index;
  using Knowledge = K;
  static constexpr bool kCompact = true;

  /// How a rule follows from an atom.
  enum class Effect : std::uint32_t { kWhenTrue, kWhenFalse, kKey };

 private:
  static constexpr const Tables<Ix>& kFull = K::kTables;
  static constexpr Shape kN = K::kShape;
  static_assert(kN.words <= kMostCompactWords, "too many rules for compact tables: compile the knowledge base without --compact");
  static_assert(kN.groups == 0 && kFull.broad == nullptr,
                "this knowledge base is too large for compact tables: compile it without --compact");

  // ---- what follows from an atom: rules that read it (as good news when true, when false), rules that sleep under it
  static constexpr std::uint32_t kEffects = [] {
    std::uint32_t n = 0;
    for (std::uint32_t i = 0; i < kFull.atoms[kN.atoms].readers; ++i) {
      const Readers<Ix>& r = kFull.readers[i];
      n += compact::bytes_of(r.good[0]) + compact::bytes_of(r.good[1]) + compact::bytes_of(r.keyed);
    }
    return n;
  }();
  struct Effects {
    std::uint32_t begin[kN.atoms + 1] = {};
    std::uint32_t place[kEffects + 1] = {};   ///< the byte's number among all rules, times 4, plus the kind
    std::uint32_t bits[kEffects + 1] = {};
    std::uint32_t count = 0;

    constexpr void add(std::uint32_t atom, Effect kind) {
      for (std::uint32_t i = kFull.atoms[atom].readers; i < kFull.atoms[atom + 1].readers; ++i) {
        const Readers<Ix>& r = kFull.readers[i];
        std::uint32_t b = 0;
        for (Word rules = kind == Effect::kKey ? r.keyed : r.good[kind == Effect::kWhenTrue]; rules != 0; rules >>= 8, ++b) {
          if ((rules & 0xFFu) == 0) continue;
          place[count] = (r.word * 4u + b) * 4u + static_cast<std::uint32_t>(kind);
          bits[count++] = rules & 0xFFu;
        }
      }
    }
  };
  static constexpr Effects kEffectLists = [] {
    Effects e;
    for (std::uint32_t a = 0; a < kN.atoms; ++a) {
      e.begin[a] = e.count;
      for (const Effect kind : {Effect::kWhenTrue, Effect::kWhenFalse, Effect::kKey}) e.add(a, kind);
    }
    e.begin[kN.atoms] = e.count;
    return e;
  }();
  struct EffectBegin { constexpr std::uint32_t operator()(std::uint32_t a) const { return kEffectLists.begin[a]; } };
  struct EffectPlace { constexpr std::uint32_t operator()(std::uint32_t i) const { return kEffectLists.place[i]; } };
  struct EffectBits { constexpr std::uint32_t operator()(std::uint32_t i) const { return kEffectLists.bits[i]; } };

  // ---- and what counts or times it: parents (`node << 1 | negated`), behind them in number the timers
  static constexpr std::uint32_t kFeeds = kFull.atoms[kN.atoms].parents + kFull.atoms[kN.atoms].timers;
  struct FeedBegin {
    constexpr std::uint32_t operator()(std::uint32_t a) const { return kFull.atoms[a].parents + kFull.atoms[a].timers; }
  };
  static constexpr compact::List<kFeeds> kFeedLists = [] {
    compact::List<kFeeds> feeds;
    for (std::uint32_t a = 0; a < kN.atoms; ++a) {
      for (std::uint32_t i = kFull.atoms[a].parents; i < kFull.atoms[a + 1].parents; ++i) feeds.add(kFull.parents[i]);
      for (std::uint32_t i = kFull.atoms[a].timers; i < kFull.atoms[a + 1].timers; ++i) feeds.add(2 * kN.nodes + kFull.timer_inputs[i]);
    }
    return feeds;
  }();
  struct FeedOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFeedLists.item[i]; } };

  struct HighOf { constexpr std::uint32_t operator()(std::uint32_t c) const { return kFull.cell_atoms[c].high; } };
  struct LowOf { constexpr std::uint32_t operator()(std::uint32_t c) const { return kFull.cell_atoms[c].low; } };
  struct ZeroOf { constexpr std::uint32_t operator()(std::uint32_t c) const { return kFull.cell_atoms[c].zero; } };
  /// The atoms of cells. If few cells have one, pairs of cell and atom are stored and searched.
  template <class Of>
  class Sparse {
   public:
    static constexpr std::uint32_t kCount = [] {
      std::uint32_t n = 0;
      for (std::uint32_t c = 0; c < kN.cells(); ++c) n += Of{}(c) != 0 ? 1u : 0u;
      return n;
    }();

   private:
    static constexpr compact::List<kCount> kCells = [] {
      compact::List<kCount> cells;
      for (std::uint32_t c = 0; c < kN.cells(); ++c) {
        if (Of{}(c) != 0) cells.add(c);
      }
      return cells;
    }();
    struct CellAt { constexpr std::uint32_t operator()(std::uint32_t i) const { return kCells.item[i]; } };
    struct AtomAt { constexpr std::uint32_t operator()(std::uint32_t i) const { return Of{}(kCells.item[i]); } };

   public:
    static constexpr bool sparse = kCount * 4 < kN.cells();
    constexpr std::uint32_t operator[](std::uint32_t c) const {
      if constexpr (kCount == 0) {
        return 0;
      } else if constexpr (!sparse) {
        return compact::Numbers<kN.cells(), Of>{}[c];
      } else {
        for (std::uint32_t i = 0; i < kCount; ++i) {
          if (compact::Numbers<kCount, CellAt>{}[i] == c) return compact::Numbers<kCount, AtomAt>{}[i];
        }
        return 0;
      }
    }
  };
  struct CellRows {
    constexpr CellAtoms<Ix> operator[](std::uint32_t c) const {
      return {static_cast<Ix>(Sparse<HighOf>{}[c]), static_cast<Ix>(Sparse<LowOf>{}[c]), static_cast<Ix>(Sparse<ZeroOf>{}[c])};
    }
  };

  template <Ix FactAtoms<Ix>::*kField>
  struct FactOf { constexpr std::uint32_t operator()(std::uint32_t f) const { return kFull.fact_atoms[f].*kField; } };
  template <float FactAtoms<Ix>::*kField>
  struct LimitOf { constexpr float operator()(std::uint32_t f) const { return kFull.fact_atoms[f].*kField; } };
  struct FactRows {
    constexpr FactAtoms<Ix> operator[](std::uint32_t f) const {
      return {static_cast<Ix>(compact::Numbers<kN.facts, FactOf<&FactAtoms<Ix>::seen>>{}[f]),
              static_cast<Ix>(compact::Numbers<kN.facts, FactOf<&FactAtoms<Ix>::event>>{}[f]),
              static_cast<Ix>(compact::Numbers<kN.facts, FactOf<&FactAtoms<Ix>::lost>>{}[f]),
              compact::Floats<kN.facts, LimitOf<&FactAtoms<Ix>::plain>>{}[f],
              compact::Floats<kN.facts, LimitOf<&FactAtoms<Ix>::attended>>{}[f]};
    }
  };

  static constexpr std::uint32_t kAttends = kN.satellites == 0 ? 0 : kFull.attends_begin[kN.satellites];
  struct AttendedFact { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.attends[i]; } };
  static constexpr compact::List<kAttends> kAttending = [] {
    compact::List<kAttends> attending;
    for (std::uint32_t s = 0; s < kN.satellites; ++s) {
      for (std::uint32_t i = kFull.attends_begin[s]; i < kFull.attends_begin[s + 1]; ++i) attending.add(s);
    }
    return attending;
  }();
  struct AttendingSatellite { constexpr std::uint32_t operator()(std::uint32_t i) const { return kAttending.item[i]; } };
  struct AttendsBegin {
    constexpr std::uint32_t operator[](std::uint32_t satellite) const {
      std::uint32_t i = 0;
      while (i < kAttends && compact::Numbers<kAttends, AttendingSatellite>{}[i] < satellite) ++i;
      return i;
    }
  };

  // ---- rules
  struct ConditionOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.conditions[i]; } };
  struct ConditionBegin { constexpr std::uint32_t operator()(std::uint32_t r) const { return kFull.rules[r].conditions; } };

  static constexpr bool same_writes(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = kFull.rules[a].writes, other = kFull.rules[b].writes;
    const std::uint32_t n = kFull.rules[a + 1].writes - from;
    if (kFull.rules[b + 1].writes - other != n) return false;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (kFull.writes[from + i].cell != kFull.writes[other + i].cell) return false;
      if (kFull.writes[from + i].value != kFull.writes[other + i].value) return false;
    }
    return true;
  }
  static constexpr std::uint32_t hash_of_writes(std::uint32_t rule) {
    std::uint32_t hash = 0;
    for (std::uint32_t i = kFull.rules[rule].writes; i < kFull.rules[rule + 1].writes; ++i) {
      hash = (hash ^ std::uint32_t{kFull.writes[i].cell} << 16 ^ kFull.writes[i].value) * 0x9E37'79B1u;
      hash ^= hash >> 15;
    }
    return hash;
  }
  /// The different lists of writes: for each rule its list, for each list its first rule and its beginning. Each is looked up by its hash.
  struct WriteLists {
    std::uint32_t list_of[kN.rules + 1] = {};
    std::uint32_t rule_of[kN.rules + 1] = {};
    std::uint32_t begin[kN.rules + 1] = {};
    std::uint32_t count = 0;
  };
  static constexpr WriteLists kLists = [] {
    constexpr std::uint32_t kPlaces = std::bit_ceil(2 * kN.rules + 1);
    std::uint32_t list_at[kPlaces] = {};   // counted from 1
    WriteLists w;
    for (std::uint32_t r = 0; r < kN.rules; ++r) {
      std::uint32_t at = hash_of_writes(r) % kPlaces;
      while (list_at[at] != 0 && !same_writes(r, w.rule_of[list_at[at] - 1])) at = (at + 1) % kPlaces;
      if (list_at[at] == 0) {
        w.rule_of[w.count] = r;
        w.begin[w.count + 1] = w.begin[w.count] + (kFull.rules[r + 1].writes - kFull.rules[r].writes);
        list_at[at] = ++w.count;
      }
      w.list_of[r] = list_at[at] - 1;
    }
    return w;
  }();
  static constexpr std::uint32_t kWrites = kLists.begin[kLists.count];
  struct Flat { Write<Ix> item[kWrites + 1]; };
  static constexpr Flat kFlat = [] {
    Flat flat{};
    for (std::uint32_t l = 0; l < kLists.count; ++l) {
      const std::uint32_t from = kFull.rules[kLists.rule_of[l]].writes;
      for (std::uint32_t i = kLists.begin[l]; i < kLists.begin[l + 1]; ++i) flat.item[i] = kFull.writes[from + (i - kLists.begin[l])];
    }
    return flat;
  }();
  static constexpr const Write<Ix>& write_at(std::uint32_t i) { return kFlat.item[i]; }
  struct ListOf { constexpr std::uint32_t operator()(std::uint32_t r) const { return kLists.list_of[r]; } };
  struct ListBegin { constexpr std::uint32_t operator()(std::uint32_t l) const { return kLists.begin[l]; } };
  /// A write as one number: the cell, counted from the first satellite since rules write no facts, times the number of values, plus the
  /// value's index.
  static constexpr std::uint32_t kValues = [] {
    std::uint32_t most = 0;
    for (std::uint32_t i = 0; i < kWrites; ++i) most = write_at(i).value > most ? write_at(i).value : most;
    return most + 1;
  }();
  struct WriteOf {
    constexpr std::uint32_t operator()(std::uint32_t i) const {
      return (write_at(i).cell - kN.facts) * kValues + write_at(i).value;
    }
  };
  struct WriteRows {
    constexpr Write<Ix> operator[](std::uint32_t i) const {
      const std::uint32_t both = compact::Numbers<kWrites, WriteOf>{}[i];
      return {static_cast<Ix>(both / kValues + kN.facts), static_cast<Ix>(both % kValues)};
    }
  };

  struct Slots { std::uint32_t of[kN.satellites + 1]; };
  static constexpr Slots kSlots = [] {
    bool written[kN.cells() + 1] = {};
    for (std::uint32_t i = 0; i < kWrites; ++i) written[write_at(i).cell] = true;
    Slots found{};
    std::uint32_t next = 0;
    for (std::uint32_t s = 0; s < kN.satellites; ++s) found.of[s] = written[kN.facts + s] ? next++ : K::kCompact.written;
    found.of[kN.satellites] = next;
    return found;
  }();
  static_assert(kSlots.of[kN.satellites] == K::kCompact.written, "the bounds are of other tables: compile the knowledge base again");
  struct SlotOf { constexpr std::uint32_t operator()(std::uint32_t satellite) const { return kSlots.of[satellite]; } };

  // ---- the rest
  struct NeedOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.nodes[i].need; } };
  struct InputOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.timers[i].input; } };
  struct QueueOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.timers[i].queue; } };
  struct PriorityOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.priority[i]; } };
  struct InitialOf { constexpr float operator()(std::uint32_t i) const { return kFull.initial[i]; } };
  struct CountOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.initial_count[i]; } };
  struct ChildOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.children[i]; } };
  struct ChildBegin { constexpr std::uint32_t operator()(std::uint32_t i) const { return kFull.child_begin[i]; } };
  struct IsAnd { constexpr bool operator()(std::uint32_t i) const { return kFull.is_and[i] != 0; } };
  struct NodeRows {
    constexpr Node<Ix> operator[](std::uint32_t i) const { return {static_cast<Ix>(compact::Numbers<kN.nodes, NeedOf>{}[i])}; }
  };
  struct TimerRows {
    constexpr Timer<Ix> operator[](std::uint32_t i) const {
      return {static_cast<Ix>(compact::Literals<kN.timers, InputOf>{}[i]), static_cast<Ix>(compact::Numbers<kN.timers, QueueOf>{}[i])};
    }
  };
  static constexpr bool kStrengths = kFull.children != nullptr;
  static constexpr std::uint32_t kChildren = kStrengths ? kFull.child_begin[kN.nodes] : 0;

  /// What the engine sees. Arrays that are small or already words are those of the ordinary tables.
  struct View {
    static constexpr float firing = kFull.firing;
    static constexpr Idle idle = kFull.idle;
    static constexpr Ix idle_strategy = kFull.idle_strategy;
    static constexpr std::uint32_t hold_limit_us = kFull.hold_limit_us;
    static constexpr CellRows cell_atoms{};
    static constexpr FactRows fact_atoms{};
    static constexpr AttendsBegin attends_begin{};
    static constexpr compact::Numbers<kAttends, AttendedFact> attends{};
    static constexpr NodeRows nodes{};
    static constexpr TimerRows timers{};
    static constexpr const std::uint32_t* queue_us = kFull.queue_us;
    static constexpr const Stage<Ix>* stages = kFull.stages;
    static constexpr const Level<Ix>* levels = kFull.levels;
    static constexpr const Ix* word_rule = kFull.word_rule;
    static constexpr const Word* while_rules = kFull.while_rules;
    static constexpr const Word* reset_rules = kFull.reset_rules;
    static constexpr compact::Literals<kFull.rules[kN.rules].conditions, ConditionOf> conditions{};
    static constexpr WriteRows writes{};
    static constexpr const Ix* clears = nullptr;
    static constexpr const float* values = kFull.values;
    static constexpr const Ix* group_of = nullptr;
    static constexpr const Ix* group_slot = nullptr;
    static constexpr const Ix* group_begin = nullptr;
    static constexpr compact::Numbers<kN.strategies, PriorityOf> priority{};
    static constexpr compact::Floats<kN.satellites, InitialOf> initial{};
    static constexpr const Word* keep = kFull.keep;
    static constexpr const Word* initial_truth = kFull.initial_truth;
    static constexpr compact::Numbers<kN.nodes, CountOf> initial_count{};
    static constexpr compact::Numbers<kStrengths ? kN.nodes + 1 : 0, ChildBegin> child_begin{};
    static constexpr compact::Literals<kChildren, ChildOf> children{};
    static constexpr compact::Flags<kStrengths ? kN.nodes : 0, IsAnd> is_and{};
  };
  static constexpr View kView{};

 public:
  constexpr const View* operator->() const { return &kView; }

  static constexpr compact::Range conditions_of(std::uint32_t rule) {
    return {compact::Rising<kN.rules + 1, ConditionBegin>{}[rule], compact::Rising<kN.rules + 1, ConditionBegin>{}[rule + 1]};
  }
  static constexpr compact::Range writes_of(std::uint32_t rule) {
    const std::uint32_t list = compact::Numbers<kN.rules, ListOf>{}[rule];
    return {compact::Rising<kLists.count + 1, ListBegin>{}[list], compact::Rising<kLists.count + 1, ListBegin>{}[list + 1]};
  }
  static constexpr compact::Range effects_of(std::uint32_t atom) {
    return {compact::Rising<kN.atoms + 1, EffectBegin>{}[atom], compact::Rising<kN.atoms + 1, EffectBegin>{}[atom + 1]};
  }
  /// A byte of a mask of rules, and what its atom does to these rules.
  struct Followed {
    Effect kind;
    std::uint32_t word;
    Word mask;
  };
  static constexpr Followed effect(std::uint32_t i) {
    const std::uint32_t place = compact::Numbers<kEffects, EffectPlace>{}[i];
    return {static_cast<Effect>(place % 4u), place / 16u, Word{compact::Numbers<kEffects, EffectBits>{}[i]} << 8 * (place / 4u % 4u)};
  }
  static constexpr compact::Range feeds_of(std::uint32_t atom) {
    return {compact::Rising<kN.atoms + 1, FeedBegin>{}[atom], compact::Rising<kN.atoms + 1, FeedBegin>{}[atom + 1]};
  }
  static constexpr std::uint32_t feed(std::uint32_t i) { return compact::Numbers<kFeeds, FeedOf>{}[i]; }
  /// The place of a satellite's value in memory; K::kCompact.written if no rule writes it.
  static constexpr std::uint32_t slot(std::uint32_t satellite) { return compact::Numbers<kN.satellites, SlotOf>{}[satellite]; }

  /// Whether some condition asks for `zero`.
  static constexpr bool kZeroTerms = Sparse<ZeroOf>::kCount != 0;

  /// Which cell a term belongs to, or `cells()`. Cost: a search over all cells; only where rules contradict each other.
  static constexpr std::uint32_t cell_of(std::uint32_t atom) {
    std::uint32_t c = 0;
    while (c < kN.cells() && kView.cell_atoms[c].high != atom && kView.cell_atoms[c].low != atom && kView.cell_atoms[c].zero != atom) ++c;
    return c;
  }

  /// Whether all blends are ratios of whole numbers: where rules of a level disagree about a cell, they write only -1, 0 or 1, and
  /// strengths are 0.5 or more. (Where rules agree, nothing is computed. Two resets may disagree about an initial value.)
  static constexpr bool kWholeValues = [] {
    for (std::uint32_t l = 0; l < kN.levels; ++l) {
      float seen[kN.satellites + 1] = {};
      bool written[kN.satellites + 1] = {}, differ[kN.satellites + 1] = {}, odd[kN.satellites + 1] = {};
      const auto note = [&](std::uint32_t satellite, float x) {
        differ[satellite] = differ[satellite] || (written[satellite] && seen[satellite] != x);
        odd[satellite] = odd[satellite] || !(x == -1.0f || x == 0.0f || x == 1.0f);
        written[satellite] = true;
        seen[satellite] = x;
      };
      int resets = 0;
      for (std::uint32_t w = kFull.levels[l].first_word; w < kFull.levels[l].end_word; ++w) {
        resets += std::popcount(kFull.reset_rules[w]);
        const std::uint32_t first = kFull.word_rule[w], end = w + 1 < kN.words ? kFull.word_rule[w + 1] : kN.rules;
        for (std::uint32_t i = kFull.rules[first].writes; i < kFull.rules[end].writes; ++i) {
          const std::uint32_t satellite = kFull.writes[i].cell - kN.facts;
          if (satellite < kN.satellites) note(satellite, kFull.values[kFull.writes[i].value]);
        }
      }
      for (std::uint32_t s = 0; resets > 1 && s < kN.satellites; ++s) {
        if ((kFull.keep[s / kWordBits] >> s % kWordBits & 1u) == 0) note(s, kFull.initial[s]);
      }
      for (std::uint32_t s = 0; s < kN.satellites; ++s) {
        if (differ[s] && (odd[s] || kFull.firing < 0.5f)) return false;
      }
    }
    return true;
  }();
};

}  // namespace mts
