#include "planners/swarm.h"

#include <algorithm>
#include <array>
#include <barrier>
#include <bit>
#include <cstring>
#include <latch>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>

#include "planners/crew.h"

namespace kb::planners {
namespace {

// The least number of robots for a thread: with fewer, starting the thread costs more than it gains.
constexpr std::size_t kShare = 4096;
constexpr std::uint64_t kSortEvery = 64;

std::size_t parts_of(std::size_t n, unsigned threads) { return std::clamp<std::size_t>(n / kShare, 1, std::max(threads, 1u)); }

// The bytes of the eight cells round one, in the order of memory; kOrder: the directions in that order.
constexpr std::array<std::uint8_t, 8> kOrder = {5, 6, 7, 4, 0, 3, 2, 1};
constexpr std::size_t kSpare = 4;  // bytes past the last cell that a load may touch
std::uint64_t bytes_round(const std::uint8_t* here, std::ptrdiff_t up) {
  const auto load = [](const std::uint8_t* from) {
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, from, sizeof(bytes));
    if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap32(bytes);
    return std::uint64_t{bytes};
  };
  const std::uint64_t below = load(here - up - 1), beside = load(here - 1), above = load(here + up - 1);
  return (below & 0xFFFFFF) | (beside & 0xFF) << 24 | (beside & 0xFF0000) << 16 | (above & 0xFFFFFF) << 40;
}

constexpr std::uint64_t kEachByte = 0x0101010101010101u;

// Bit i is the top bit of byte i.
unsigned top_bits(std::uint64_t bytes) {
  return static_cast<unsigned>(((bytes >> 7 & kEachByte) * 0x0102040810204080u) >> 56);
}

// Bit i is set if byte i is zero; for bytes below 0x80.
unsigned zero_bytes(std::uint64_t bytes) { return top_bits(~(bytes + 0x7F * kEachByte)); }

// The directions that are blocked, by which cells round are taken (bits in the order of memory). A diagonal move needs both straight
// neighbours free.
constexpr std::array<std::uint8_t, 256> kBlocked = [] {
  std::array<std::uint8_t, 256> out{};
  for (unsigned round = 0; round < 256; ++round) {
    unsigned taken = 0;
    for (unsigned i = 0; i < 8; ++i) taken |= (round >> i & 1u) << kOrder[i];
    const unsigned sides = (taken << 1) | (taken >> 7) | (taken >> 1) | (taken << 7);
    out[round] = static_cast<std::uint8_t>(taken | (sides & 0xAAu));
  }
  return out;
}();

// A robot that stands in direction k of a cell and wants to go the opposite way wants that cell. Byte i: the wish that does so.
constexpr std::uint64_t kTowards = [] {
  std::uint64_t out = 0;
  for (unsigned i = 0; i < 8; ++i) out |= std::uint64_t{(kOrder[i] + 4u) % 8u} << (8 * i);
  return out;
}();
// By direction of a move: the bit of the robot that makes it, in the order of memory round its target.
constexpr std::array<std::uint8_t, 8> kMover = [] {
  std::array<std::uint8_t, 8> out{};
  for (unsigned i = 0; i < 8; ++i) out[(kOrder[i] + 4u) % 8u] = static_cast<std::uint8_t>(1u << i);
  return out;
}();

}  // namespace

