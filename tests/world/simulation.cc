#include "tests/world/simulation.h"

#include <algorithm>

namespace kb::world {

Simulation::Simulation(const Knowledge& knowledge, Mind& mind, World start)
    : world(std::move(start)), knowledge_(knowledge), mind_(mind), facts_(knowledge, world.map), promises_(knowledge) {
  const program::Program& program = knowledge.program();
  for (std::size_t i = program.cells.size() - program.strategies; i < program.cells.size(); ++i) {
    actions_.push_back(action_of(program.cells[i].name));
  }
  ran_.resize(actions_.size());
}

void Simulation::push_buttons(Readings& now) {
  for (Button& button : pressed_) {
    now.set(button.name, kSure);
    --button.ticks;
  }
  std::erase_if(pressed_, [](const Button& button) { return button.ticks <= 0; });
}

const program::Tick& Simulation::tick() {
  Readings now = sense(world);
  push_buttons(now);
  for (std::size_t i = 0; i < disturbances.size(); ++i) disturbances[i](*this, now);
  const auto dt_us = static_cast<std::uint32_t>(dt_ms * 1000);
  const auto facts = facts_.facts(now);
  last_ = mind_.tick(facts, dt_us);
  ++ticks_;
  if (observer) observer(facts, dt_us, last_);
  judge(last_);
  if (keep_trace) trace_.push_back({last_, world.pose});
  Action action;
  if (last_.strategy != program::CellId::kNone) {
    const std::size_t strategy = program::index(last_.strategy) - (knowledge_.program().cells.size() - actions_.size());
    action = actions_[strategy];
    ran_[strategy] = true;
  }
  drive(world, action, dt_ms);
  return last_;
}

void Simulation::judge(const program::Tick& tick) {
  conflicts_ += static_cast<int>(tick.conflicts.size());
  overlaps_ += tick.active.size() > 1;
  if (broken_promise_.empty()) broken_promise_ = promises_.broken(mind_);
  if (promises_.on_a_mission(mind_)) {
    started_ = true;
  } else if (started_) {
    ended_ = true;
  }
}

bool Simulation::run(int ticks, const Until& until) {
  for (int i = 0; i < ticks; ++i) {
    tick();
    if (ended_ || (until && until(*this))) return true;
  }
  return false;
}

void Simulation::begin_again() {
  started_ = ended_ = false;
  conflicts_ = 0;
  world.way.clear();
}

bool Simulation::high(program::CellId cell) const {
  return mind_.value(cell) >= static_cast<float>(knowledge_.program().settings.firing);
}

std::string_view Simulation::strategy_name(program::CellId strategy) const {
  return strategy == program::CellId::kNone ? std::string_view{} : knowledge_.name(strategy);
}

bool Simulation::ever_ran(std::string_view strategy) const {
  const program::Program& program = knowledge_.program();
  return ran_[program::index(knowledge_.cell(strategy)) - (program.cells.size() - program.strategies)];
}

std::string Simulation::help() const {
  std::string reports;
  for (const char* report : {"lost", "refused", "no_track", "no_line", "no_ranges", "blocked", "astray"}) {
    if (!high("Help." + std::string(report))) continue;
    if (!reports.empty()) reports += ' ';
    reports += report;
  }
  return reports;
}

}  // namespace kb::world
