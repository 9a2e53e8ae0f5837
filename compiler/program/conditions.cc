#include "compiler/program/conditions.h"

#include <algorithm>
#include <bit>

#include "compiler/program/hash.h"
#include "compiler/source/kinds.h"

namespace kb::program {
namespace {

std::uint32_t hash_of(const Cond& cond) {
  std::uint64_t hash = mix(static_cast<std::uint64_t>(cond.op), static_cast<std::uint64_t>(cond.term));
  hash = mix(hash, index(cond.cell));
  hash = mix(hash, cond.duration_us);
  for (const CondId part : cond.children) hash = mix(hash, index(part));
  return static_cast<std::uint32_t>(hash ^ (hash >> 31));
}

bool equal(const Cond& a, const Cond& b) {
  return a.op == b.op && a.term == b.term && a.cell == b.cell && a.duration_us == b.duration_us &&
         a.children == b.children;
}

}  // namespace

ConditionPool::ConditionPool(std::vector<Cond>& conds, std::size_t expected)
    : conds_(conds), known_(std::bit_ceil(std::max<std::size_t>(64, expected + expected / 3 + 1))) {
  conds_.reserve(expected);
  for (std::uint32_t i = 0; i < conds_.size(); ++i) put(hash_of(conds_[i]), CondId{i});
}

/// note [near slots]
/// In a large knowledge base, each look-up in a hash table waits for memory. But conditions that are made one after another mostly consist
/// of parts that were made one after another. So a condition's slot is one of eight in the cache line that belongs to its newest part (or
/// to its cell). If these are taken, it is the slot that the hash gives, or one behind it.
template <class Known>
ConditionPool::Slot& ConditionPool::slot(const Cond& cond, std::uint32_t hash, Known known) {
  constexpr std::size_t kNear = 8;
  const std::size_t last = known_.size() - 1;
  const std::size_t home = cond.children.empty() ? index(cond.cell) : index(*std::max_element(cond.children.begin(), cond.children.end()));
  const auto fits = [&](const Slot& one) { return one.id == CondId::kNone || known(one); };
  for (std::size_t at = home * kNear & last, end = at + kNear; at < end; ++at) {
    if (fits(known_[at])) return known_[at];
  }
  std::size_t at = hash;
  while (!fits(known_[at & last])) ++at;
  return known_[at & last];
}

void ConditionPool::put(std::uint32_t hash, CondId id) {
  slot(conds_[index(id)], hash, [](const Slot&) { return false; }) = {hash, id};
}

void ConditionPool::grow() {
  std::vector<Slot> old(2 * known_.size());
  old.swap(known_);
  for (const Slot& one : old) {
    if (one.id != CondId::kNone) put(one.hash, one.id);
  }
}

CondId ConditionPool::intern(Cond&& cond) {
  const std::uint32_t hash = hash_of(cond);
  Slot& found = slot(cond, hash, [&](const Slot& one) { return one.hash == hash && equal(conds_[index(one.id)], cond); });
  if (found.id != CondId::kNone) return found.id;
  const CondId id{static_cast<std::uint32_t>(conds_.size())};
  found = {hash, id};
  conds_.push_back(std::move(cond));
  if (3 * known_.size() < 4 * conds_.size()) grow();
  return id;
}

CondId ConditionPool::sighting(Cond::Op op, CellId fact) {
  Cond cond;
  cond.op = op;
  cond.cell = fact;
  return intern(std::move(cond));
}

CondId ConditionPool::event(CellId fact) { return sighting(Cond::Op::kEvent, fact); }
CondId ConditionPool::lost(CellId fact) { return sighting(Cond::Op::kLost, fact); }
CondId ConditionPool::seen(CellId fact) { return sighting(Cond::Op::kSeen, fact); }

CondId ConditionPool::is(CellId cell, Term term) {
  Cond cond;
  cond.op = Cond::Op::kIs;
  cond.term = term;
  cond.cell = cell;
  return intern(std::move(cond));
}

CondId ConditionPool::negation(CondId part) {
  Cond cond;
  cond.op = Cond::Op::kNot;
  cond.children = {part};
  return intern(std::move(cond));
}

CondId ConditionPool::held_for(CondId part, std::uint32_t duration_us) {
  Cond cond;
  cond.op = Cond::Op::kFor;
  cond.duration_us = duration_us;
  cond.children = {part};
  return intern(std::move(cond));
}

CondId ConditionPool::all_of(std::span<const CondId> parts) { return several(Cond::Op::kAnd, parts); }
CondId ConditionPool::any_of(std::span<const CondId> parts) { return several(Cond::Op::kOr, parts); }

CondId ConditionPool::several(Cond::Op op, std::span<const CondId> parts) {
  Cond cond;
  cond.op = op;
  ++round_;
  mark_.resize(conds_.size(), 0);
  const auto take = [&](CondId part) {
    if (mark_[index(part)] == round_) return;
    mark_[index(part)] = round_;
    cond.children.push_back(part);
  };
  for (const CondId part : parts) {
    const Cond& inner = conds_[index(part)];
    if (inner.op == op && (op == Cond::Op::kAnd || inner.children.size() <= kSmallOr)) {
      for (const CondId nested : inner.children) take(nested);
    } else {
      take(part);
    }
  }
  if (cond.children.size() == 1) return cond.children.front();
  return intern(std::move(cond));
}

std::vector<CondId> conjuncts(const Program& program, CondId condition) {
  const Cond& cond = program[condition];
  if (cond.op != Cond::Op::kAnd) return {condition};
  return {cond.children.begin(), cond.children.end()};
}

std::vector<CondId> reachable(const std::vector<Cond>& conds, const std::vector<CondId>& roots) {
  std::vector<bool> found(conds.size(), false);
  std::vector<CondId> pending, all;
  const auto visit = [&](CondId id) {
    if (found[index(id)]) return;
    found[index(id)] = true;
    pending.push_back(id);
  };
  for (const CondId root : roots) visit(root);
  while (!pending.empty()) {
    const CondId id = pending.back();
    pending.pop_back();
    all.push_back(id);
    for (const CondId part : conds[index(id)].children) visit(part);
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace kb::program
