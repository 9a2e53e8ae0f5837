// Connects a vehicle of a fleet with the mind that drives it: turns tasks into missions and reports their progress.
//
// note [order of a desk]
// After each answer to the robot the desk does three things: it gives the vehicle the mission's progress, takes the master's messages, and
// gives the mind the task as they have changed it. So no message finds a finished mission still under way.
//
// note [a mission of its own]
// A rule of the knowledge base, or a button, may begin another mission on its own. A vehicle may not leave its order (6.6.1), nor drive
// without one: that mission and the order's are given up at once, and the master is told which it was. A vehicle driven by hand may do so.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/filter.h>
#include <waymark/controllers/reckoning.h>

#include "tools/kbc/order_missions.h"
#include "tools/kbc/vda5050/message.h"
#include "tools/kbc/vda5050/vehicle.h"
#include "tools/kbc/wire/exchange.h"

namespace kb::cli {

class OrderDesk {
 public:
  /// All must outlive it. `idle`: what the exchange's mind runs on at the beginning.
  OrderDesk(const OrderMissions& missions, const sim::Knowledge& idle, wire::Exchange& exchange, vda5050::Vehicle& vehicle, vda5050::Link& link);

  /// To be called after a line was understood and answered.
  void step();
  /// To be called when nothing has come for `silent_us`, or nothing that could be understood.
  void wait(std::int64_t silent_us);
  /// The robot stands, and is driven no more: sends the last messages to the master.
  void leave();

 private:
  enum class Phase : std::uint8_t {
    kResting,   ///< no mission
    kStarting,  ///< its button is pressed until it is obeyed; for the vehicle, not begun yet
    kDriving,
    kOver,      ///< reached, or given up
    kRefused,   ///< its way cannot be driven (reported): told to the vehicle as begun, then as given up
  };

  void stand() { speed_m_s_ = 0.0, turn_rad_s_.value = 0.0f; }
  void send();
  void hear_line(const wire::Line& line);
  void hear_turn(const mts::Senses& senses, float dt_s);
  void follow_mission();
  void set_task();
  void give_up();
  [[nodiscard]] const sim::Knowledge& knowledge() const { return mission_ != nullptr ? mission_->knowledge : idle_; }
  [[nodiscard]] bool on_order() const { return exchange_.driver().mission() == route_; }
  /// See note [a mission of its own].
  [[nodiscard]] bool on_its_own() const { return vehicle_.obeys() && exchange_.driver().on_mission() && !on_order(); }
  [[nodiscard]] bool take_way(const vda5050::Task& task);
  void press_start();
  void deal(std::int64_t t_us);
  void give_actions();
  [[nodiscard]] vda5050::Progress progress() const;

  const OrderMissions& missions_;
  const sim::Knowledge& idle_;
  wire::Exchange& exchange_;
  vda5050::Vehicle& vehicle_;
  vda5050::Link& link_;
  const program::CellId start_, turn_, abort_;     // buttons; kNone: there is none
  const program::CellId pause_;                    // the switch that holds it from outside; kNone: there is none
  program::CellId route_;                          // the route of what the mind runs on
  std::unique_ptr<OrderMission> mission_;   // the one that the mind runs on; null: the idle one

  Phase phase_ = Phase::kResting;
  vda5050::Task task_;                      // as taken from the vehicle
  std::size_t reached_ = 0;
  std::int64_t pressed_us_ = 0;

  std::int64_t t_us_ = 0;                   // by the robot's clock
  std::int64_t dealt_us_ = 0;               // the last time given to the link; the robot's clock may lag behind the time waited
  bool silent_ = false;                     // nothing has come for long
  std::optional<std::int64_t> lost_us_;     // since when the controller has lost its way without a report of the mind
  std::optional<std::int64_t> stopped_us_;  // since when it stands at a stop line
  mts::Odometer odometer_;
  double since_m_ = 0.0, speed_m_s_ = 0.0;
  mts::LowPass turn_rad_s_{0.0f, true};
  std::optional<float> turned_rad_;
  std::string here_;
  vda5050::Condition condition_;
  std::vector<vda5050::HostActionState> action_states_;
};

}  // namespace kb::cli
