#include "sim/drive/lookout_helm.h"

#include <algorithm>

namespace kb::sim {
namespace {

std::vector<mts::FactRun> runs_of(const FactCells& facts) {
  std::vector<FactIndex> landmarks;
  for (const NamedFact& landmark : facts.landmarks) landmarks.push_back(landmark.fact);
  std::ranges::sort(landmarks);
  std::vector<mts::FactRun> runs;
  for (const FactIndex fact : landmarks) {
    if (!runs.empty() && fact < runs.back().first + runs.back().count) continue;   // of two maps
    if (!runs.empty() && fact == runs.back().first + runs.back().count) ++runs.back().count;
    else runs.push_back({fact, 1});
  }
  return runs;
}

std::vector<std::string> names_of_facts(const program::Program& program) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < program.facts; ++i) names.emplace_back(program.cells[i].name);
  return names;
}

const char* name_of(mts::ControllerId id) {
  return std::ranges::find_if(mts::kControllers, [&](const mts::ControllerEntry& entry) { return entry.id == id; })->name;
}

void add_word(std::string& words, const std::string& word) { words += words.empty() ? word : ' ' + word; }

}  // namespace

LookoutHelm::LookoutHelm(const Knowledge& knowledge, const MapRoads& roads, const mts::Body& body, std::uint32_t dt_us)
    : knowledge_(&knowledge),
      roads_(&roads),
      names_(names_of_facts(*knowledge.program)),
      landmarks_(runs_of(knowledge.facts)),
      pilot_(body),
      lookout_(body, {landmarks_.data(), landmarks_.size()}, [this](const char* landmark, const char* exit) { return roads_->find(landmark, exit); }, {&names_}),
      machine_(*knowledge.program, *knowledge.tables),
      facts_(knowledge.program->facts, 0.0f),
      dt_us_(dt_us),
      firing_(static_cast<float>(knowledge.program->settings.firing)) {
  lines_.reserve(knowledge.strategies.size());
  for (const Strategy& strategy : knowledge.strategies) add_line(strategy);
}

void LookoutHelm::add_line(const Strategy& strategy) {
  Line& line = lines_.emplace_back();
  if (strategy.control != nullptr) {
    for (const program::Control::Argument& argument : strategy.control->arguments) {
      line.arguments.push_back({argument.name.c_str(), argument.word.c_str(), static_cast<float>(argument.number), argument.unit.c_str()});
    }
  }
  line.line = {name_of(strategy.controller), line.arguments.data(), static_cast<std::uint32_t>(line.arguments.size())};
}

void LookoutHelm::press(program::CellId fact, bool held) { pressed_.push_back({fact, held ? Mind::kHeld : kPressTicks}); }

void LookoutHelm::release(program::CellId fact) {
  std::erase_if(pressed_, [&](const Button& button) { return button.fact == fact; });
}

void LookoutHelm::read(const TagHeard& tag) {
  sign_ = {};
  if (tag.memory == nullptr) return;
  closed_.clear();
  cross_by_.clear();
  for (const Memory::Exit& exit : tag.memory->exits) {
    if (exit.closed) add_word(closed_, exit.name);
  }
  for (const std::string& method : tag.memory->methods) add_word(cross_by_, method);
  sign_ = {tag.memory->landmark.c_str(), tag.memory->exits[tag.arm].name.c_str(), tag.memory->safe, closed_.c_str(), cross_by_.c_str()};
}

mts::Motion LookoutHelm::step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) {
  const mts::Motion motion = pilot_.step(senses, dt_s);
  read(tag);
  lookout_.step(pilot_, sign_, dt_s);
  if ((now_us + kStepUs) % static_cast<std::int64_t>(dt_us_) == 0) tick();
  return motion;
}

/// In the last period before the simulator's own tick; the strategy drives from the next one on.
void LookoutHelm::tick() {
  lookout_.write(facts_);
  for (const Button& button : pressed_) facts_[program::index(button.fact)] = kSure;
  const program::Tick tick = machine_.tick(facts_, dt_us_);
  if (on_tick) on_tick(tick);
  for (Button& button : pressed_) {
    facts_[program::index(button.fact)] = 0.0f;
    if (button.ticks != Mind::kHeld) --button.ticks;
  }
  std::erase_if(pressed_, [](const Button& button) { return button.ticks <= 0; });
  const std::size_t first = knowledge_->program->cells.size() - knowledge_->program->strategies;
  strategy_ = tick.strategy == program::CellId::kNone ? -1 : static_cast<int>(program::index(tick.strategy) - first);
  const mts::MapRoad* const road = roads_->of_leg([&](program::CellId leg) { return high(leg); });
  pilot_.choose(strategy_ < 0 ? nullptr : &lines_[static_cast<std::size_t>(strategy_)].line, road, road == nullptr ? knowledge_->limits.lowest() : mts::kInfinity);
}

Judge::Belief LookoutHelm::belief() const {
  Judge::Belief belief;
  const auto leg = std::ranges::find_if(knowledge_->legs, [&](const Leg& one) { return high(one.cell); });
  if (leg != knowledge_->legs.end()) belief.leg = &*leg;
  if (strategy_ >= 0) belief.strategy = &knowledge_->strategies[static_cast<std::size_t>(strategy_)];
  belief.driving = belief.strategy != nullptr && belief.strategy->drives();
  belief.reports = !reports().empty();
  return belief;
}

std::optional<bool> LookoutHelm::mission() const {
  return std::ranges::any_of(knowledge_->routes, [&](program::CellId route) { return high(route); });
}

std::vector<std::string> LookoutHelm::reports() const {
  std::vector<std::string> names;
  for (const program::CellId report : knowledge_->reports) {
    if (high(report)) names.emplace_back(knowledge_->program->cells[program::index(report)].name);
  }
  return names;
}

}  // namespace kb::sim
