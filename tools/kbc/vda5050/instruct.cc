// Carries out instant actions (VDA 5050 2.1, 6.8 and 6.9).
#include <fmt/format.h>

#include <utility>
#include <variant>

#include "tools/kbc/vda5050/read_order.h"
#include "tools/kbc/vda5050/vehicle_state.h"

namespace kb::vda5050 {

void Vehicle::State::take_instant_actions(const std::variant<std::vector<Action>, Complaint>& read, std::int64_t utc_us) {
  changed = true;
  if (const auto* complaint = std::get_if<Complaint>(&read)) return complain(*complaint);
  for (const Action& action : std::get<std::vector<Action>>(read)) {
    const std::vector<std::pair<std::string, std::string>> about{{"topic", "instantActions"}, {"actionId", action.id}, {"actionType", action.type}};
    if (const ActionState* known = actions.find(action.id); known != nullptr) {
      if (known->action == action) continue;   // the master has sent it twice
      complain({"validationError", fmt::format("there is an action with actionId `{}` already", action.id), about});
    } else if (actions.instants_live() >= kMostInstants) {
      complain({"instantActionError", fmt::format("{} instant actions are not over yet", kMostInstants), about});
    } else {
      instruct(action, utc_us);
    }
  }
}

void Vehicle::State::instruct(const Action& action, std::int64_t utc_us) {
  if (action.type == "cancelOrder") return cancel_order(action);
  if (action.type == "stateRequest") return actions.put_own(action, Status::kFinished);   // the state that reports this is the one that was asked for
  if (action.type == "factsheetRequest") {
    send_factsheet(utc_us);
    return actions.put_own(action, Status::kFinished);
  }
  if (action.type == "startPause") {
    paused = true;
    stretch.pause(true);
    actions.pause(true);
    actions.put_own(action, Status::kRunning);   // until it stands
    return pauses.push_back(action.id);
  }
  if (action.type == "stopPause") {
    for (const std::string& id : std::exchange(pauses, {})) actions.end_own(id, Status::kFailed, "the pause was over before the vehicle stood");
    paused = false;
    was_on_mission = on_mission;   // if its mission was not under way, it has not given up
    stretch.pause(false);
    actions.pause(false);
    return held ? actions.put_own(action, Status::kFailed, "a switch on the robot holds it still") : actions.put_own(action, Status::kFinished);
  }
  if (action.type == "initPosition" && actions.skill(action.type) == nullptr) return init_position(action);
  try_skill(action);
}

/// 6.8.1: takes the position that the master gives a robot that was switched on or moved by hand.
void Vehicle::State::init_position(const Action& action) {
  const std::string error = "instantActionError";
  const auto read = read_position(action.parameters);
  if (const auto* fault = std::get_if<std::string>(&read)) return decline(action, error, *fault);
  const auto& [pose, map_id, last_node] = std::get<Position>(read);
  if (active() || !stands()) return decline(action, error, "the vehicle has an order, or drives");
  if (!obeys()) return decline(action, error, fmt::format("the vehicle is in mode {}, and may be moved yet", condition.mode));
  if (map_id != plant.map_id()) return decline(action, error, fmt::format("positions are on map `{}`", plant.map_id()));
  std::optional<Standing> standing = plant.standing_at(pose);
  if (!standing) return decline(action, error, "the vehicle would stand on no road, or across it, or against its direction");
  std::optional<std::string> landmark = plant.landmark_of(last_node);
  const std::string& behind = standing->on.road.landmark;
  if (!landmark || (*landmark != behind && *landmark != standing->ahead)) {
    return decline(action, error, fmt::format("the road there leads from `{}` to `{}`, and lastNodeId is `{}`", behind, standing->ahead, last_node));
  }
  came_by.reset();
  if (*landmark != behind) came_by = standing->on;   // it stands at the end of the road, at the node ahead, and begins there
  placed = at = on_road = std::move(standing->on);
  here.clear();
  in_crossing = false;
  book.stand_at(last_node, std::move(*landmark));
  actions.put_own(action, Status::kFinished);
}

/// 6.6.3: the robot drives on to the next node of the base and no farther. That is the first node if it has yet to reach it, or to return
/// to it.
void Vehicle::State::cancel_order(const Action& action) {
  if (!active()) return decline(action, "noOrderToCancel", "there is no order that could be cancelled");
  actions.put_own(action, Status::kRunning);
  cancels.push_back(action.id);
  if (std::exchange(cancelling, true)) return;
  const bool left = under_way() && (was_on_mission || driving || reached > 1);
  const bool beyond_first = reached > 0 || stretch.task().start == Start::kBeyond;
  actions.cancel();
  book.cut(left && (beyond_first || book.goes_back()) ? 1 : 0);
  if (left) stretch.cut(book.at() + (beyond_first ? 1 : 0));
  else if (under_way()) stretch.close();
}

void Vehicle::State::end_cancel(const char* result) {
  for (const std::string& id : std::exchange(cancels, {})) actions.end_own(id, Status::kFinished, result);
  cancelling = false;
}

void Vehicle::State::finish_pause() {
  if (driving) return;
  for (const std::string& id : std::exchange(pauses, {})) actions.end_own(id, Status::kFinished);
}

/// Does one of the robot's own actions at once, or declines it: while the robot drives or does something else, it may not be possible.
void Vehicle::State::try_skill(const Action& action) {
  const std::string error = "instantActionError";
  if (actions.skill(action.type) == nullptr) return decline(action, error, fmt::format("this vehicle cannot do `{}`", action.type));
  if (!obeys()) return decline(action, error, fmt::format("the vehicle is in mode {}", condition.mode));
  if (paused) return decline(action, error, "the vehicle pauses");
  if (actions.hard_running()) return decline(action, error, "an action of blockingType HARD is being done");
  if (action.blocking != Blocking::kNone && !stands()) return decline(action, error, "the vehicle is on its way; only actions of blockingType NONE can be done meanwhile");
  if (action.blocking == Blocking::kHard && actions.any_running()) return decline(action, error, "other actions are being done");
  actions.begin_instant(action);
}

void Vehicle::State::decline(const Action& action, std::string type, const std::string& why) {
  actions.put_own(action, Status::kFailed, why);
  complain({std::move(type), why, {{"topic", "instantActions"}, {"actionId", action.id}, {"actionType", action.type}}});
}

}  // namespace kb::vda5050
