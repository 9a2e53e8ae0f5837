// A vehicle as its master sees it (VDA 5050 2.1): it takes orders, says how far it is, and says what the robot is to do. It knows neither the
// network nor the robot; messages and observations come in, messages and a task come out, and the same come out for the same.
//
// note [a way in stretches]
// A robot drives missions: from the landmark at which it stands to the one at which it is to stand next, which is the end of the base, or a node
// with an action for which it has to stand (blockingType SOFT or HARD). Such a stretch is one task. While it is on its way the base may grow: the task's way gets longer, and
// the robot does not stop. `cancelOrder` cuts it at the next node. Actions for which it stands are done at the node, before the next stretch begins.
//
// note [beyond a node]
// An order may end between two nodes: it is dropped, or the robot cannot go on. The next one begins at the node that is behind the robot. If
// it goes on by the road on which the robot stands, and has nothing to do at that node, it is driven on; else the robot turns round and
// comes to the node once more, which until then is one of those that are left to drive.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/kbc/vda5050/condition.h"
#include "tools/kbc/vda5050/message.h"
#include "tools/kbc/vda5050/plant.h"

namespace kb::vda5050 {

/// An action that the robot can do besides driving.
struct Skill {
  std::string type;                      ///< `pick`
  std::optional<double> takes_s = {};    ///< nobody does it: it is over after so long; nothing: the host says when it is over
};

/// How a task begins.
enum class Start : std::uint8_t {
  kBefore,   ///< before its first visit, facing it: it comes to that first
  kBeyond,   ///< on the road from its first visit to the second: it goes on there
  kBack,     ///< on a road that leaves its first visit, facing away from it: it turns round, and comes back to that first
};

/// What the robot is to do.
struct Task {
  std::uint64_t number = 0;   ///< another one for each stretch; the same while its way grows or is cut. 0: none yet
  std::vector<Visit> way;     ///< Empty: nothing to drive, and what is driven is given up
  std::size_t passed = 0;     ///< so many visits came before `way`, and are behind the robot
  Start start = Start::kBefore;
  bool paused = false;        ///< it is to stand, and to keep its task

  [[nodiscard]] std::size_t visits() const { return passed + way.size(); }
};

/// An action that the host is to do now.
struct Deed {
  std::string id, type;
  std::string parameters;     ///< JSON, an object: `{"height":1.2}`
};

/// What the host says of one: `running`, `paused`, `finished`, `failed`.
struct DeedWord {
  std::string id, status;
  std::string result = {};    ///< for the master; may be empty
};

/// What has become of the task.
struct Progress {
  std::uint64_t task = 0;         ///< which one this is about
  std::size_t reached = 0;        ///< so many of its visits have been reached, those that it passed among them: their signs were read
  bool on_mission = false;        ///< it is being driven. False and all reached: done. False and not all, having been true: it was given up
  double speed_m_s = 0.0, turn_rad_s = 0.0;
  double since_m = 0.0;           ///< by odometry, since the last visit was reached, or the start
  std::string here;               ///< the landmark whose sign it reads; empty: none
  std::vector<std::string> reports;   ///< `Help.lost`, as long as they hold
  std::string own_mission = {};    ///< the robot has begun this one, which is no task, and is being stopped; empty: none
  bool held = false;               ///< a switch on its back holds it
  bool waits = false;              ///< a rule of its own holds it until something is done
  std::optional<Whereabouts> at = {};  ///< where it is; in a crossing without an exit. Nothing: nobody knows
  bool in_crossing = false;        ///< past its stop line
  bool silent = false;             ///< nothing is heard from the robot any more: all else is as it was then, and its base has stopped it
};

/// What the factsheet tells of the kind of robot (6.15). Lengths in metres.
struct Sheet {
  std::string series = "Waymark";
  std::string kinematic = "DIFF";              ///< or OMNI, THREEWHEEL
  std::string agv_class = "CARRIER";           ///< or FORKLIFT, CONVEYOR, TUGGER
  std::string localization = "RFID";           ///< or NATURAL, REFLECTOR, DMC, SPOT, GRID
  std::string navigation = "PHYSICAL_LINE_GUIDED";   ///< or VIRTUAL_LINE_GUIDED, AUTONOMOUS
  double max_load_kg = 0.0;
  double speed_min_m_s = 0.0, speed_max_m_s = 0.0;
  double acceleration_m_s2 = 0.0, deceleration_m_s2 = 0.0;
  double height_m = 0.0, width_m = 0.0, length_m = 0.0;
  double visualization_s = 0.0;                ///< so often a message `visualization` says where it is; 0: never
};

class Vehicle {
 public:
  /// `plant` must outlive it.
  Vehicle(Identity identity, std::vector<Skill> skills, const Plant& plant, Sheet sheet = {});
  ~Vehicle();
  Vehicle(Vehicle&&) noexcept;
  Vehicle& operator=(Vehicle&&) = delete;

  /// A message of the master. What cannot be taken is told to it as an error of the next state; never throws for what stands in it.
  void hear(const Message& message, std::int64_t utc_us);
  /// Every control period.
  void observe(const Progress& progress, const Condition& condition, const std::vector<DeedWord>& words, std::int64_t utc_us);

  [[nodiscard]] const Task& task() const;
  /// Where the master says that the robot stands (`initPosition`), since this was asked last; nothing: it has not said so.
  [[nodiscard]] std::optional<Whereabouts> take_place();
  /// Whether the mode is one in which it drives by itself, and not somebody by hand.
  [[nodiscard]] bool obeys() const;
  /// The actions that are to be done now, in the order of their beginning.
  [[nodiscard]] std::vector<Deed> deeds() const;
  /// What is to be sent, oldest first; each is given once.
  [[nodiscard]] std::vector<Message> take_messages();
  /// As the last word: the vehicle leaves (`connection` OFFLINE).
  [[nodiscard]] Message farewell(std::int64_t utc_us);
  /// What the broker is to say when the vehicle is gone without a word (`connection` CONNECTIONBROKEN).
  [[nodiscard]] Message will(std::int64_t utc_us) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kb::vda5050
