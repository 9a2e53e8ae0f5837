// One drive, from the first tick to the last: physics, sensors, controllers, mind, and the events of the scenario.
//
// The mind ticks every `dt_us`. Between two ticks the body moves in steps of 10 ms; on every second step the driver (sim/mind/driver.h)
// reads the sensors and commands the wheels. Then the scenario's events happen, and then the mind ticks.
// The same labyrinth, knowledge base and scenario give the same drive, bit by bit, on the same machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/drive/helm.h"
#include "sim/drive/judge.h"
#include "sim/drive/mind_names.h"
#include "sim/mind/driver.h"
#include "sim/recording.h"
#include "sim/robot/sensors.h"
#include "sim/scenario/scenario.h"

namespace kb::sim {

struct DriveOptions {
  std::uint32_t dt_us = 100'000;                          ///< of the mind; a multiple of 10 ms
  Recording* recording = nullptr;                         ///< if not null, gets a frame each tick; its title stays if the scenario has none
  std::function<void(const program::Tick&)> on_tick;      ///< called with each tick
  Helm* helm = nullptr;                                   ///< if not null, drives in place of the knowledge base; recorded without cells
};

class Drive {
 public:
  /// Labyrinth, knowledge and scenario must outlive it.
  Drive(const Labyrinth& labyrinth, const Knowledge& knowledge, const Scenario& scenario, DriveOptions options);

  /// Advances one tick. False if the drive is over; then nothing was done.
  bool step();
  /// Drives to the end.
  const Summary& run();
  /// Performs an action now, as an event of a scenario would; `text` is the note of the next frame.
  void act(const Action& action, const std::string& text);
  [[nodiscard]] const Summary& summary() const { return judge_.summary; }
  [[nodiscard]] double time_s() const { return static_cast<double>(now_us_) / 1e6; }

 private:
  void move();
  void begin_step();
  void think();
  void judge();
  [[nodiscard]] Judge::Belief belief() const;
  void watch_mission(const Judge::Belief& belief);
  [[nodiscard]] bool on_mission() const;
  [[nodiscard]] bool claims_arrival() const;
  [[nodiscard]] Summary::Outcome mission_end() const;
  [[nodiscard]] bool is_there(const std::string& landmark) const;
  void follow_untold_mission();
  [[nodiscard]] std::vector<std::string> reports() const;
  void finish();
  // the scenario's events: events.cc
  void run_events();
  [[nodiscard]] bool happens(const Trigger& trigger) const;
  [[nodiscard]] bool comes_to(const Trigger& place) const;
  [[nodiscard]] bool goes(const Trigger& place) const;
  [[nodiscard]] bool has_room(const Action& action) const;
  [[nodiscard]] bool outlasted(const Action& action) const;
  void begin(const Event& event);
  void end(const Event& event);
  void perform(const Action& action, std::int64_t since_us = -1);
  void press(program::CellId fact, bool held);
  void release(program::CellId fact);
  void switch_power(bool on);
  /// The obstacle of that name that stands now; null if there is none.
  [[nodiscard]] const Obstacle* standing(const std::string& name) const;
  void moves_no_more(const std::string& name);
  void move_obstacles(double dt_s);
  // the recording: record.cc
  void begin_recording();
  void record(const program::Tick& tick, const Judge::Belief& belief);
  void record_things();

  const Labyrinth& labyrinth_;
  const Knowledge& knowledge_;
  const Scenario& scenario_;
  DriveOptions options_;
  Arena arena_;
  Floor floor_;
  DriveTrain wheels_;
  Sensors sensors_;
  Driver driver_;
  Judge judge_;
  mts::Senses senses_;
  TagHeard tag_;
  mts::Motion wanted_;

  std::int64_t now_us_ = 0;
  std::uint64_t steps_ = 0;
  bool ahead_ = false;                        // the first step of the next tick has begun
  bool powered_ = true, waits_ = false;       // power is off; it is on again, and the robot waits for a button
  struct Pending { double at_s = 0.0; const Event* event = nullptr; bool undo = false; };
  Whereabouts before_;                        // one tick before what the judge has seen last
  struct EventState { bool triggered = false, happened = false, no_room = false; std::int64_t at_us = 0; };
  [[nodiscard]] EventState& state_of(const Event& event) { return state_[static_cast<std::size_t>(&event - scenario_.events.data())]; }
  std::vector<EventState> state_;             // by event
  std::vector<Pending> pending_;              // triggered and not yet done, or done and not yet undone
  std::vector<const Event*> in_force_;        // those that hold a thing, in the order in which they happened
  struct Moving { std::string name; Spot to; double left_s = 0.0; };
  std::vector<Moving> moving_;

  bool mission_ = false, ended_ = false;      // a route is high; one was
  const Mission* untold_ = nullptr;           // for a helm that does not report it: see note [a mission that nobody tells]
  bool left_goal_ = false;
  const Leg* last_leg_ = nullptr;             // the one that is current, or was last
  bool abort_pressed_ = false, over_ = false;
  std::string last_landmark_;
  double began_s_ = 0.0, ended_s_ = 0.0, stands_s_ = 0.0, turned_at_s_ = 0.0, moved_at_s_ = 0.0, length_at_start_m_ = 0.0;
  CellChanges recorded_{MindNames{}};
  std::vector<std::size_t> standing_;         // the recording's stays of the last frame: a moving thing makes a new one each time
  std::vector<std::string> notes_;
};

}  // namespace kb::sim
