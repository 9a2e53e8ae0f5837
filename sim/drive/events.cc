// What the scenario does to a drive.
#include <algorithm>
#include <cmath>

#include "sim/drive/drive.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kPlaceReach = 0.08;    // m, times the floor's size: a robot this near is at the place of a trigger

/// The kinds of things that are as the last event has made them, while several events hold them. (For roads, crossings and markings the floor
/// itself counts the events.)
enum class Held : std::uint8_t { kNone, kButton, kTag, kSensor, kSteel, kPower, kObstacle };

Held held_by(const Action& action) {
  switch (action.kind) {
    case Action::Kind::kPress: return action.held ? Held::kButton : Held::kNone;
    case Action::Kind::kRelease: return Held::kButton;
    case Action::Kind::kTag: return Held::kTag;
    case Action::Kind::kSensor: return Held::kSensor;
    case Action::Kind::kSteel:
    case Action::Kind::kNoSteel: return Held::kSteel;
    case Action::Kind::kPowerOff:
    case Action::Kind::kPowerOn: return Held::kPower;
    case Action::Kind::kObstacle:
    case Action::Kind::kRemove: return Held::kObstacle;
    default: return Held::kNone;
  }
}

bool same_held(const Action& a, const Action& b) {
  if (held_by(a) != held_by(b)) return false;
  switch (held_by(a)) {
    case Held::kNone: return false;
    case Held::kButton: return a.cell == b.cell;
    case Held::kTag: return a.crossing == b.crossing && a.arm == b.arm;
    case Held::kSensor: return a.sensor == b.sensor && a.element == b.element;
    case Held::kPower: return true;
    case Held::kSteel:
    case Held::kObstacle: return a.obstacle.name == b.obstacle.name;
  }
  return false;
}

}  // namespace

bool Drive::happens(const Trigger& trigger) const {
  const Helm* helm = options_.helm;
  const auto any = [&](auto holds) { return std::any_of(trigger.cells.begin(), trigger.cells.end(), holds); };
  switch (trigger.kind) {
    case Trigger::Kind::kTime: return time_s() >= trigger.time_s - 1e-9;
    case Trigger::Kind::kCrossing: return judge_.where().crossing == trigger.crossing;
    case Trigger::Kind::kFact: return any([&](program::CellId cell) { return helm != nullptr ? helm->seen(cell) : driver_.mind().seen(cell); });
    case Trigger::Kind::kCell: return any([&](program::CellId cell) { return helm != nullptr ? helm->high(cell) : driver_.mind().high(cell); });
    case Trigger::Kind::kPlace: return comes_to(trigger) && goes(trigger);
  }
  return false;
}

/// Whether the robot is at the place or has passed it since the previous tick. At ten ticks a second a tick falls near every place that it
/// passes; at one tick a second it can pass a place between two ticks.
bool Drive::comes_to(const Trigger& place) const {
  const Whereabouts& now = judge_.where();
  const Road& road = labyrinth_[place.road];
  const double long_m = road.ends_m - road.begins_m, place_m = place.along_m;
  const auto on_road = [&](const Whereabouts& at) { return at.road == place.road; };
  if (on_road(now) && std::abs(now.along_m - place_m) < labyrinth_.size * kPlaceReach) return true;
  const auto known = [](const Whereabouts& at) { return at.road != RoadId::kNone || at.crossing != CrossingId::kNone; };
  if (!known(before_) || !known(now) || (!on_road(before_) && !on_road(now))) return false;
  // A robot that was or is off this road came onto it, or left it, by the nearer end.
  const auto along_m = [&](const Whereabouts& at, const Whereabouts& other) { return on_road(at) ? at.along_m : other.along_m < 0.5 * long_m ? 0.0 : long_m; };
  const double from_m = along_m(before_, now), to_m = along_m(now, before_);
  const bool drove = std::abs(to_m - from_m) <= scenario_.drive.speed_m_s * options_.dt_us / 1e6;   // across open floor, the nearest place of a road can jump
  return drove && (from_m - place_m) * (to_m - place_m) <= 0.0;
}

/// Whether the robot faces the way that the trigger asks for.
bool Drive::goes(const Trigger& place) const {
  if (place.going == Trigger::Going::kAnyWay) return true;
  const Road& road = labyrinth_[place.road];
  const double off_rad = arena_.pose().heading_rad - point_on(road.along, road.begins_m + place.along_m).heading_rad;
  return (std::cos(off_rad) > 0.0) == (place.going == Trigger::Going::kOut);
}

