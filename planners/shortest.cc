#include "planners/shortest.h"

#include <algorithm>
#include <array>
#include <bit>

namespace kb::planners {
namespace {

constexpr double kBucketsPerCell = 8.0;   // of A*; finer gains nothing, coarser reopens more

// Settles cells outwards, bucket by bucket, until `done` says so; it is asked after each bucket with the distance below which
// all is settled, and told each cell that is settled.
template <class Settled, class Done>
void grow(const Grid& grid, const std::vector<Cell>& sources, DistanceField& field, const Settled& settled,
          const Done& done) {
  field.distance.assign(grid.size(), kUnreached);
  std::array<std::vector<CellIndex>, 3> buckets;
  double* const distance = field.distance.data();
  const std::uint8_t* const moves = grid.all_moves().data();
  for (const Cell source : sources) {
    if (grid.blocked(source)) continue;
    distance[grid.index(source)] = 0.0;
    buckets[0].push_back(grid.index(source));
  }
  for (std::uint64_t b = 0;; ++b) {
    std::vector<CellIndex>& bucket = buckets[b % 3];
    if (bucket.empty() && buckets[(b + 1) % 3].empty() && buckets[(b + 2) % 3].empty()) return;
    const auto low = static_cast<double>(b), high = low + 1.0;
    for (const CellIndex at : bucket) {
      const double d = distance[at];
      if (d < low) continue;   // settled before, by a shorter way
      ++field.settled;
      settled(at);
      for (unsigned open = moves[at]; open != 0; open &= open - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(open));
        const auto to = grid.neighbour(at, k);
        const double next = d + kMoveLengths[k];
        const double before = distance[to];
        if (next >= before) continue;
        distance[to] = next;
        const bool soon = next < high + 1.0;
        if (before >= (soon ? high + 1.0 : high + 2.0)) buckets[(soon ? b + 1 : b + 2) % 3].push_back(to);
      }
    }
    bucket.clear();
    if (done(high)) return;
  }
}

}  // namespace

DistanceField distance_field(const Grid& grid, const std::vector<Cell>& sources, std::optional<Cell> stop_at) {
  DistanceField field;
  const CellIndex last = stop_at && grid.contains(*stop_at) ? grid.index(*stop_at) : 0;   // 0 is border: never reached
  grow(grid, sources, field, [](CellIndex) {}, [&](double high) { return field.distance[last] < high; });
  return field;
}

std::vector<Cell> shortest_to_marked(const Grid& grid, Cell from, const std::vector<std::uint8_t>& marks) {
  DistanceField field;
  CellIndex best = 0;
  double least = kUnreached;
  grow(grid, {from}, field,
       [&](CellIndex at) {
         if (marks[at] == 0 || field.distance[at] >= least) return;
         least = field.distance[at];
         best = at;
       },
       [&](double) { return least != kUnreached; });
  if (least == kUnreached) return {};
  std::vector<Cell> path = descend(grid, field.distance, grid.cell(best));
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
      // Sums of moves in another order differ in their last bits; a slope counts as steeper only beyond that.
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
    const auto next = static_cast<CellIndex>(static_cast<std::int32_t>(entry.at) + grid_->steps()[k]);
    const double distance = entry.distance + kMoveLengths[k];
    Node& node = nodes_[next];
    if (node.search == search_ && node.distance <= distance + 1e-9) continue;
    if (node.search != search_) touched_.push_back(next);
    node = {distance, search_, static_cast<std::uint8_t>(k)};
    push(next, distance, distance + octile_distance(here + kDirections[k], to));
  }
}

std::vector<Cell> Astar::search(Cell from, Cell to) {
  if (++search_ == 0) {   // the counter has gone round
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
    at = static_cast<CellIndex>(static_cast<std::int32_t>(at) - grid_->steps()[nodes_[at].by]);
    path.push_back(grid_->cell(at));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace kb::planners