Swarm::Swarm(const Grid& grid, const FuzzyTable& table, const std::vector<Robot>& robots)
    : grid_(&grid), stride_(grid.width() + 2) {
  for (std::uint32_t code = 0; code < table_.size(); ++code) table_[code] = table[fuzzy_row_of(code)];
  table_[kFuzzyThere].fill(kStandStill);
  taken_.assign(grid.all_blocked().begin(), grid.all_blocked().end());
  for (std::uint8_t& taken : taken_) taken = taken != 0 ? 0xFF : 0;
  taken_.resize(grid.size() + kSpare, 0xFF);
  wishes_.assign(grid.size() + kSpare, kStandStill);
  slots_.reserve(robots.size());
  for (const Robot& robot : robots) {
    fault_ = grid.blocked(robot.at) ? Fault::kStartBlocked : grid.blocked(robot.goal) ? Fault::kGoalBlocked : Fault::kNone;
    if (!ok()) return;
    std::uint8_t& here = taken_[grid.index(robot.at)];
    if (std::exchange(here, std::uint8_t{0xFF}) != 0) {
      fault_ = Fault::kSharedStart;
      return;
    }
    const auto place = [](Cell c) { return Place{static_cast<std::int16_t>(c.x), static_cast<std::int16_t>(c.y)}; };
    slots_.push_back({place(robot.at), place(robot.goal)});
    arrived_ += robot.at == robot.goal ? 1 : 0;
  }
  numbers_.resize(slots_.size());
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  choices_.assign(slots_.size(), kStandStill);
  sort_by_place();
}