void Drive::run_events() {
  const bool first_tick = now_us_ <= options_.dt_us;   // the first tick makes no events of facts: a command pressed then would start nothing
  for (std::size_t i = 0; i < scenario_.events.size(); ++i) {
    const Event& event = scenario_.events[i];
    if (state_[i].triggered || !happens(event.when)) continue;
    state_[i].triggered = true;
    pending_.push_back({time_s() + event.when.delay_s, &event, false});
  }
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    const Pending due = pending_[i];
    if (due.event == nullptr || time_s() < due.at_s - 1e-9) continue;
    if (first_tick && due.event->action.kind == Action::Kind::kPress) continue;
    pending_[i].event = nullptr;
    if (due.undo) end(*due.event);
    else begin(*due.event);
  }
  std::erase_if(pending_, [](const Pending& p) { return p.event == nullptr; });
  before_ = judge_.where();
}

/// Whether the place of an action is free. An obstacle that appears where the robot is would make the physics throw the robot aside, as no
/// real thing does; so would an obstacle that stands where the robot is put down.
bool Drive::has_room(const Action& action) const {
  const auto off_m = [&](Spot thing, const Pose& robot, double radius_m) { return distance(thing, {robot.x_m, robot.y_m}) - radius_m - arena_.radius_m(); };
  if (action.kind == Action::Kind::kKidnap) {
    const auto& all = arena_.obstacles();
    return std::all_of(all.begin(), all.end(), [&](const Obstacle& one) { return off_m(one.at, action.pose, one.radius_m) >= 0.0; });
  }
  const bool appears = action.kind == Action::Kind::kObstacle || (action.kind == Action::Kind::kMove && action.amount <= 0.0);
  if (!appears) return true;
  const Obstacle* const moved = action.kind == Action::Kind::kMove ? standing(action.obstacle.name) : nullptr;
  return off_m(action.obstacle.at, arena_.pose(), (moved != nullptr ? *moved : action.obstacle).radius_m) >= 0.0;
}

void Drive::begin(const Event& event) {
  EventState& state = state_of(event);
  state.no_room = !has_room(event.action);
  if (state.no_room) return;
  state.happened = true;
  state.at_us = now_us_;
  act(event.action, event.text);
  if (held_by(event.action) != Held::kNone && !restores(event.action)) in_force_.push_back(&event);
  if (event.undo) pending_.push_back({time_s() + event.lasts_s, &event, true});
}

/// Ends an event that lasts. If a later event holds the same thing, nothing changes; otherwise the thing becomes as the latest of the earlier
/// events that still hold it had made it, or is restored.
void Drive::end(const Event& event) {
  if (held_by(event.action) == Held::kNone) return act(*event.undo, event.undo_text);
  const auto found = std::find(in_force_.begin(), in_force_.end(), &event);
  if (found == in_force_.end()) return;   // it was restored meanwhile
  const auto same = [&](const Event* other) { return same_held(other->action, event.action); };
  const bool changed = std::any_of(found + 1, in_force_.end(), same);
  in_force_.erase(found);
  const auto before = std::find_if(in_force_.rbegin(), in_force_.rend(), same);
  if (changed) return;
  if (before == in_force_.rend()) return act(*event.undo, event.undo_text);
  if (held_by(event.action) != Held::kObstacle) perform((*before)->action, state_of(**before).at_us);   // an obstacle stays where it is
}

void Drive::press(program::CellId fact, bool held) {
  waits_ = false;
  if (options_.helm != nullptr) options_.helm->press(fact, held);
  else driver_.mind().press(fact, held ? Mind::kHeld : kPressTicks);
  abort_pressed_ = abort_pressed_ || knowledge_.program->cells[program::index(fact)].name == "Abort";
  for (const Mission& mission : knowledge_.missions) {
    if (options_.helm == nullptr || (untold_ != nullptr && !options_.helm->mission()) || mission_ || mission.command != fact) continue;
    untold_ = &mission;
    left_goal_ = abort_pressed_ = false;
  }
}

void Drive::release(program::CellId fact) {
  if (options_.helm != nullptr) options_.helm->release(fact);
  else driver_.mind().release(fact);
}

