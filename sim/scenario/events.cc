// Reads the events of a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sim/scenario/names.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

using diagnostics::Kind;
using Do = Action::Kind;

constexpr double kLong = 86'400.0;   // s

/// Reads one event: `word` is the key that says what is done.
class EventReader {
 public:
  EventReader(TomlTable& table, const Names& names, double limit_s) : table_(table), names_(names), limit_s_(limit_s) {}

  std::optional<Event> read() {
    if (!read_trigger() || !read_action()) return std::nullopt;
    if (table_.has("for")) {
      const auto lasts = table_.number("for", {0.001, kLong});
      if (!lasts) return std::nullopt;
      if (!undo()) {
        table_.diagnostics().report(Kind::kSimUnknownKey, table_.span("for"), {"for", "this cannot be undone"});
        return std::nullopt;
      }
      event_.lasts_s = *lasts;
    }
    table_.done();
    event_.at = table_.has("when") ? table_.span("when") : table_.span();
    return std::move(event_);
  }

 private:
  bool read_trigger();
  void report_no_trigger(TomlTable& when);
  bool when_time(TomlTable& when);
  bool when_road(TomlTable& when);
  bool when_crossing(TomlTable& when);
  bool when_cell(std::optional<program::CellId> cell, Trigger::Kind kind);
  bool when_leg(TomlTable& when);
  void report_no_action();
  bool do_press();
  bool read_action();
  bool undo();
  bool do_road(Do what, std::string_view key, std::string_view word);
  bool do_crossing(Do what, std::string_view key, std::string_view word);
  bool do_obstacle(Do what, std::string_view key, std::string_view word);
  bool do_wear();
  bool do_tag();
  bool do_sensor();
  bool do_steel();
  bool do_power();
  bool do_kidnap();
  /// The place in the event's own table; to be read last, as keys that nobody has asked for may be reported.
  std::optional<Pose> read_place() {
    static_cast<void>(table_.has("for"));
    return names_.place(table_);
  }

  TomlTable& table_;
  const Names& names_;
  double limit_s_;
  Event event_;
};

bool EventReader::read_trigger() {
  if (!table_.has("when")) {
    table_.missing("when");
    return false;
  }
  auto when = table_.table("when", "a table, such as `{ time = 5 }` or `{ leg = \"A>B\" }`,");
  if (!when) return false;
  struct Known { std::string_view word; bool (*read)(EventReader&, TomlTable&); };
  static constexpr std::array kKnown{
      Known{"time", [](EventReader& r, TomlTable& t) { return r.when_time(t); }},
      Known{"road", [](EventReader& r, TomlTable& t) { return r.when_road(t); }},
      Known{"crossing", [](EventReader& r, TomlTable& t) { return r.when_crossing(t); }},
      Known{"fact", [](EventReader& r, TomlTable& t) { return r.when_cell(r.names_.fact(t, "fact"), Trigger::Kind::kFact); }},
      Known{"strategy", [](EventReader& r, TomlTable& t) { return r.when_cell(r.names_.strategy(t, "strategy"), Trigger::Kind::kCell); }},
      Known{"satellite", [](EventReader& r, TomlTable& t) { return r.when_cell(r.names_.satellite(t, "satellite"), Trigger::Kind::kCell); }},
      Known{"leg", [](EventReader& r, TomlTable& t) { return r.when_leg(t); }},
  };
  std::vector<const Known*> said;
  for (const Known& known : kKnown) {
    if (when->has(known.word)) said.push_back(&known);
  }
  const auto is_set = [&](const Known* known) { return when->is_set(known->word); };
  if (said.size() > 1 && std::any_of(said.begin(), said.end(), is_set)) {   // a setting replaces what the file waits for, and where
    std::erase_if(said, [&](const Known* known) { return !is_set(known); });
    for (const char* where : {"metres", "going"}) static_cast<void>(when->is_set(where) || when->has(where));
  }
  if (said.empty()) {
    report_no_trigger(*when);
    return false;
  }
  if (said.size() > 1) {
    table_.diagnostics().report(Kind::kSimTrigger, when->span(said[1]->word), {fmt::format("`{}` and `{}`", said[0]->word, said[1]->word)});
    return false;
  }
  event_.when.delay_s = when->number("delay", {0.0, kLong}).value_or(0.0);
  const bool good = said[0]->read(*this, *when);
  when->done();
  return good;
}

