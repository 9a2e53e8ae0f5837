#include <cstring>

#include "compiler/tables/image.h"

namespace kb::tables {

namespace {

/// Opens the image with the width of indexes that its head states.
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

/// Finds what each atom stands for, except the conditions of timers and nodes.
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
  for (I a = t.shape.first_timer(); a < t.shape.atoms; ++a) t.origins[a].kind = a < t.shape.first_node() ? AtomOrigin::Kind::kTimer : AtomOrigin::Kind::kNode;
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
    const mts::ImageHead& h = image.head();
    const mts::Shape& n = from.shape;
    Tables t;
    t.shape = n;
    t.firing = from.firing;
    t.idle = from.idle;
    t.idle_strategy = from.idle_strategy;
    t.hold_limit_us = from.hold_limit_us;
    t.narrow = sizeof(from.idle_strategy) == 2;
#define KB_ARRAY(name, type, length) widen(t.name, from.name, length);
    MTS_IMAGE_TABLES(KB_ARRAY)
#undef KB_ARRAY
    recall_origins(t);
    recall_keys(t);
    return t;
  });
}

}  // namespace kb::tables
