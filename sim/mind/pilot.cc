#include "sim/mind/pilot.h"

#include <algorithm>

namespace kb::sim {

Pilot::Pilot(const Knowledge& knowledge, const mts::Body& body) : knowledge_(knowledge), controllers_(knowledge.strategies.size()) {
  const mts::Similarity as(body.size);
  const mts::Body small = as.in(body);
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const Strategy& strategy = knowledge.strategies[i];
    controllers_[i].choose(strategy.controller, small, lend(strategy));
    for (const Strategy::Setting& setting : strategy.settings) {
      const mts::Parameter& parameter = *mts::find_parameter(strategy.controller, setting.name.c_str());
      const float value = as.in(setting.value, parameter.unit);
      // Values were checked when they were read; this body may be slower or broader than others, and then does what it can.
      static_cast<void>(controllers_[i].set(parameter.name, std::clamp(value, mts::lowest(parameter, small), mts::highest(parameter, small))));
    }
  }
}

/// Makes the planner or the rules that a controller asks the program for; to be called for the strategies in their order.
mts::Host Pilot::lend(const Strategy& strategy) {
  using Id = mts::ControllerId;
  planners_.emplace_back();
  rules_.emplace_back();
  mts::Host host;
  if (strategy.controller == Id::kNeuralMap || strategy.controller == Id::kGenetic) {
    planners_.back() = std::make_unique<HallPlanner>(strategy.controller == Id::kGenetic ? HallPlanner::Method::kGenetic : HallPlanner::Method::kNeuralMap);
    host.self = planners_.back().get();
    host.look = [](void* self, const mts::WayQuestion& question, mts::Way& way) { return static_cast<HallPlanner*>(self)->look(question, way); };
  }
  if (strategy.controller == Id::kFollowRules) {
    rules_.back() = std::make_unique<HallRules>(knowledge_.program->fuzzy[strategy.control->fuzzy], *strategy.control);
    host.self = rules_.back().get();
    host.decide = [](void* self, const mts::RulesInput& input) { return static_cast<HallRules*>(self)->decide(input); };
  }
  return host;
}

mts::Plight Pilot::plight() const {
  return strategy_ < 0 ? mts::Plight::kNone : controllers_[static_cast<std::size_t>(strategy_)].plight();
}

bool Pilot::lost() const { return strategy_ >= 0 && controllers_[static_cast<std::size_t>(strategy_)].lost(); }

void Pilot::choose(int strategy, Perception& perception, const mts::Senses& senses) {
  if (perception.rests()) suspended_ = -1;   // a manoeuvre that the last mission left unfinished is no part of the next one
  if (strategy == strategy_ && !perception.begins_anew()) return;
  const auto doing = [&](int s) { return s < 0 ? Doing::kNothing : knowledge_.strategies[static_cast<std::size_t>(s)].doing; };
  const bool halts = doing(strategy) == Doing::kStop || strategy < 0, interrupts = halts || doing(strategy) == Doing::kAvoid;
  if (doing(strategy_) == Doing::kCross && interrupts) suspended_ = strategy_;
  if (doing(strategy_) == Doing::kMove && halts && perception.in_hall() && plight() == mts::Plight::kNone && !lost()) suspended_ = strategy_;   // it may be in the door out already
  const bool resumes = strategy >= 0 && strategy == suspended_;
  if (!interrupts) suspended_ = -1;
  strategy_ = strategy;
  if (strategy < 0) return perception.begin(nullptr);
  const Strategy& chosen = knowledge_.strategies[static_cast<std::size_t>(strategy)];
  perception.begin(&chosen, resumes);
  if (HallPlanner* planner = planners_[static_cast<std::size_t>(strategy)].get()) {
    const Memory::Exit* road = perception.road();
    planner->enter(road != nullptr ? road->hall : nullptr, road != nullptr ? road->hall_begins : Spot{});
  }
  if (!resumes) controllers_[static_cast<std::size_t>(strategy)].start(perception.task_for(chosen), senses);
}

mts::Motion Pilot::step(const mts::Senses& senses, float dt_s) {
  if (suspended_ >= 0 && suspended_ != strategy_) {
    mts::Senses reckons = senses;
    reckons.line_known = false;   // another controller turns the robot: its row may sweep over the line out, which does not end the manoeuvre
    static_cast<void>(controllers_[static_cast<std::size_t>(suspended_)].step(reckons, dt_s));
  }
  return strategy_ < 0 ? mts::Motion{} : controllers_[static_cast<std::size_t>(strategy_)].step(senses, dt_s);
}

}  // namespace kb::sim
