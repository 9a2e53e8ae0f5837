#include "tools/kbc/wire/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/program/text.h"
#include "compiler/source/utf8.h"
#include "tools/kbc/wire/named.h"

namespace kb::wire {

using diagnostics::Kind;

namespace {

constexpr std::size_t kMostGiven = 20'000;   // twice as many as can be under way at once
constexpr std::size_t kMostSaid = 1'000;     // different odd things that are told of
constexpr int kManyPauses = 5;   // so many pauses in a row mean that the host is just slow

/// The first multiple of `dt_us` from `t_us` on.
std::int64_t multiple_from(std::int64_t t_us, std::int64_t dt_us) { return (t_us + dt_us - 1) / dt_us * dt_us; }

/// The index of the exit of that name in a memory; the number of exits if there is none.
std::size_t exit_of(const sim::Memory& memory, std::string_view name) {
  const auto found = std::find_if(memory.exits.begin(), memory.exits.end(), [&](const sim::Memory::Exit& exit) { return exit.name == name; });
  return static_cast<std::size_t>(found - memory.exits.begin());
}

}  // namespace

Exchange::Exchange(const sim::Knowledge& knowledge, const sim::Labyrinth& labyrinth, const sim::Scenario& robot, ExchangeOptions options)
    : knowledge_(&knowledge), abort_(knowledge.find("Abort")), pause_(knowledge.find("Pause")), labyrinth_(labyrinth), options_(std::move(options)), floor_(labyrinth),
      body_(robot.body), driver_(knowledge, labyrinth, sim::as_driven(robot.body, robot.sensors.range, robot.drive)), names_(*knowledge.program), sensors_(knowledge) {
  for (const sim::CrossingMethods& crossing : robot.crossings) floor_.set_methods(crossing.crossing, crossing.methods);
}

void Exchange::take(const sim::Knowledge& next) {
  driver_.take(next);
  knowledge_ = &next;
}

std::string Exchange::answer(std::string_view text, std::uint64_t number) {
  Answer answer;
  line_.reset();
  warning_.reset();
  mistake_.reset();
  const bool again = !text_.empty() && text == text_;
  text_.clear();
  if (again) return answer_;
  mistake_ = take(text, answer);
  if (mistake_) {
    hear_stops(text);
    return print_answer(*mistake_, number, actions_);
  }
  text_ = text;
  return answer_ = print_answer(answer);
}

/// See note [a refused line that stops].
void Exchange::hear_stops(std::string_view text) {
  for (const std::string& name : named_in(text)) {
    const program::CellId cell = names_.find(name);
    const bool stops = cell != program::CellId::kNone && (cell == abort_ || cell == pause_);
    if (stops && std::find(stops_.begin(), stops_.end(), cell) == stops_.end()) stops_.push_back(cell);
  }
}

std::optional<Mistake> Exchange::take(std::string_view text, Answer& answer) {
  if (text.size() > kLongestLine) return Mistake{Kind::kWireLineLong, {std::to_string(kLongestLine), {}, {}}, {}, {source::FileId::kNone, 0, 1}};
  auto read = read_line(text);
  if (auto* mistake = std::get_if<Mistake>(&read)) return std::move(*mistake);
  Line& line = std::get<Line>(read);
  if (auto mistake = look_up(line)) return mistake;
  bool set_back = false;
  if (auto mistake = follow_clock(line, set_back)) return mistake;

  const std::int64_t t_us = line.t_us + offset_us_, gap_us = t_us - clock_.t_us;
  const bool away = began_ && (set_back || gap_us > options_.pause_us);
  leapt_from_ = away && !set_back ? std::optional(clock_) : std::nullopt;
  pauses_ = away ? pauses_ + 1 : 0;
  warn_of_what_is_odd(line);
  warn_of_what_nobody_hears(line);
  if (pauses_ == kManyPauses) warning_ = Mistake{Kind::kWireSlow, {std::to_string(kManyPauses), program::seconds_text(options_.pause_us), {}}, "t", line.t_at};
  hear_buttons(away);
  if (away || rests()) clock_.ticked_us.reset();
  if (!began_ || away) clock_.next_us = multiple_from(t_us, options_.dt_us);
  else if (t_us > clock_.next_us) tick_before(t_us, answer);

  period_s_ = static_cast<float>(static_cast<double>(began_ && !away ? gap_us : sim::kControlUs) / 1e6);
  count_from_near(line);
  mts::Senses senses = line.senses;
  if (line.guide) set_line(*line.guide, body_, senses);
  wheels_ = driver_.hear(senses, tag_, period_s_, line.guide.has_value());
  hear_sensors(t_us);
  if (stands() || away) wheels_ = {};
  answer.wheels = wheels_;
  answer.t_us = line.t_us;
  clock_.t_us = t_us;
  began_ = true;
  tell(answer);
  line_ = std::move(line);
  return std::nullopt;
}

/// See note [odometry of any zero].
void Exchange::count_from_near(Line& line) {
  if (!std::isnan(line.senses.x_m)) line.senses.x_m = x_.of(line.x_m), line.senses.y_m = y_.of(line.y_m);
  line.senses.turned_rad = near_zero(line.turned_rad);
}

/// See note [a clock that leaps].
std::optional<Mistake> Exchange::follow_clock(const Line& line, bool& set_back) {
  const std::optional<std::int64_t> refused_us = std::exchange(refused_us_, std::nullopt);
  const std::int64_t t_us = line.t_us + offset_us_;
  if (!began_ || t_us > clock_.t_us) return std::nullopt;
  const std::string now = program::seconds_text(line.t_us), before = program::seconds_text(clock_.t_us - offset_us_);
  const bool goes_on = refused_us && line.t_us > *refused_us && line.t_us - *refused_us <= options_.pause_us;
  const std::int64_t since_us = goes_on && leapt_from_ ? *refused_us + offset_us_ - leapt_from_->t_us : 0;
  if (since_us > 0 && since_us <= options_.pause_us) {
    warning_ = Mistake{Kind::kWireLeap, {now, before, {}}, "t", line.t_at};
    clock_ = *leapt_from_;
    driver_.mind().set_clock(clock_.t_us);
    return std::nullopt;
  }
  set_back = goes_on && clock_.t_us - t_us > options_.pause_us;   // lines that overtake one another are closer together
  if (set_back) {
    offset_us_ = clock_.t_us + sim::kControlUs - line.t_us;
    return std::nullopt;
  }
  refused_us_ = line.t_us;
  return Mistake{Kind::kWireTime, {now, before, {}}, "t", line.t_at};
}

/// Whether it was told of this before, or of so much that nobody reads on. It counts as told from now on.
bool Exchange::was_said(std::string what) { return said_once_.size() >= kMostSaid || !said_once_.insert(std::move(what)).second; }

/// What is understood, and probably not meant so.
void Exchange::warn_of_what_is_odd(const Line& line) {
  if (warning_) return;
  if (line.tag && tag_.memory == nullptr && !was_said("tag " + line.tag->landmark.text)) {
    std::vector<std::string_view> names;
    for (const sim::Crossing& one : labyrinth_.crossings) names.emplace_back(one.name);
    const std::string& said = line.tag->landmark.text;
    warning_ = Mistake{Kind::kWireOtherTag, {source::printable(said), {}, {}}, "tag.landmark", line.tag->landmark.at, diagnostics::closest(said, names)};
  } else if (line.turns_rad && !was_said("turns")) {
    warning_ = Mistake{Kind::kWireTurns, {fmt::format("{:g}", *line.turns_rad), fmt::format("{:g}", line.senses.heading_rad), {}}, "compass_rad", line.compass_at};
  } else {
    warning_ = sensors_.out_of_range(heard_, [&](const std::string& sensor) { return was_said("range " + sensor); });
  }
}

/// A host that waits for something to come of it would wait in vain. Each is said once.
void Exchange::warn_of_what_nobody_hears(const Line& line) {
  if (warning_) return;
  if (!options_.has_master && !warned_of_master_) {
    warned_of_master_ = line.vehicle_at.end > 0 || line.actions_at.end > 0;
    const bool vehicle = line.vehicle_at.end > 0;
    if (warned_of_master_) warning_ = Mistake{Kind::kWireNoMaster, {vehicle ? "vehicle" : "actions", {}, {}}, {}, vehicle ? line.vehicle_at : line.actions_at};
  }
  for (const vda5050::HostActionState& report : line.actions) {
    if (!options_.has_master || warning_ || given_.contains(report.id)) continue;
    warning_ = Mistake{Kind::kWireOtherAction, {source::printable(report.id), {}, {}}, "actions", line.actions_at};
    remember_given(report.id);
  }
}

void Exchange::set_actions(std::vector<vda5050::HostAction> actions) {
  actions_ = std::move(actions);
  for (const vda5050::HostAction& action : actions_) remember_given(action.id);
}

void Exchange::remember_given(const std::string& id) {
  if (!given_.insert(id).second) return;
  given_in_turn_.push_back(id);
  if (given_in_turn_.size() <= kMostGiven) return;
  given_.erase(given_in_turn_.front());
  given_in_turn_.pop_front();
}

/// See note [a host that was away].
void Exchange::hear_buttons(bool away) {
  const auto is_in = [](const std::vector<program::CellId>& cells, program::CellId cell) { return std::find(cells.begin(), cells.end(), cell) != cells.end(); };
  const bool stopped = is_in(stops_, abort_) || std::any_of(said_.begin(), said_.end(), [&](const auto& said) { return said.first == abort_ && said.second.value_or(0.0f) > 0.0f; });   // the host may give the button as a fact
  const bool pressed = stopped || std::any_of(buttons_.begin(), buttons_.end(), [&](program::CellId button) { return !is_in(held_, button); });
  const bool waits = clock_.waits || away;
  clock_.wakes = clock_.wakes || (waits && pressed);
  clock_.waits = waits && !pressed;
  if (away) forget_said();
  for (const auto& [cell, value] : said_) {
    if (value) told_[cell] = *value;
    else told_.erase(cell);
  }
  pressed_.insert(pressed_.end(), buttons_.begin(), buttons_.end());
  pressed_.insert(pressed_.end(), stops_.begin(), stops_.end());
  stops_.clear();
  held_ = buttons_;
}

void Exchange::hear_sensors(std::int64_t t_us) {
  for (const OwnSensors::Heard& heard : heard_) {
    if (const auto* text = std::get_if<std::string>(&heard.value)) driver_.mind().read(heard.reading, text, t_us);
    else if (const auto* number = std::get_if<float>(&heard.value)) driver_.mind().measure(heard.reading, *number, t_us);
    else driver_.mind().silence(heard.reading);
  }
}

/// See note [when the mind ticks].
void Exchange::tick_before(std::int64_t t_us, Answer& answer) {
  const std::int64_t dt_us = options_.dt_us, at_us = (t_us - 1) / dt_us * dt_us;
  clock_.next_us = at_us + dt_us;
  if (rests()) return forget_said();
  const std::int64_t long_us = clock_.ticked_us ? at_us - *clock_.ticked_us : dt_us;
  clock_.ticked_us = at_us;
  for (const auto& [cell, value] : told_) driver_.mind().press(cell, 1, value);
  for (const program::CellId button : pressed_) driver_.mind().press(button, 1);
  forget_said();
  clock_.wakes = false;
  const program::Tick& tick = driver_.tick(at_us, static_cast<std::uint32_t>(long_us));
  answer.mind = program::print_json(*knowledge_->program, tick);
  auto& seen = answer.seen.emplace();
  for (std::uint32_t fact = 0; fact < knowledge_->program->facts; ++fact) {
    if (driver_.mind().seen(program::CellId{fact})) seen.emplace_back(knowledge_->program->cells[fact].name);
  }
  if (options_.on_tick) options_.on_tick(tick, answer.mind, driver_.mind().facts());
}

void Exchange::tell(Answer& answer) const {
  if (const sim::Strategy* strategy = stands() ? nullptr : driver_.strategy()) {
    answer.strategy = strategy->name;
    answer.controller = sim::controller_name(*strategy);
  }
  answer.mission = driver_.on_mission();
  if (const sim::Leg* leg = driver_.leg()) {
    answer.leg = leg->name;
    answer.goal = leg->to;
  }
  if (clock_.waits) answer.reports.emplace_back("Help.power");
  for (std::string& report : driver_.reports()) answer.reports.push_back(std::move(report));
  if (!knowledge_->outputs.empty()) answer.outputs = driver_.outputs();
  answer.plight = driver_.plight();
  answer.lost = driver_.lost();
  answer.waits = clock_.waits;
  answer.actions = actions_;
}

std::optional<Mistake> Exchange::look_up_fact(const Name& name, std::string_view field, program::CellId& cell) const {
  cell = names_.find(name.text);
  if (cell != program::CellId::kNone && program::index(cell) < knowledge_->program->facts) return std::nullopt;
  return no_such("fact", name, std::string(field), names_.closest(name.text, program::CellKind::kFact));
}

std::optional<Mistake> Exchange::look_up(const Line& line) {
  buttons_.clear();
  said_.clear();
  program::CellId cell{};
  for (const Name& button : line.buttons) {
    if (auto mistake = look_up_fact(button, "buttons", cell)) return mistake;
    buttons_.push_back(cell);
  }
  for (const Line::Said& said : line.facts) {
    if (auto mistake = look_up_fact(said.fact, "facts", cell)) return mistake;
    said_.emplace_back(cell, said.value);
  }
  if (auto mistake = sensors_.look_up(line.readings, heard_)) return mistake;
  if (line.tag) return look_up_tag(*line.tag);
  tag_ = {line.reader, nullptr, 0};
  return std::nullopt;
}

void Exchange::put(std::string_view landmark, std::string_view exit, double along_m) {
  driver_.put(landmark, exit, along_m);
}

std::optional<Mistake> Exchange::look_up_tag(const Tag& tag) {
  const sim::CrossingId crossing = labyrinth_.crossing(tag.landmark.text);
  if (crossing == sim::CrossingId::kNone) {   // the sign of somebody else
    tag_ = {true, nullptr, 0};
    return std::nullopt;
  }
  const std::shared_ptr<const sim::Memory>& memory = floor_.memory(crossing);
  const auto no_exit = [&](const Name& name, std::string field) {
    std::vector<std::string_view> names;
    for (const auto& exit : memory->exits) names.emplace_back(exit.name);
    return no_such("exit of `" + tag.landmark.text + "` called", name, std::move(field), diagnostics::closest(name.text, names));
  };
  const std::size_t count = memory->exits.size(), arm = exit_of(*memory, tag.exit.text);
  if (arm == count) return no_exit(tag.exit, "tag.exit");
  std::shared_ptr<const sim::Memory> says = memory;
  if (!tag.safe || !tag.closed.empty()) {
    auto changed = std::make_shared<sim::Memory>(*memory);
    changed->safe = tag.safe;
    for (const Name& closed : tag.closed) {
      const std::size_t exit = exit_of(*memory, closed.text);
      if (exit == count) return no_exit(closed, "tag.closed");
      changed->exits[exit].closed = true;
    }
    says = std::move(changed);
  }
  tag_ = {true, std::move(says), static_cast<std::uint32_t>(arm)};
  return std::nullopt;
}

}  // namespace kb::wire
