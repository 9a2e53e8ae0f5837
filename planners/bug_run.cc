#include "planners/bug_run.h"

#include <algorithm>
#include <cmath>

namespace kb::planners {
namespace {

// Whether c lies straight on behind b, seen from a.
bool is_straight(const Place& a, const Place& b, const Place& c) {
  const Wide ux = Wide{b.x} * a.w - Wide{a.x} * b.w, uy = Wide{b.y} * a.w - Wide{a.y} * b.w;
  const Wide vx = Wide{c.x} * b.w - Wide{b.x} * c.w, vy = Wide{c.y} * b.w - Wide{b.y} * c.w;
  return ux * vy == uy * vx && ux * vx + uy * vy > 0;
}

double halves_between(const Place& a, Node b) {
  const double w = static_cast<double>(a.w);
  return std::abs(static_cast<double>(a.x) / w - b.x) + std::abs(static_cast<double>(a.y) / w - b.y);
}

// Whether c lies between a and b, ends included. All three lie on one line along an axis.
bool lies_between(const Place& a, const Place& c, const Place& b) {
  const auto before = [](std::int64_t p, std::int64_t pw, std::int64_t q, std::int64_t qw) { return Wide{p} * qw <= Wide{q} * pw; };
  const auto within = [&](std::int64_t Place::*axis) {
    const bool up = before(a.*axis, a.w, c.*axis, c.w) && before(c.*axis, c.w, b.*axis, b.w);
    const bool down = before(b.*axis, b.w, c.*axis, c.w) && before(c.*axis, c.w, a.*axis, a.w);
    return up || down;
  };
  return within(&Place::x) && within(&Place::y);
}

}  // namespace

FollowedWalls::FollowedWalls(const Grid& grid) : stride_(static_cast<std::size_t>(2 * grid.width() + 1)) {
  whole_.assign(stride_ * static_cast<std::size_t>(2 * grid.height() + 1), 0);
}

void FollowedWalls::add(const WallEdge& edge, const Place& from, const Place& to) {
  if (!contains_whole(edge)) parts_.push_back({index(edge), from, to});
}

bool FollowedWalls::contains(Node middle, const Place& at) const {
  const std::size_t edge = index(middle);
  if (whole_[edge] != 0) return true;
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return part.edge == edge && lies_between(part.from, at, part.to); });
}

BugRun::BugRun(const Problem& problem, const RunOptions& run, const BugOptions& options)
    : problem_(problem), options_(options), watch_(run), goal_(problem.goal_cell()) {
  path_.push_back(place(centre_node(problem.start_cell())));
}

std::optional<LineCrossing> BugRun::go_straight(Node from) {
  LineWalk line(from, goal_);
  while (const auto crossing = line.next()) {
    if (!is_hit(grid(), *crossing)) continue;
    go_to(crossing->at);
    return crossing;
  }
  go_to(place(goal_node()));
  return std::nullopt;
}

Hand BugRun::hand_at(const LineCrossing& hit) const {
  switch (options_.hand) {
    case HandRule::kLeft: return Hand::kLeft;
    case HandRule::kRight: return Hand::kRight;
    case HandRule::kAlternate: return hits_ % 2 == 1 ? Hand::kLeft : Hand::kRight;
    case HandRule::kSmallerTurn: break;
  }
  return hand_towards(grid(), hit, goal_node());
}

Hand BugRun::take_hit(const LineCrossing& hit) {
  ++hits_;
  return hand_at(hit);
}

void BugRun::go_to(const Place& place) {
  if (path_.back() == place) return;
  if (path_.size() >= 2 && is_straight(path_[path_.size() - 2], path_.back(), place)) {
    path_.back() = place;
  } else {
    path_.push_back(place);
  }
}

bool BugRun::exhausted() {
  out_of_steps_ = ++halves_ > options_.max_halves;
  return out_of_steps_ || watch_.stopped();
}

Result BugRun::finish(Outcome outcome) {
  Result result = ended(outcome);
  result.path.reserve(path_.size());
  for (const Place& place : path_) result.path.push_back(to_point(grid(), place));
  result.length_m = length(result.path);
  result.statistics.steps = halves_;
  result.statistics.stop = watch_.stopped_now() ? watch_.why() : out_of_steps_ ? Stop::kSteps : Stop::kNone;
  if (outcome != Outcome::kLimit) result.statistics.stop = Stop::kNone;
  if (outcome == Outcome::kTrapped) result.trap = {Trap::Kind::kCycle, result.path.back(), 0.0};
  const double cell_m = grid().cell_m();
  const double straight_m = distance(result.path.front(), grid().centre(goal_));
  const double bound_m = straight_m + granted_cells_ * cell_m;
  const double share = result.length_m > 0.0 ? std::min(1.0, followed_cells_ * cell_m / result.length_m) : 0.0;
  result.statistics.more = {{"hits", static_cast<double>(hits_)},
                            {"loops", static_cast<double>(loops_)},
                            {"followed share", share}};
  if (granted_cells_ < kNoBound) result.statistics.more.push_back({"length bound", bound_m});
  const bool proved = outcome == Outcome::kReached || outcome == Outcome::kUnreachable;
  if (proved && granted_cells_ < kNoBound && result.length_m > bound_m * (1.0 + 1e-9)) {
    result.outcome = Outcome::kNumeric;
    result.refused = "the path is longer than the method's bound";
  }
  return result;
}

// ---- loops

double PassedLoop::first_piece() const { return nodes.empty() ? 0.0 : halves_between(hit, nodes.front()); }
double PassedLoop::last_piece() const { return nodes.empty() ? 0.0 : halves_between(hit, nodes.back()); }

double PassedLoop::length() const {
  return nodes.empty() ? 0.0 : 0.5 * (first_piece() + static_cast<double>(nodes.size() - 1) + last_piece());
}

void PassedLoop::return_to(std::size_t i, BugRun& run) const {
  const double ahead = 0.5 * (first_piece() + static_cast<double>(i));
  const double back = 0.5 * (last_piece() + static_cast<double>(nodes.size() - 1 - i));
  run.count_followed(std::min(ahead, back));
  if (ahead <= back) {
    for (std::size_t k = 0; k <= i; ++k) run.go_to(place(nodes[k]));
  } else {
    for (std::size_t k = nodes.size(); k-- > i;) run.go_to(place(nodes[k]));
  }
}

void NearestNode::offer(std::size_t i, Node node, bool way_free) {
  if (index_) {
    const bool nearer = is_nearer(place(node), place(node_), goal_);
    const bool as_near = !nearer && !is_nearer(place(node_), place(node), goal_);
    if (!nearer && !(as_near && way_free && !way_free_)) return;
  }
  index_ = i;
  node_ = node;
  way_free_ = way_free;
}

bool way_is_free(const WallWalk& walk, Cell goal) { return walk.can_enter(LineWalk(walk.node(), goal).cell()); }

}  // namespace kb::planners