void EventReader::report_no_trigger(TomlTable& when) {
  for (const char* beside : {"delay", "metres", "going"}) static_cast<void>(when.has(beside));
  for (const char* other : {"landmark", "place"}) when.call(other, "crossing");
  const std::size_t before = table_.diagnostics().errors();
  when.done();   // a key that is there and means nothing may be the trigger
  if (table_.diagnostics().errors() == before) table_.diagnostics().report(Kind::kSimTrigger, when.span(), {"nothing"});
}

bool EventReader::when_time(TomlTable& when) {
  const auto time = when.number("time", {0.0, kLong});
  if (!time) return false;
  event_.when.time_s = *time;
  const double at_s = *time + event_.when.delay_s;
  const bool in_time = at_s <= limit_s_;
  if (!in_time) table_.diagnostics().report(Kind::kSimAfterEnd, when.span("time"), {fmt::format("{:g}", at_s), fmt::format("{:g}", limit_s_)});
  return in_time;
}

bool EventReader::when_road(TomlTable& when) {
  const auto end = names_.end(when, "road");
  event_.when.kind = Trigger::Kind::kPlace;
  if (!end) return false;
  const auto& road = names_.labyrinth[end->arm->road];
  const double long_m = road.ends_m - road.begins_m;
  const double metres = when.number("metres", along(road)).value_or(0.5 * long_m);
  event_.when.along_m = end->arm->forward ? metres : long_m - metres;
  event_.when.road = end->arm->road;
  if (!when.has("going")) return true;
  constexpr std::array<std::string_view, 2> kWays{"out", "back"};
  const std::string going = when.text("going").value_or("");
  const auto known = std::find(kWays.begin(), kWays.end(), going);
  const bool out = known == kWays.begin();
  if (known != kWays.end()) event_.when.going = out == end->arm->forward ? Trigger::Going::kOut : Trigger::Going::kBack;
  else if (!going.empty()) when.unknown_name("going", "way to go", going, kWays);
  return true;   // a wrong word is reported already
}

bool EventReader::when_crossing(TomlTable& when) {
  const auto crossing = names_.crossing(when, "crossing");
  event_.when.kind = Trigger::Kind::kCrossing;
  event_.when.crossing = crossing.value_or(CrossingId::kNone);
  return crossing.has_value();
}

bool EventReader::when_cell(std::optional<program::CellId> cell, Trigger::Kind kind) {
  event_.when.kind = kind;
  if (cell) event_.when.cells = {*cell};
  return cell.has_value();
}

bool EventReader::when_leg(TomlTable& when) {
  event_.when.kind = Trigger::Kind::kCell;
  event_.when.cells = names_.legs(when, "leg");
  return !event_.when.cells.empty();
}

bool EventReader::do_road(Do what, std::string_view key, std::string_view word) {
  const auto end = names_.end(table_, key);
  if (!end) return false;
  event_.action.kind = what;
  event_.action.road = end->arm->road;
  event_.text = fmt::format("road {}.{} {}", names_.labyrinth[end->crossing].name, end->arm->name, word);
  return true;
}

bool EventReader::do_crossing(Do what, std::string_view key, std::string_view word) {
  const auto crossing = names_.crossing(table_, key);
  if (!crossing) return false;
  event_.action.kind = what;
  event_.action.crossing = *crossing;
  event_.text = fmt::format("crossing {} {}", names_.labyrinth[*crossing].name, word);
  return true;
}

bool EventReader::do_obstacle(Do what, std::string_view key, std::string_view word) {
  const auto name = table_.text(key);
  if (!name) return false;
  event_.action.kind = what;
  event_.action.obstacle.name = *name;
  event_.text = fmt::format("{} {}", *name, word);
  if (what == Do::kRemove) return true;
  if (what == Do::kMove) event_.action.amount = table_.number("within", {0.0, kLong}).value_or(0.0);
  else event_.action.obstacle.radius_m = table_.number("radius", around({0.02, 1.0}, names_.labyrinth.size)).value_or(0.1);
  const auto place = read_place();
  if (!place) return false;
  event_.action.obstacle.at = {place->x_m, place->y_m};
  return true;
}

