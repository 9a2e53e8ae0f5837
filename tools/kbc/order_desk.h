// Between a vehicle of a fleet and the mind that drives it: tasks become missions, and what comes of them is told.
//
// note [order of a desk]
// After each line that the robot was answered: how far the mission is goes to the vehicle, then come the messages of the master, then what
// they have made of the task goes to the mind. So no message finds a mission under way that is over.
//
// note [a mission of its own]
// A rule of the knowledge base, or a button, may begin another mission of its own. A vehicle may not leave its order (6.6.1), and may not drive
// without one: that mission is given up at once, and so is the order's, and the master is told which it was. Who is driven by hand may do so.
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
  /// All must outlive it. `idle`: what the exchange's mind runs on at first.
  OrderDesk(const OrderMissions& missions, const sim::Knowledge& idle, wire::Exchange& exchange, vda5050::Vehicle& vehicle, vda5050::Link& link);

  /// After a line was answered, whether or not it was understood.
  void step();
  /// Nothing has come from the robot for `silent_us`, by our own clock. Only for links that are live.
  void wait(std::int64_t silent_us);
  /// The last word to the master.
  void leave();

 private:
  enum class Phase : std::uint8_t {
    kResting,   ///< no mission
    kStarting,  ///< its button is pressed until it is obeyed: not begun yet, for the vehicle
    kDriving,
    kOver,      ///< reached, or given up
    kRefused,   ///< the way is none that can be driven (reported): told as begun, and then as given up
  };

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
  void give_deeds();
  [[nodiscard]] vda5050::Progress progress() const;

  const OrderMissions& missions_;
  const sim::Knowledge& idle_;
  wire::Exchange& exchange_;
  vda5050::Vehicle& vehicle_;
  vda5050::Link& link_;
  const program::CellId start_, turn_, abort_;     // buttons; kNone: there is none
  const program::CellId pause_;                    // what holds it from outside; kNone: there is no such switch
  program::CellId route_;                          // of what the mind runs on
  std::unique_ptr<OrderMission> mission_;   // that the mind runs on; null: the idle one

  Phase phase_ = Phase::kResting;
  vda5050::Task task_;                      // as it was taken
  std::size_t reached_ = 0;
  std::int64_t pressed_us_ = 0;

  std::int64_t t_us_ = 0;                   // of the robot's clock
  std::int64_t dealt_us_ = 0;               // the last time that the link was told; the robot's clock may come after what we waited
  bool silent_ = false;                     // nothing has come for long
  std::optional<std::int64_t> lost_us_;     // what drives has lost its way since then, and the mind reports nothing
  mts::Odometer odometer_;
  double since_m_ = 0.0, speed_m_s_ = 0.0;
  mts::LowPass turn_rad_s_{0.0f, true};
  std::optional<float> turned_rad_;
  std::string here_;
  vda5050::Condition condition_;
  std::vector<vda5050::DeedWord> words_;
};

}  // namespace kb::cli
