#include "planners/fairway_bug.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planners/bug_run.h"
#include "planners/fairway.h"
#include "planners/methods.h"

namespace kb::planners {
namespace {

/// How far the robot sees. It may also leave a wall by a free straight line to the point of the fairway that is this far beyond the
/// hit (2 p0 in the paper's terms; p0 is 3 cells).
constexpr std::uint32_t kRangeCells = 6;
constexpr std::uint64_t kMostHalves = 50'000'000;   ///< half cells of wall to follow before kLimit

class FairwayBug {
 public:
  FairwayBug(const Problem& problem, const Grid& actual, const RunOptions& run)
      : problem_(problem), actual_(actual), watch_(run), map_(*problem.grid) {}

  Result go() {
    Cell at = problem_.start_cell();
    path_.push_back(place(centre_node(at)));
    while (at != problem_.goal_cell()) {
      chart(at);
      if (way_.empty()) return finish(watch_.why() == Stop::kNone ? Outcome::kUnreachable : Outcome::kLimit);
      if (!sail(at)) return finish(Outcome::kLimit);
    }
    return finish(Outcome::kReached);
  }

 private:
  // Finds the fairway from here, and for each node (middle of a side, or corner) that it passes, the move by which it does.
  void chart(Cell from) {
    way_ = find_fairway(map_, from, problem_.goal_cell(), &watch_).cells;
    passes_.clear();
    for (std::size_t i = 0; i + 1 < way_.size(); ++i) {
      passes_[{way_[i].x + way_[i + 1].x + 1, way_[i].y + way_[i + 1].y + 1}] = i;
    }
  }

  // Follows the fairway to its end, or until it has gone once round an obstacle. False if it is out of steps. `at`: where the
  // robot is in the end.
  bool sail(Cell& at) {
    for (std::size_t i = 0; i + 1 < way_.size();) {
      at = way_[i];
      LineWalk line(centre_node(at), way_[i + 1]);
      auto hit = line.next();
      while (hit && !is_hit(actual_, *hit)) hit = line.next();
      if (!hit) {
        go_to(place(centre_node(way_[++i])));
        continue;
      }
      go_to(hit->at);
      ++hits_;
      touch(hit->after);
      const Round round = follow(*hit, i);
      if (round.stopped) return false;
      if (round.next == 0) {
        at = hit->before;
        go_to(place(centre_node(at)));
        return true;
      }
      i = round.next;
      go_to(place(centre_node(way_[i])));
    }
    at = way_.back();
    return true;
  }

  struct Round {
    std::size_t next = 0;   // place on the fairway to go on from; 0: a closed loop
    bool stopped = false;
  };
  Round follow(const LineCrossing& hit, std::size_t at) {
    const Hand hand = hand_towards(actual_, hit, centre_node(way_[std::min(at + kRangeCells, way_.size() - 1)]));
    WallWalk walk(actual_, hit.at, edge_after_hit(actual_, hit, hand), hand);
    while (walk.next()) {
      if (++halves_ > kMostHalves || watch_.stopped()) return {0, true};
      touch(hand == Hand::kLeft ? walk.edge().left() : walk.edge().right());
      go_to(place(walk.node()));
      const auto met = passes_.find({walk.node().x, walk.node().y});
      // >=: where obstacles are joined, the robot can take up the same move on the other side of the joint.
      if (met != passes_.end() && met->second >= at && walk.can_enter(way_[met->second + 1])) {
        return {met->second + 1, false};
      }
      const std::size_t behind = std::min(at + kRangeCells, way_.size() - 1);
      if (behind > at && sees(walk, way_[behind])) return {behind, false};
    }
    go_to(hit.at);
    ++loops_;
    return {};
  }

  [[nodiscard]] bool sees(const WallWalk& walk, Cell target) const {
    const Node to = centre_node(target), from = walk.node();
    const std::int64_t dx = to.x - from.x, dy = to.y - from.y, range = 2 * std::int64_t{kRangeCells};
    if (dx * dx + dy * dy > range * range) return false;
    LineWalk line(from, target);
    if (!walk.can_enter(line.cell())) return false;
    while (const auto crossing = line.next()) {
      if (is_hit(actual_, *crossing)) return false;
    }
    return true;
  }

  void touch(Cell cell) {
    if (!map_.contains(cell) || map_.blocked(cell) || actual_.free(cell)) return;
    map_.set_blocked(cell, true);
    ++touched_;
  }

  void go_to(const Place& place) {
    if (!(path_.back() == place)) path_.push_back(place);
  }

  Result finish(Outcome outcome) {
    Result result = ended(outcome);
    for (const Place& place : path_) result.path.push_back(to_point(actual_, place));
    result.length_m = length(result.path);
    result.statistics.steps = halves_;
    if (outcome == Outcome::kLimit) result.statistics.stop = watch_.why() == Stop::kNone ? Stop::kSteps : watch_.why();
    result.statistics.more = {{"hits", static_cast<double>(hits_)},
                              {"loops", static_cast<double>(loops_)},
                              {"touched", static_cast<double>(touched_)}};
    return result;
  }

  const Problem& problem_;
  const Grid& actual_;
  Watch watch_;
  Grid map_;   // what is known
  std::vector<Cell> way_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> passes_;
  std::vector<Place> path_;
  std::uint64_t hits_ = 0, loops_ = 0, touched_ = 0, halves_ = 0;
};

}  // namespace

Result fairway_bug(const Problem& problem, const Grid& actual, const RunOptions& run) {
  if (actual.width() != problem.grid->width() || actual.height() != problem.grid->height()) {
    return rejected(Fault::kBadParameter);
  }
  if (actual.blocked(problem.start_cell())) return rejected(Fault::kStartBlocked);
  if (actual.blocked(problem.goal_cell())) return rejected(Fault::kGoalBlocked);
  return FairwayBug(problem, actual, run).go();
}

Result run_fairway_bug(const Problem& problem, const RunOptions& run) { return fairway_bug(problem, *problem.grid, run); }

}  // namespace kb::planners
