#include "planners/controller.h"

#include <utility>

namespace kb::planners {
namespace {

Advice::State state_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kReached: return Advice::State::kArrived;
    case Outcome::kTrapped: return Advice::State::kTrapped;
    case Outcome::kUnreachable: return Advice::State::kUnreachable;
    default: return Advice::State::kLimit;
  }
}

Outcome outcome_of(Advice::State state) {
  switch (state) {
    case Advice::State::kArrived: return Outcome::kReached;
    case Advice::State::kTrapped: return Outcome::kTrapped;
    case Advice::State::kUnreachable: return Outcome::kUnreachable;
    default: return Outcome::kLimit;
  }
}

}  // namespace

PathFollower::PathFollower(const Problem& problem, Result result)
    : result_(std::move(result)), near_m_(problem.grid == nullptr ? 0.0 : 0.25 * problem.grid->cell_m()) {}

Advice PathFollower::next(const Observation& seen) {
  Advice advice;
  advice.target = seen.at;
  advice.trap = result_.trap;
  while (at_ < result_.path.size() && distance(seen.at, result_.path[at_]) <= near_m_) ++at_;
  if (at_ == result_.path.size() || result_.outcome != Outcome::kReached) {
    advice.state = state_of(result_.outcome);
    return advice;
  }
  advice.target = result_.path[at_];
  const Point way = advice.target - seen.at;
  advice.velocity = (1.0 / norm(way)) * way;
  return advice;
}

Result drive(Controller& controller, const Problem& problem, const RunOptions& run, std::uint64_t max_steps) {
  Result result = ended(Outcome::kLimit);
  Watch watch(run);
  Observation seen;
  seen.at = problem.start;
  result.path.push_back(seen.at);
  for (;; ++result.statistics.steps) {
    if (result.statistics.steps >= max_steps) {
      result.statistics.stop = Stop::kSteps;
      break;
    }
    if (watch.stopped()) {
      result.statistics.stop = watch.why();
      break;
    }
    const Advice advice = controller.next(seen);
    if (advice.state != Advice::State::kDrive) {
      result.outcome = outcome_of(advice.state);
      result.trap = advice.trap;
      break;
    }
    const Point way = advice.target - seen.at;
    if (norm(way) > 0.0) seen.heading_rad = std::atan2(way.y, way.x);
    seen.velocity = advice.velocity;
    seen.at = advice.target;
    result.path.push_back(seen.at);
  }
  result.length_m = length(result.path);
  return result;
}

}  // namespace kb::planners