bool EventReader::do_wear() {
  if (!do_road(Do::kWear, "wear", "loses its marking")) return false;
  const Road& road = names_.labyrinth[event_.action.road];
  const auto end = names_.end(table_, "wear");
  const double long_m = road.ends_m - road.begins_m;
  double from = table_.number("from", along(road)).value_or(0.0);
  double to = table_.number("to", along(road, from)).value_or(long_m);
  if (!end->arm->forward) {
    std::swap(from, to);
    from = long_m - from;
    to = long_m - to;
  }
  event_.action.from_m = from;
  event_.action.to_m = to;
  return true;
}

bool EventReader::do_tag() {
  const auto end = names_.end(table_, "tag");
  if (!end) return false;
  const std::string reads = table_.text("reads").value_or("nothing");
  event_.action.kind = Do::kTag;
  event_.action.crossing = end->crossing;
  event_.action.arm = static_cast<std::uint32_t>(end->arm - names_.labyrinth[end->crossing].arms.data());
  event_.action.tag = reads == "nothing" ? Floor::TagState::kUnreadable : reads == "itself" ? Floor::TagState::kWell : Floor::TagState::kWrong;
  if (event_.action.tag == Floor::TagState::kWrong) {
    const auto instead = names_.crossing(table_, "reads");
    if (!instead) return false;
    if (names_.labyrinth[*instead].arms.empty()) {
      table_.unknown_name("reads", "landmark with roads", reads, {});
      return false;
    }
    event_.action.instead = *instead;
  }
  event_.text = fmt::format("tag {}.{} reads {}", names_.labyrinth[end->crossing].name, end->arm->name, reads);
  return true;
}

bool EventReader::do_sensor() { return read_sensor_fault(table_, event_); }

bool EventReader::do_steel() {
  const auto name = table_.text("steel");
  const double radius_m = table_.number("radius", {0.05, 10.0}).value_or(0.5);
  event_.action.amount = table_.number("degrees", {-180.0, 180.0}).value_or(20.0);
  const auto place = name ? read_place() : std::nullopt;
  if (!place) return false;
  event_.action.kind = Do::kSteel;
  event_.action.obstacle = {*name, {place->x_m, place->y_m}, radius_m};
  event_.text = fmt::format("steel {} bends the compass", *name);
  return true;
}

bool EventReader::do_power() {
  const auto power = table_.text("power");
  if (!power) return false;
  constexpr std::array<std::string_view, 2> kWords{"off", "on"};
  if (*power != "off" && *power != "on") {
    table_.unknown_name("power", "state of the power", *power, kWords);
    return false;
  }
  event_.action.kind = *power == "on" ? Do::kPowerOn : Do::kPowerOff;
  event_.text = "power " + *power;
  return true;
}

bool EventReader::do_kidnap() {
  auto to = table_.table("kidnap");
  const auto place = to ? names_.place(*to) : std::nullopt;
  if (to) to->done();
  event_.action.kind = Do::kKidnap;
  event_.action.pose = place.value_or(Pose{});
  event_.text = "robot carried away";
  return place && names_.check_room(*place, table_.span("kidnap"), table_.diagnostics());
}

bool EventReader::do_press() {
  const auto fact = names_.fact(table_, "press");
  event_.action.kind = Do::kPress;
  event_.action.cell = fact.value_or(program::CellId::kNone);
  event_.text = table_.text("press").value_or("") + " pressed";
  return fact.has_value();
}

void EventReader::report_no_action() {
  static_cast<void>(table_.has("for"));
  table_.missing_among("press` or another thing that happens, such as `close");
}

