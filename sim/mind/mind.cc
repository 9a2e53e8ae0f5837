#include "sim/mind/mind.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim {

Mind::Mind(const Knowledge& knowledge)
    : knowledge_(&knowledge),
      machine_(knowledge.image != nullptr ? tables::Machine(*knowledge.program, *knowledge.image) : tables::Machine(*knowledge.program, *knowledge.tables)),
      readings_(knowledge.program->perception.readings()),
      facts_(knowledge.program->facts, 0.0f),
      cells_(knowledge.program->cells.size(), 0.0f),
      before_(knowledge.program->facts, 0.0f),
      firing_(static_cast<float>(knowledge.program->settings.firing)) {
  if (knowledge.perception) looker_ = tables::make_looker(*knowledge.program, *knowledge.perception);
}

void Mind::take(const Knowledge& next) {
  machine_.take(*next.program, *next.image);
  knowledge_ = &next;
  cells_.assign(next.program->cells.size(), 0.0f);
  if (next.perception) looker_ = tables::make_looker(*next.program, *next.perception);
  for (const auto& [reading, text] : std::map(texts_)) {   // its facts may ask for other texts
    if (readings_.there[reading] != 0) read(reading, &text, readings_.at_us[reading]);
  }
}

void Mind::set_clock(std::int64_t now_us) {
  for (std::int64_t& at_us : readings_.at_us) at_us = std::min(at_us, now_us);
}

void Mind::press(program::CellId fact, int ticks, float certainty) { pressed_.push_back({fact, ticks, certainty}); }

void Mind::release(program::CellId fact) {
  std::erase_if(pressed_, [&](const Button& button) { return button.fact == fact; });
}

void Mind::read(std::uint32_t reading, const std::string* text, std::int64_t now_us) {
  if (text == nullptr) return silence(reading);
  texts_[reading] = *text;
  const auto& texts = knowledge_->program->perception.sensor_of(reading).texts;
  const auto found = std::lower_bound(texts.begin(), texts.end(), *text);
  const bool known = found != texts.end() && *found == *text;
  readings_.set(reading, known ? static_cast<float>(found - texts.begin() + 1) : 0.0f, now_us);
}

void Mind::perceive(const Perceived& perceived, std::int64_t now_us) {
  using What = SensorFeed::What;
  const mts::Senses& senses = *perceived.senses;
  for (const SensorFeed& feed : knowledge_->feeds) {
    for (std::uint32_t i = 0; i < feed.count; ++i) {
      if (feed.what == What::kLine && senses.line_known) readings_.set(feed.first + i, senses.line[i], now_us);
      if (feed.what == What::kRange && senses.range_known) {
        if (std::isnan(senses.range_m[i])) readings_.there[feed.first + i] = 0;
        else readings_.set(feed.first + i, senses.range_m[i], now_us);
      }
    }
    if (feed.what == What::kCompass && senses.heading_known) {
      const double degrees = 90.0 - static_cast<double>(senses.heading_rad) * 180.0 / kPi;   // clockwise from north
      readings_.set(feed.first, static_cast<float>(degrees < 0.0 ? degrees + 360.0 : degrees >= 360.0 ? degrees - 360.0 : degrees), now_us);
    }
    if (feed.what == What::kSpeed && senses.odometry_known) readings_.set(feed.first, senses.speed_m_s, now_us);
    if (feed.what == What::kTag) read(feed.first, perceived.tag, now_us);
    if (feed.what == What::kMemory) read(feed.first, perceived.memory, now_us);
  }
  for (std::size_t i = facts_.size(); i < cells_.size(); ++i) cells_[i] = machine_.value(static_cast<program::CellId>(i));
  looker_->look(readings_, now_us, cells_, facts_);
}

const program::Tick& Mind::tick(const Perceived& perceived, std::int64_t now_us, std::uint32_t dt_us) {
  std::swap(before_, facts_);
  std::ranges::copy(perceived.facts, facts_.begin());
  if (looker_) perceive(perceived, now_us);
  for (Button& button : pressed_) {
    facts_[program::index(button.fact)] = button.certainty;
    if (button.ticks != kHeld) --button.ticks;
  }
  std::erase_if(pressed_, [](const Button& button) { return button.ticks <= 0; });
  tick_ = machine_.tick(facts_, dt_us);
  const std::size_t first = knowledge_->program->cells.size() - knowledge_->program->strategies;
  strategy_ = tick_.strategy == program::CellId::kNone ? -1 : static_cast<int>(program::index(tick_.strategy) - first);
  for (const program::Perceived& fact : knowledge_->program->perception.perceived) {
    const std::size_t f = program::index(fact.fact);
    if (facts_[f] != before_[f]) tick_.perceived.push_back({fact.fact, facts_[f]});
  }
  std::sort(tick_.perceived.begin(), tick_.perceived.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  return tick_;
}

}  // namespace kb::sim
