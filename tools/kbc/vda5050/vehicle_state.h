// The implementation of a Vehicle.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tools/kbc/vda5050/action_book.h"
#include "tools/kbc/vda5050/order_book.h"
#include "tools/kbc/vda5050/stretch.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace kb::vda5050 {

/// `2026-11-25T01:44:56.000Z`.
[[nodiscard]] std::string timestamp(std::int64_t utc_us);
/// The message about the state of a vehicle's connection: `ONLINE`.
[[nodiscard]] Message connection_message(const Identity& identity, std::string_view word, std::uint32_t header_id, std::int64_t utc_us);

/// The parts of a state that are compared with the last one sent, since each change must be reported (6.10).
struct Shown {
  bool driving = false, charging = false, field_violation = false, base_request = false, paused = false, waits = false, stopped = false, silent = false;
  std::string e_stop, mode, last_node;
  std::vector<std::string> reports;
  friend bool operator==(const Shown&, const Shown&) = default;
};

struct Vehicle::State {
  static constexpr std::int64_t kHelplessUs = 3'000'000, kStandsInCrossingUs = 60'000'000, kByHandUs = 2'000'000;

  State(Identity who, std::vector<Skill> skills, const Plant& roads, Sheet about)
      : identity(std::move(who)), plant(roads), sheet(std::move(about)), actions(std::move(skills)) {}

  // vehicle.cc
  void greet(std::int64_t utc_us);
  void tell_again(std::int64_t utc_us);
  void take_order(std::variant<Order, Complaint> read);
  void complain(Complaint complaint);
  [[nodiscard]] std::optional<Complaint> object_to(const Order& order, bool update) const;
  void begin(Order order);
  void extend(Order order);
  void complain_of_late(const Order& order);
  void look(const Condition& now);
  void clear_order(const std::string& why);
  void finish(std::int64_t utc_us);   ///< the end of each hear and observe: reports what has changed

  // drive.cc
  void follow(const Progress& now, std::int64_t passed_us);
  void sense(const Progress& now, std::int64_t passed_us);
  void check_first_sign();
  void forget_place();
  void reach_next();
  void arrive();
  void drive();
  void settle();
  void stand();
  [[nodiscard]] bool active() const { return !book.nodes_left().empty() || actions.order_live() || cancelling; }
  [[nodiscard]] bool under_way() const { return stretch.given() && (book.goes_back() || book.at() < stretch.last()); }
  [[nodiscard]] bool stands() const { return !driving && !under_way() && !on_mission; }
  /// Whether it stands on its way and has reported why for a while, so that it may never come to the next node. In a crossing, where no order
  /// can begin, it must have stood longer, as the obstacle may go away.
  [[nodiscard]] bool helpless() const { return helpless_us >= kHelplessUs && (!in_crossing || stood_us >= kStandsInCrossingUs); }
  /// Whether it stands in a pause where the next order can begin, so that a cancelled order need not wait for `stopPause`.
  [[nodiscard]] bool rests_in_pause() const { return paused && !driving && !in_crossing; }
  [[nodiscard]] std::size_t next_stop(std::size_t from) const;
  /// Where it is beyond a node, see note [beyond a node]; null if it is not.
  [[nodiscard]] const Whereabouts* beyond() const;
  /// Whether it is on a road, and not at the end by which it came to the last node.
  [[nodiscard]] bool left_node() const { return at && !at->road.exit.empty() && !(came_by && came_by->road == at->road); }
  void begin_stretch();
  [[nodiscard]] std::string where() const;
  [[nodiscard]] bool obeys() const { return condition.mode == kModes[0] || condition.mode == kModes[1]; }
  /// Driven by hand, or carried, for so long that it may be anywhere.
  [[nodiscard]] bool in_hand() const { return by_hand_us >= kByHandUs; }
  [[nodiscard]] bool base_request() const { return book.has_horizon() && book.at() + 1 >= book.base_end(); }

  // instruct.cc
  void take_instant_actions(const std::variant<std::vector<Action>, Complaint>& read, std::int64_t utc_us);
  void instruct(const Action& action, std::int64_t utc_us);
  void cancel_order(const Action& action);
  void try_skill(const Action& action);
  void init_position(const Action& action);
  void end_cancel(const char* result);
  void finish_pause();
  void decline(const Action& action, std::string type, const std::string& why);

  // report.cc
  void send(Message message) { outbox.push_back(std::move(message)); }
  void send_state(std::int64_t utc_us);
  void send_visualization(std::int64_t utc_us);
  void add_motion(nlohmann::ordered_json& out);
  void send_factsheet(std::int64_t utc_us);
  [[nodiscard]] Shown shown() const;

  Identity identity;
  const Plant& plant;
  Sheet sheet;
  OrderBook book;
  ActionBook actions;
  Stretch stretch;
  std::vector<Complaint> complaints;        // until an order is taken (6.6.4)

  // What was seen last.
  Condition condition;
  std::vector<std::string> reports;
  std::int64_t stood_us = 0, helpless_us = 0;        // how long it has stood without a break, and of that with reports
  std::string here, own_mission;
  std::int64_t by_hand_us = 0;                       // how long it has been in a mode in which it does not obey
  bool set_down = true;                              // since it was switched on or in somebody's hands it has entered no crossing
  bool believed = false;                             // its order was taken so, see note [where an order is believed to begin]
  bool held = false, waits = false, stopped = false; // held by a switch on the robot; waits because of its own rules; at a stop line
  bool in_crossing = false, silent = false;
  double speed_m_s = 0.0, turn_rad_s = 0.0, since_m = 0.0;
  bool driving = false;
  bool on_mission = false, was_on_mission = false;   // on its present task, and at any time on it
  std::size_t reached = 0;                           // how many visits of the task's way
  double passed_m = 0.0;                             // from the last node to the last visit
  std::optional<Whereabouts> at;                     // its place; nothing if it is unknown
  std::optional<Whereabouts> came_by;                // while it is at the landmark reached last: where on the road by which it came
  std::optional<Whereabouts> on_road;                // its place on a road last, whose heading it keeps in a crossing; nothing: its place was unknown since
  std::optional<Whereabouts> placed;                 // the place given by the master, not yet passed on to the robot

  bool paused = false, cancelling = false, gave_up = false;
  std::vector<std::string> cancels, pauses;          // instant actions that are not over
  bool greeted = false, changed = true;
  Shown told;
  std::optional<std::int64_t> seen_us;               // when it was observed last, by the clock that only grows
  std::int64_t told_us = 0, shown_us = 0;
  std::uint32_t connections = 0, states = 0, factsheets = 0, visualizations = 0;   // header ids, by topic
  std::vector<Message> outbox;
};

}  // namespace kb::vda5050
