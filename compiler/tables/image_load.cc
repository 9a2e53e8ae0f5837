#include <cstring>

#include "compiler/tables/image.h"

namespace kb::tables {

namespace {

/// Opens it as what it says that it is.
mts::ImageStatus open_either(const void* bytes, std::size_t size, mts::Image<std::uint16_t>& narrow, mts::Image<std::uint32_t>& wide) {
  mts::ImageInfo info;
  if (const mts::ImageStatus status = mts::peek_image(bytes, size, info); status != mts::ImageStatus::kOk) return status;
  std::vector<mts::Word> scratch(info.scratch_words + 1);
  return info.index_bytes == 2 ? mts::open_image(bytes, size, scratch.data(), scratch.size(), narrow)
                               : mts::open_image(bytes, size, scratch.data(), scratch.size(), wide);
}

}  // namespace

mts::ImageStatus verify_image(std::string_view bytes) {
  mts::Image<std::uint16_t> narrow;
  mts::Image<std::uint32_t> wide;
  return open_either(bytes.data(), bytes.size(), narrow, wide);
}

LoadedImage::LoadedImage(std::string_view bytes) : memory_((bytes.size() + 7) / 8), size_(bytes.size()) {
  if (!bytes.empty()) std::memcpy(memory_.data(), bytes.data(), bytes.size());
  status_ = open_either(memory_.data(), size_, view16_, view32_);
  narrow_ = status_ == mts::ImageStatus::kOk && head().index_bytes == 2;
}

namespace {

void widen_row(mts::Atom<I>& to, const auto& x) { to = {x.readers, x.parents, x.timers}; }
void widen_row(mts::CellAtoms<I>& to, const auto& x) { to = {x.high, x.low, x.zero}; }
void widen_row(mts::FactAtoms<I>& to, const auto& x) { to = {x.seen, x.event, x.lost, x.plain, x.attended}; }
void widen_row(mts::Readers<I>& to, const auto& x) { to = {x.word, {x.good[0], x.good[1]}, x.keyed}; }
void widen_row(mts::Node<I>& to, const auto& x) { to = {x.need}; }
void widen_row(mts::Timer<I>& to, const auto& x) { to = {x.input, x.queue}; }
void widen_row(mts::Stage<I>& to, const auto& x) { to = {x.first_timer, x.end_timer, x.first_queue, x.end_queue}; }
void widen_row(mts::Level<I>& to, const auto& x) { to = {x.first_word, x.end_word, x.first_stage, x.end_stage}; }
void widen_row(mts::Rule<I>& to, const auto& x) { to = {x.conditions, x.writes, x.clears}; }
void widen_row(mts::Write<I>& to, const auto& x) { to = {x.cell, x.value}; }
void widen_row(float& to, const auto& x) { to = x; }
void widen_row(std::uint32_t& to, const auto& x) { to = x; }
void widen_row(std::uint8_t& to, const auto& x) { to = x; }

template <class T, class U>
void widen(std::vector<T>& to, const U* from, std::size_t count) {
  to.resize(count);
  for (std::size_t i = 0; i < count; ++i) widen_row(to[i], from[i]);
}

/// What each atom stands for; the conditions of timers and nodes are not known yet.
void recall_origins(Tables& t) {
  t.origins.resize(t.shape.atoms);
  t.origins[mts::kFalseAtom].kind = AtomOrigin::Kind::kFalse;
  const auto put = [&](I atom, AtomOrigin::Kind kind, program::Term term, std::size_t cell) {
    if (atom != 0) t.origins[atom] = {.kind = kind, .term = term, .cell = program::CellId{static_cast<std::uint32_t>(cell)}};
  };
  for (std::size_t c = 0; c < t.cell_atoms.size(); ++c) {
    put(t.cell_atoms[c].high, AtomOrigin::Kind::kTerm, program::Term::kHigh, c);
    put(t.cell_atoms[c].low, AtomOrigin::Kind::kTerm, program::Term::kLow, c);
    put(t.cell_atoms[c].zero, AtomOrigin::Kind::kTerm, program::Term::kZero, c);
    if (c >= t.fact_atoms.size()) continue;
    put(t.fact_atoms[c].seen, AtomOrigin::Kind::kSeen, program::Term::kHigh, c);
    put(t.fact_atoms[c].event, AtomOrigin::Kind::kEvent, program::Term::kHigh, c);
    put(t.fact_atoms[c].lost, AtomOrigin::Kind::kLost, program::Term::kHigh, c);
  }
  const I first_node = t.shape.atoms - t.shape.nodes;
  for (I a = first_node - t.shape.timers; a < t.shape.atoms; ++a) t.origins[a].kind = a < first_node ? AtomOrigin::Kind::kTimer : AtomOrigin::Kind::kNode;
}

void recall_keys(Tables& t) {
  t.rule_key.resize(t.shape.rules, mts::kTrueAtom);
  for (I a = 0; a < t.shape.atoms; ++a) {
    for (I i = t.atoms[a].readers; i < t.atoms[a + 1].readers; ++i) {
      for (mts::Word keyed = t.readers[i].keyed; keyed != 0; keyed &= keyed - 1) {
        t.rule_key[t.word_rule[t.readers[i].word] + static_cast<I>(std::countr_zero(keyed))] = a;
      }
    }
  }
}

}  // namespace

Tables recall_tables(const LoadedImage& image) {
  return image.visit([&image](const auto& view) {
    const auto& from = view.tables;
    const auto& last = from.atoms[from.shape.atoms];
    const auto& end = from.rules[from.shape.rules];
    const mts::Shape& n = from.shape;
    Tables t;
    t.shape = n;
    t.firing = from.firing;
    t.idle = from.idle;
    t.idle_strategy = from.idle_strategy;
    t.hold_limit_us = from.hold_limit_us;
    t.narrow = sizeof(from.idle_strategy) == 2;
    widen(t.atoms, from.atoms, n.atoms + 1);
    widen(t.readers, from.readers, last.readers);
    widen(t.parents, from.parents, last.parents);
    widen(t.timer_inputs, from.timer_inputs, n.timers);
    widen(t.broad, from.broad, from.broad == nullptr ? 0 : n.atoms);
    widen(t.cell_atoms, from.cell_atoms, n.cells());
    widen(t.fact_atoms, from.fact_atoms, n.facts);
    widen(t.attends_begin, from.attends_begin, n.satellites + 1);
    widen(t.attends, from.attends, from.attends_begin[n.satellites]);
    widen(t.nodes, from.nodes, n.nodes);
    widen(t.timers, from.timers, n.timers);
    widen(t.queue_us, from.queue_us, n.queues);
    widen(t.stages, from.stages, image.head().stages);
    widen(t.levels, from.levels, n.levels);
    widen(t.rules, from.rules, n.rules + 1);
    widen(t.word_rule, from.word_rule, n.words);
    widen(t.while_rules, from.while_rules, n.words);
    widen(t.reset_rules, from.reset_rules, n.words);
    widen(t.conditions, from.conditions, end.conditions);
    widen(t.writes, from.writes, end.writes);
    widen(t.clears, from.clears, end.clears);
    widen(t.values, from.values, image.head().values);
    widen(t.group_of, from.group_of, n.groups == 0 ? 0 : n.satellites);
    widen(t.group_slot, from.group_slot, n.groups == 0 ? 0 : n.satellites);
    widen(t.group_begin, from.group_begin, n.groups == 0 ? 0 : n.groups + 1);
    widen(t.priority, from.priority, n.strategies);
    widen(t.initial, from.initial, n.satellites);
    widen(t.keep, from.keep, mts::Shape::words_for(n.satellites));
    widen(t.initial_truth, from.initial_truth, mts::Shape::words_for(n.atoms));
    widen(t.initial_count, from.initial_count, n.nodes);
    if (n.contested != 0) {
      widen(t.child_begin, from.child_begin, n.nodes + 1);
      widen(t.children, from.children, from.child_begin[n.nodes]);
      widen(t.is_and, from.is_and, n.nodes);
      widen(t.atom_cell, from.atom_cell, n.atoms);
      widen(t.atom_term, from.atom_term, n.atoms);
    }
    recall_origins(t);
    recall_keys(t);
    return t;
  });
}

}  // namespace kb::tables
