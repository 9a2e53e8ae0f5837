#include "sim/mind/pilot.h"

#include "sim/robot_body.h"

namespace kb::sim {

Pilot::Pilot(const Knowledge& knowledge) : knowledge_(knowledge), controllers_(knowledge.strategies.size()) {
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    controllers_[i].choose(knowledge.strategies[i].controller, kRobot);
    for (const Strategy::Setting& setting : knowledge.strategies[i].settings) {
      static_cast<void>(controllers_[i].set(setting.name.c_str(), setting.value));   // was checked when it was read
    }
  }
}

void Pilot::choose(int strategy, Perception& perception, const mts::Senses& senses) {
  if (strategy == strategy_) return;
  const auto doing = [&](int s) { return s < 0 ? Doing::kNothing : knowledge_.strategies[static_cast<std::size_t>(s)].doing; };
  const bool interrupts = doing(strategy) == Doing::kAvoid || doing(strategy) == Doing::kStop || strategy < 0;
  if (doing(strategy_) == Doing::kCross && interrupts) suspended_ = strategy_;
  const bool resumes = strategy >= 0 && strategy == suspended_;
  if (!interrupts) suspended_ = -1;
  strategy_ = strategy;
  if (strategy < 0) return perception.begin(nullptr);
  const Strategy& chosen = knowledge_.strategies[static_cast<std::size_t>(strategy)];
  perception.begin(&chosen);
  if (!resumes) controllers_[static_cast<std::size_t>(strategy)].start(perception.task_for(chosen), senses);
}

mts::Motion Pilot::step(const mts::Senses& senses, float dt_s) {
  if (suspended_ >= 0 && suspended_ != strategy_) {
    static_cast<void>(controllers_[static_cast<std::size_t>(suspended_)].step(senses, dt_s));
  }
  return strategy_ < 0 ? mts::Motion{} : controllers_[static_cast<std::size_t>(strategy_)].step(senses, dt_s);
}

}  // namespace kb::sim
