#include "planners/shortest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory_resource>

namespace kb::planners {
namespace {

constexpr double kBucketsPerCell = 8.0;   // of A*; finer ones gain nothing, coarser ones reopen more cells

// How a field is stored: as the distance times kSign. A distance counts as shorter only if it is so by more than kGrain: sums
// of the same moves in another order differ in their last bits, while distances that are really different differ by more, for
// |a + b sqrt(2)| is at least 1 / (3 b) for whole a and b.
struct AsDistance {
  static constexpr double kSign = 1.0, kGrain = 0.0;
};
struct AsLevel {
  static constexpr double kSign = -1.0, kGrain = 1e-9;
};

// Three buckets in turn. A small wave needs no memory from the heap, which would cost more time than the wave.
template <class Entry>
class Buckets {
 public:
  Buckets() {
    for (Bucket& bucket : three_) bucket.reserve(kNear);
  }
  std::pmr::vector<Entry>& operator[](std::uint64_t b) { return three_[b % 3]; }
  [[nodiscard]] bool empty() const { return three_[0].empty() && three_[1].empty() && three_[2].empty(); }

 private:
  static constexpr std::size_t kNear = 64;
  alignas(Entry) std::array<std::byte, 4 * kNear * sizeof(Entry)> near_;
  std::pmr::monotonic_buffer_resource memory_{near_.data(), near_.size()};
  using Bucket = std::pmr::vector<Entry>;
  std::array<Bucket, 3> three_ = {Bucket(&memory_), Bucket(&memory_), Bucket(&memory_)};
};

// Settles cells outwards from the sources, bucket by bucket, over a field that is unreached everywhere, until `watch` says stop or
// `done` returns true; that is asked after each bucket, with the distance below which all cells are settled. `goes_on` is asked of each settled cell.
template <class Kept, class GoesOn, class Done>
std::uint64_t grow(const Grid& grid, std::vector<double>& field, const std::vector<Cell>& sources, const GoesOn& goes_on,
                   const Done& done, Watch* watch) {
  Buckets<CellIndex> buckets;
  double* const level = field.data();
  const std::uint8_t* const moves = grid.all_moves().data();
  std::uint64_t count = 0;
  for (const Cell source : sources) {
    if (grid.blocked(source)) continue;
    level[grid.index(source)] = 0.0;
    buckets[0].push_back(grid.index(source));
  }
  for (std::uint64_t b = 0; !buckets.empty(); ++b) {
    auto& bucket = buckets[b];
    const auto low = static_cast<double>(b), high = low + 1.0;
    for (const CellIndex at : bucket) {
      const double d = Kept::kSign * level[at];
      if (d < low) continue;   // settled already, by a shorter way
      ++count;
      if (!goes_on(at)) continue;
      for (unsigned open = moves[at]; open != 0; open &= open - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(open));
        const auto to = grid.neighbour(at, k);
        const double next = d + kMoveLengths[k];
        const double before = Kept::kSign * level[to];
        if (next >= before - Kept::kGrain) continue;
        level[to] = Kept::kSign * next;
        const bool soon = next < high + 1.0;
        if (before >= (soon ? high + 1.0 : high + 2.0)) buckets[soon ? b + 1 : b + 2].push_back(to);
      }
    }
    const std::size_t entries = bucket.size();
    bucket.clear();
    if (done(high) || is_stopped(watch, entries)) break;
  }
  return count;
}

constexpr auto kFromAll = [](CellIndex) { return true; };

// Whether a field has come to a cell; without a cell never, so that all of the field is settled.
auto has_come_to(const Grid& grid, std::optional<Cell> cell, const std::vector<double>& field) {
  const CellIndex last = cell && grid.contains(*cell) ? grid.index(*cell) : 0;   // cell 0 is border and is never reached
  return [&field, last](double high) { return std::abs(field[last]) < high; };
}

}  // namespace

DistanceField distance_field(const Grid& grid, const std::vector<Cell>& sources, std::optional<Cell> stop_at, Watch* watch) {
  DistanceField field{std::vector<double>(grid.size(), kUnreached), 0};
  field.settled = grow<AsDistance>(grid, field.distance, sources, kFromAll, has_come_to(grid, stop_at, field.distance), watch);
  return field;
}

std::uint64_t level_field(const Grid& grid, Cell source, std::vector<double>& level, std::optional<Cell> stop_at, Watch* watch) {
  level.assign(grid.size(), -kUnreached);
  return grow<AsLevel>(grid, level, {source}, kFromAll, has_come_to(grid, stop_at, level), watch);
}