/// The memories of the mind and of perception outlast an outage; the measurements of the sensors and the motion of the wheels do not.
/// When power returns, the robot waits until something is pressed before it drives on.
void Drive::switch_power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  waits_ = on;
  wanted_ = {};   // without power the wheels brake as hard as they can
  if (on) sensors_.clear();
}

void Drive::act(const Action& action, const std::string& text) {
  if (restores(action)) std::erase_if(in_force_, [&](const Event* event) { return same_held(event->action, action); });
  perform(action);
  if (!outlasted(action)) notes_.push_back(text);
}

/// `since_us`: since when the action has held, if it is not new.
void Drive::perform(const Action& action, std::int64_t since_us) {
  using Kind = Action::Kind;
  stands_s_ = 0.0;
  switch (action.kind) {
    case Kind::kPress: press(action.cell, action.held); break;
    case Kind::kRelease: release(action.cell); break;
    case Kind::kClose:
    case Kind::kOpen: floor_.set_closed(action.road, action.kind == Kind::kClose, action.cause); break;
    case Kind::kUnsafe:
    case Kind::kSafe: floor_.set_safe(action.crossing, action.kind == Kind::kSafe, action.cause); break;
    case Kind::kObstacle:
      if (standing(action.obstacle.name) != nullptr) moves_no_more(action.obstacle.name);   // but a move that was waiting for it to appear goes on
      arena_.place_obstacle(action.obstacle);
      break;
    case Kind::kMove:
      moves_no_more(action.obstacle.name);
      moving_.push_back({action.obstacle.name, action.obstacle.at, action.amount});
      break;
    case Kind::kRemove:
      arena_.remove_obstacle(action.obstacle.name);
      moves_no_more(action.obstacle.name);
      break;
    case Kind::kWear: floor_.wear_off({action.road, action.from_m, action.to_m, action.cause}); break;
    case Kind::kMend: floor_.mend(action.road, action.cause); break;
    case Kind::kTag: floor_.set_tag(action.crossing, action.arm, action.tag, action.instead); break;
    case Kind::kSensor: sensors_.set_fault(action.sensor, action.element, action.fault, action.amount, since_us); break;
    case Kind::kKidnap:
      arena_.put(action.pose);
      wheels_.halt();
      judge_.carried(action.pose);
      break;
    case Kind::kSteel: sensors_.place_steel(action.obstacle.name, action.obstacle.at, action.obstacle.radius_m, action.amount); break;
    case Kind::kNoSteel: sensors_.remove_steel(action.obstacle.name); break;
    case Kind::kPowerOff: switch_power(false); break;
    case Kind::kPowerOn: switch_power(true); break;
  }
}

/// Whether an action that undoes something has no effect, because another event has done the same thing and still holds.
bool Drive::outlasted(const Action& action) const {
  const std::vector<Floor::Worn>& worn = floor_.worn();
  switch (action.kind) {
    case Action::Kind::kOpen: return floor_.closed(action.road);
    case Action::Kind::kSafe: return !floor_.safe(action.crossing);
    case Action::Kind::kMend: return std::any_of(worn.begin(), worn.end(), [&](const Floor::Worn& one) { return one.road == action.road; });
    default: return false;
  }
}

const Obstacle* Drive::standing(const std::string& name) const {
  const auto found = std::find_if(arena_.obstacles().begin(), arena_.obstacles().end(), [&](const Obstacle& obstacle) { return obstacle.name == name; });
  return found == arena_.obstacles().end() ? nullptr : &*found;
}

void Drive::moves_no_more(const std::string& name) {
  std::erase_if(moving_, [&](const Moving& moving) { return moving.name == name; });
}

void Drive::move_obstacles(double dt_s) {
  for (Moving& moving : moving_) {
    const Obstacle* const found = standing(moving.name);
    if (found == nullptr) continue;
    Obstacle there = *found;
    const double share = moving.left_s > dt_s ? dt_s / moving.left_s : 1.0;
    there.at = there.at + share * (moving.to - there.at);
    moving.left_s -= dt_s;
    arena_.move_obstacle(there, dt_s);
  }
  std::erase_if(moving_, [](const Moving& moving) { return moving.left_s <= 0.0; });
}

}  // namespace kb::sim