// Sorts robots by rows, and keeps their order within a row: a row is a few cache lines, in which no order is better than another. It
// sorts by counting, since sorting by comparison took a twelfth of all time.
void Swarm::sort_by_place() {
  std::vector<std::size_t> begins(static_cast<std::size_t>(grid_->height()) + 1, 0);
  for (const Slot& slot : slots_) ++begins[static_cast<std::size_t>(slot.at.y) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<Slot> slots(slots_.size());
  std::vector<std::uint32_t> numbers(slots_.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const std::size_t to = begins[static_cast<std::size_t>(slots_[i].at.y)]++;
    slots[to] = slots_[i];
    numbers[to] = numbers_[i];
  }
  slots_.swap(slots);
  numbers_.swap(numbers);
}

// All three phases copy the members that they use to the stack first: as far as the compiler knows, a store of a byte could
// change any member.
void Swarm::choose(std::size_t first, std::size_t last) {
  const auto& table = table_;
  const std::uint8_t* const taken = taken_.data();
  std::uint8_t *const wishes = wishes_.data(), *const choices = choices_.data();
  const Slot* const slots = slots_.data();
  const std::ptrdiff_t up = stride_;
  // First the codes of a block of robots: the compiler can compute several at once.
  std::array<std::uint32_t, 256> codes;
  for (std::size_t begin = first; begin < last; begin += codes.size()) {
    const std::size_t count = std::min(codes.size(), last - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Slot slot = slots[begin + i];
      codes[i] = fuzzy_code(slot.goal.x - slot.at.x, slot.goal.y - slot.at.y);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Place here = slots[begin + i].at;
      const std::ptrdiff_t at = (here.y + 1) * up + here.x + 1;
      const std::uint8_t choice = table[codes[i]][kBlocked[top_bits(bytes_round(taken + at, up))]];
      choices[begin + i] = choice;
      wishes[at] = choice;
    }
  }
}

void Swarm::resolve(std::size_t first, std::size_t last) {
  const auto turn = static_cast<unsigned>(ticks_ % 8);
  const std::uint8_t* const wishes = wishes_.data();
  std::uint8_t* const choices = choices_.data();
  const Slot* const slots = slots_.data();
  const std::array<std::int32_t, 8> steps = grid_->steps();
  const std::ptrdiff_t up = stride_;
  for (std::size_t i = first; i < last; ++i) {
    const std::uint8_t choice = choices[i];
    if (choice == kStandStill) continue;
    const std::ptrdiff_t target = (slots[i].at.y + 1) * up + slots[i].at.x + 1 + steps[choice];
    const unsigned wanting = zero_bytes(bytes_round(wishes + target, up) ^ kTowards);
    const unsigned me = kMover[choice];
    const auto turned = [turn](unsigned bits) { return (bits >> turn | bits << (8 - turn)) & 0xFFu; };
    choices[i] = (turned(wanting) & (turned(me) - 1)) != 0 ? kStandStill : choice;
  }
}

Swarm::Tally Swarm::move(std::size_t first, std::size_t last) {
  Tally tally;
  const std::uint8_t* const choices = choices_.data();
  std::uint8_t *const wishes = wishes_.data(), *const taken = taken_.data();
  Slot* const slots = slots_.data();
  const std::array<std::int32_t, 8> steps = grid_->steps();
  const std::ptrdiff_t up = stride_;
  for (std::size_t i = first; i < last; ++i) {
    const std::uint8_t choice = choices[i];
    if (choice == kStandStill) continue;
    Slot slot = slots[i];
    const std::ptrdiff_t at = (slot.at.y + 1) * up + slot.at.x + 1;
    const Cell step = kDirections[choice];
    slot.at = {static_cast<std::int16_t>(slot.at.x + step.x), static_cast<std::int16_t>(slot.at.y + step.y)};
    slots[i].at = slot.at;
    // A cell that a robot leaves was taken, a cell that one enters was free and has one winner: no cell is written twice, so threads need no
    // lock.
    taken[at] = 0;
    wishes[at] = kStandStill;
    taken[at + steps[choice]] = 0xFF;
    ++tally.moved;
    tally.arrived += slot.at.x == slot.goal.x && slot.at.y == slot.goal.y ? 1 : 0;
  }
  return tally;
}

std::size_t Swarm::step(unsigned threads) {
  const std::size_t n = slots_.size();
  std::size_t parts = parts_of(n, threads);
  std::vector<Tally> tallies(parts);
  std::latch all_started(1);
  std::optional<std::barrier<>> phase;
  const auto work = [&](std::size_t part) {
    const std::size_t first = n * part / parts, last = n * (part + 1) / parts;
    choose(first, last);
    phase->arrive_and_wait();
    resolve(first, last);
    phase->arrive_and_wait();
    tallies[part] = move(first, last);
  };
  std::vector<std::thread> others = start_threads(parts, [&](unsigned part) {
    all_started.wait();
    work(part);
  });
  parts = others.size() + 1;
  phase.emplace(static_cast<std::ptrdiff_t>(parts));
  all_started.count_down();
  work(0);
  for (std::thread& other : others) other.join();
  Tally all;
  for (const Tally& tally : tallies) {
    all.moved += tally.moved;
    all.arrived += tally.arrived;
  }
  arrived_ += all.arrived;
  if (++ticks_ % kSortEvery == 0) sort_by_place();
  return all.moved;
}

SwarmResult Swarm::run(const RunOptions& options, std::uint64_t max_ticks, unsigned threads) {
  SwarmResult result;
  result.arrived = arrived_;
  result.fault = fault_;
  if (!ok()) return result;
  Watch watch(options);
  const std::uint64_t patience = 3 * static_cast<std::uint64_t>(grid_->width() + grid_->height());
  std::uint64_t idle = 0;
  while (arrived_ < slots_.size() && idle < patience && result.ticks < max_ticks && !watch.stopped_now()) {
    idle = step(threads) == 0 ? idle + 1 : 0;
    ++result.ticks;
    if (arrived_ > result.arrived) result.makespan = result.ticks;
    result.flowtime += result.ticks * (arrived_ - result.arrived);
    result.arrived = arrived_;
  }
  if (arrived_ == slots_.size()) {
    result.outcome = Outcome::kReached;
  } else if (idle >= patience) {
    result.outcome = Outcome::kTrapped;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Slot& slot = slots_[i];
      if (slot.at.x != slot.goal.x || slot.at.y != slot.goal.y) result.stuck.push_back(numbers_[i]);
    }
    std::sort(result.stuck.begin(), result.stuck.end());
  } else {
    result.outcome = Outcome::kLimit;
  }
  return result;
}

std::vector<Cell> Swarm::cells() const {
  std::vector<Cell> cells(slots_.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) cells[numbers_[i]] = {slots_[i].at.x, slots_[i].at.y};
  return cells;
}

}  // namespace kb::planners