// As `grow`, but over a field that has distances already. A cell may be in several buckets, so an entry counts only while its
// distance is that of the cell.
std::uint64_t spread(const Grid& grid, std::vector<double>& levels, std::vector<Offer> offers) {
  std::sort(offers.begin(), offers.end(), [](const Offer& a, const Offer& b) { return a.distance < b.distance; });
  Buckets<Offer> buckets;
  double* const level = levels.data();
  const std::uint8_t* const moves = grid.all_moves().data();
  std::uint64_t count = 0;
  auto offer = offers.begin();
  for (std::uint64_t b = 0; offer != offers.end() || !buckets.empty(); ++b) {
    if (buckets.empty()) b = static_cast<std::uint64_t>(offer->distance);
    auto& bucket = buckets[b];
    const double high = static_cast<double>(b + 1);
    for (; offer != offers.end() && offer->distance < high; ++offer) {
      if (offer->distance >= -level[offer->at] - AsLevel::kGrain) continue;
      level[offer->at] = -offer->distance;
      bucket.push_back(*offer);
    }
    for (const auto [d, at] : bucket) {
      if (d != -level[at]) continue;
      ++count;
      for (unsigned open = moves[at]; open != 0; open &= open - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(open));
        const auto to = grid.neighbour(at, k);
        const double next = d + kMoveLengths[k];
        if (next >= -level[to] - AsLevel::kGrain) continue;
        level[to] = -next;
        buckets[next < high + 1.0 ? b + 1 : b + 2].push_back({next, to});
      }
    }
    bucket.clear();
  }
  return count;
}

std::vector<Cell> shortest_to_entry(const Grid& grid, Cell from, const std::vector<float>& rest, Watch* watch) {
  std::vector<double> distance(grid.size(), kUnreached);
  CellIndex best = 0;
  double least = kUnreached;
  grow<AsDistance>(grid, distance, {from},
                   [&](CellIndex at) {
                     if (std::isinf(rest[at])) return true;
                     const double all = distance[at] + static_cast<double>(rest[at]);
                     if (all < least) {
                       least = all;
                       best = at;
                     }
                     return false;
                   },
                   [&](double high) { return high >= least; }, watch);
  if (least == kUnreached) return {};
  std::vector<Cell> path = descend(grid, distance, grid.cell(best));
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Cell> descend(const Grid& grid, const std::vector<double>& distance, Cell from) {
  std::vector<Cell> path;
  if (grid.blocked(from) || distance[grid.index(from)] == kUnreached) return path;
  path.push_back(from);
  CellIndex at = grid.index(from);
  while (distance[at] > 0.0) {
    double best = 0.0;
    CellIndex next = at;
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid.all_moves()[at] >> k & 1) == 0) continue;
      const auto to = grid.neighbour(at, k);
      const double slope = (distance[at] - distance[to]) / kMoveLengths[k];
      // Sums of the same moves in another order differ in their last bits; a slope counts as steeper only beyond that.
      if (slope > best + 1e-9) {
        best = slope;
        next = to;
      }
    }
    if (next == at) return {};
    at = next;
    path.push_back(grid.cell(at));
  }
  return path;
}

Astar::Astar(const Grid& grid) : grid_(&grid), nodes_(grid.size(), Node{0.0, 0, 0}) {}

void Astar::push(CellIndex at, double distance, double total) {
  auto bucket = static_cast<std::size_t>((total - first_) * kBucketsPerCell + 1e-6);
  bucket = std::max(bucket, current_);
  if (bucket >= buckets_.size()) buckets_.resize(bucket + 16);
  buckets_[bucket].push_back({at, distance});
}

void Astar::expand(const Entry& entry, Cell to) {
  ++expanded_;
  const Cell here = grid_->cell(entry.at);
  for (unsigned open = grid_->all_moves()[entry.at]; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    const auto next = grid_->neighbour(entry.at, k);
    const double distance = entry.distance + kMoveLengths[k];
    Node& node = nodes_[next];
    if (node.search == search_ && node.distance <= distance + 1e-9) continue;
    if (node.search != search_) touched_.push_back(next);
    node = {distance, search_, static_cast<std::uint8_t>(k)};
    push(next, distance, distance + octile_distance(here + kDirections[k], to));
  }
}

std::vector<Cell> Astar::search(Cell from, Cell to, Watch* watch) {
  if (++search_ == 0) {   // the counter has overflowed
    for (Node& node : nodes_) node.search = 0;
    search_ = 1;
  }
  for (auto& bucket : buckets_) bucket.clear();
  expanded_ = 0;
  current_ = 0;
  length_ = kUnreached;
  first_ = octile_distance(from, to);
  const CellIndex start = grid_->index(from), goal = grid_->index(to);
  nodes_[start] = {0.0, search_, 0};
  touched_.assign(1, start);
  push(start, 0.0, first_);
  for (; current_ < buckets_.size(); ++current_) {
    // Within a bucket the order is arbitrary, so a cell may be improved after it was expanded; it is then expanded again.
    while (!buckets_[current_].empty()) {
      if (is_stopped(watch)) return {};
      const Entry entry = buckets_[current_].back();
      buckets_[current_].pop_back();
      if (nodes_[entry.at].distance < entry.distance) continue;
      if (entry.at == goal) length_ = entry.distance;
      if (entry.at != goal && entry.distance + octile_distance(grid_->cell(entry.at), to) < length_ - 1e-9) expand(entry, to);
    }
    if (length_ != kUnreached) break;
  }
  if (length_ == kUnreached) return {};
  std::vector<Cell> path = {to};
  for (CellIndex at = goal; at != start;) {
    at = grid_->neighbour(at, (nodes_[at].by + 4u) % 8);
    path.push_back(grid_->cell(at));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace kb::planners