bool EventReader::read_action() {
  struct Known { std::string_view word; bool (*read)(EventReader&); };
  static constexpr std::array kKnown{
      Known{"press", [](EventReader& r) { return r.do_press(); }},
      Known{"close", [](EventReader& r) { return r.do_road(Do::kClose, "close", "closed"); }},
      Known{"open", [](EventReader& r) { return r.do_road(Do::kOpen, "open", "open again"); }},
      Known{"unsafe", [](EventReader& r) { return r.do_crossing(Do::kUnsafe, "unsafe", "not safe"); }},
      Known{"safe", [](EventReader& r) { return r.do_crossing(Do::kSafe, "safe", "safe again"); }},
      Known{"obstacle", [](EventReader& r) { return r.do_obstacle(Do::kObstacle, "obstacle", "appears"); }},
      Known{"move", [](EventReader& r) { return r.do_obstacle(Do::kMove, "move", "moves"); }},
      Known{"remove", [](EventReader& r) { return r.do_obstacle(Do::kRemove, "remove", "vanishes"); }},
      Known{"wear", [](EventReader& r) { return r.do_wear(); }},
      Known{"mend", [](EventReader& r) { return r.do_road(Do::kMend, "mend", "has its marking again"); }},
      Known{"tag", [](EventReader& r) { return r.do_tag(); }},
      Known{"sensor", [](EventReader& r) { return r.do_sensor(); }},
      Known{"steel", [](EventReader& r) { return r.do_steel(); }},
      Known{"power", [](EventReader& r) { return r.do_power(); }},
      Known{"kidnap", [](EventReader& r) { return r.do_kidnap(); }},
  };
  std::vector<const Known*> said;
  for (const Known& known : kKnown) {
    if (table_.has(known.word)) said.push_back(&known);
  }
  if (said.empty()) report_no_action();
  if (said.size() > 1) table_.diagnostics().report(Kind::kSimTwoActions, table_.span(said[1]->word), {said[0]->word, said[1]->word});
  return said.size() == 1 && said[0]->read(*this);
}

/// Writes the action that ends this one; false if there is none.
bool EventReader::undo() {
  if (restores(event_.action)) return false;
  Action back = event_.action;
  const std::string subject = event_.text.substr(0, event_.text.rfind(' '));
  switch (back.kind) {
    case Do::kPress:
      event_.action.held = true;
      back.kind = Do::kRelease;
      event_.undo_text = subject + " released";
      break;
    case Do::kClose: back.kind = Do::kOpen; event_.undo_text = subject + " open again"; break;
    case Do::kUnsafe: back.kind = Do::kSafe; event_.undo_text = event_.text.substr(0, event_.text.find(" not")) + " safe again"; break;
    case Do::kObstacle: back.kind = Do::kRemove; event_.undo_text = back.obstacle.name + " vanishes"; break;
    case Do::kWear: back.kind = Do::kMend; event_.undo_text = event_.text.substr(0, event_.text.find(" loses")) + " has its marking again"; break;
    case Do::kTag: back.tag = Floor::TagState::kWell; event_.undo_text = subject + " itself again"; break;
    case Do::kSensor: back.fault = Fault::kNone; event_.undo_text = subject + " well again"; break;
    case Do::kSteel: back.kind = Do::kNoSteel; event_.undo_text = "steel " + back.obstacle.name + " is gone"; break;
    case Do::kPowerOff: back.kind = Do::kPowerOn; event_.undo_text = "power on"; break;
    default: return false;
  }
  event_.undo = back;
  return true;
}

}  // namespace

bool restores(const Action& action) {
  switch (action.kind) {
    case Do::kTag: return action.tag == Floor::TagState::kWell;
    case Do::kSensor: return action.fault == Fault::kNone;
    case Do::kRelease:
    case Do::kNoSteel:
    case Do::kPowerOn:
    case Do::kRemove: return true;
    default: return false;
  }
}

std::vector<Event> read_events(TomlTable& file, const Names& names, double limit_s) {
  std::vector<Event> events;
  auto tables = file.tables("event");
  std::vector<std::string> obstacles;
  for (TomlTable& table : tables) {
    if (auto name = table.has("obstacle") ? table.text("obstacle") : std::nullopt) obstacles.push_back(*name);
  }
  for (TomlTable& table : tables) {
    auto event = EventReader(table, names, limit_s).read();
    if (!event) continue;
    const bool needs = event->action.kind == Do::kMove || event->action.kind == Do::kRemove;
    if (needs && std::find(obstacles.begin(), obstacles.end(), event->action.obstacle.name) == obstacles.end()) {
      table.diagnostics().report(Kind::kSimNoObstacle, table.span(event->action.kind == Do::kMove ? "move" : "remove"), {event->action.obstacle.name});
      continue;
    }
    if (event->undo) event->action.cause = event->undo->cause = static_cast<Floor::Cause>(events.size() + 1);
    events.push_back(std::move(*event));
  }
  return events;
}

}  // namespace kb::sim
