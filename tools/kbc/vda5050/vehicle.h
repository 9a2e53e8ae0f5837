// A vehicle as its master sees it (VDA 5050 2.1): it takes orders, reports its progress, and gives the robot its task. It knows neither the
// network nor the robot: messages and observations go in, messages and a task come out. The same input gives the same output.
//
// note [a way in stretches]
// A robot drives missions: from the landmark at which it stands to the one at which it must stand next, which is the end of the base, or a
// node with an action for which it has to stand (blockingType SOFT or HARD). Such a stretch is one task. The base may grow meanwhile: then
// the task's way gets longer, and the robot does not stop. `cancelOrder` cuts the way at the next node. Actions for which the robot stands
// are done at the node, before the next stretch begins.
//
// note [beyond a node]
// An order may end between two nodes: it is dropped, or the robot cannot go on. The next order begins at the node behind the robot. If it
// continues along the road on which the robot stands, with nothing to do at that node, the robot drives on. Otherwise it turns round and
// comes to the node again, which until then is one of the nodes left to drive.
//
// note [where an order is believed to begin]
// A vehicle that was switched on or set down by hand takes its order's word for where it is, and that it faces the first node. It may be
// wrong in both, and its sign alone cannot tell: it is read from either side. So until it enters a crossing, the sign of any other node
// ends the order: the robot would take that node's crossing for the first one's, and drive where nothing is released. If it knows that
// the first node is behind it, it expects the next sign. Where `initPosition` has put it on the road to the first node, the sign at the road's
// beginning is behind it as well, as long as the side from which it is read says nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/vda5050/condition.h"
#include "tools/kbc/vda5050/message.h"
#include "tools/kbc/vda5050/plant.h"

namespace kb::vda5050 {

/// The actions that every vehicle does by itself, in the order of the factsheet.
inline constexpr std::array<std::string_view, 6> kOwnActions = {"cancelOrder", "startPause", "stopPause", "stateRequest", "factsheetRequest", "initPosition"};

/// An action that the robot can do besides driving.
struct Skill {
  std::string type;                      ///< `pick`
  std::optional<double> takes_s = {};    ///< no one performs it, and it is over after this time; nothing: the host tells when it is over
};

/// How a task begins.
enum class Start : std::uint8_t {
  kBefore,   ///< before its first visit, facing it: that comes first
  kBeyond,   ///< on the road from its first visit to the second: it drives on
  kBack,     ///< on a road that leaves its first visit, facing away from it: it turns round and returns to that first
};

/// What the robot is to do.
struct Task {
  std::uint64_t number = 0;   ///< a new one for each stretch, kept while its way grows or is cut. 0: none yet
  std::vector<Visit> way;     ///< empty: nothing to drive; a mission under way is given up
  std::size_t passed = 0;     ///< how many visits came before `way` and are behind the robot
  Start start = Start::kBefore;
  bool paused = false;        ///< it is to stand and keep its task

  [[nodiscard]] std::size_t visits() const { return passed + way.size(); }
};

/// The progress of the task.
struct Progress {
  std::uint64_t task = 0;         ///< the number of the task
  std::size_t reached = 0;        ///< how many of its visits were reached (their signs were read), including those in `passed`
  bool on_mission = false;        ///< it is being driven. When it turns false, the task is done if all visits are reached, else it was given up
  double speed_m_s = 0.0, turn_rad_s = 0.0;
  double since_m = 0.0;           ///< by odometry, since the last visit or the start
  std::string here;               ///< the landmark whose sign it reads; empty: none
  std::vector<std::string> reports;   ///< `Help.lost`, as long as they hold
  std::string own_mission = {};    ///< a mission that the robot has begun on its own and that is being stopped; empty: none
  bool held = false;               ///< a switch on its back holds it
  bool waits = false;              ///< a rule of its own holds it until something is done
  bool stopped = false;            ///< it has stood at a stop line for a while, and reports nothing yet: the crossing is not safe, or its ways on are closed
  std::optional<Whereabouts> at = {};  ///< where it is, by its sign or the road behind it; without an exit in a crossing. Nothing: unknown
  bool in_crossing = false;        ///< past its stop line
  bool silent = false;             ///< the robot has fallen silent: all else is as last heard, and its base has stopped it
};

/// A time on two clocks. That of the messages may be set, forwards and backwards; how long something has lasted is told by the other, which only grows.
struct Moment { std::int64_t utc_us = 0, t_us = 0; };

/// The kind of robot, for the factsheet (6.15). Lengths in metres.
struct Sheet {
  double speed_max_m_s = 0.0;
  double acceleration_m_s2 = 0.0, deceleration_m_s2 = 0.0;
  double width_m = 0.0, length_m = 0.0;
  double visualization_s = 0.0;   ///< interval of the messages `visualization`, which give its position; 0: never
};

/// What the broker is to send if the vehicle disappears without leaving (`connection` CONNECTIONBROKEN).
[[nodiscard]] Message will_of(const Identity& identity, std::uint32_t header_id, std::int64_t utc_us);

class Vehicle {
 public:
  /// `plant` must outlive it.
  Vehicle(Identity identity, std::vector<Skill> skills, const Plant& plant, Sheet sheet = {});
  ~Vehicle();
  Vehicle(Vehicle&&) noexcept;
  Vehicle& operator=(Vehicle&&) = delete;

  /// Takes a message of the master; what was read of it already is taken out. If it is refused, the next state reports an error. Never throws because
  /// of its contents.
  void hear(const Message& message, std::int64_t utc_us);
  /// To be called every control period.
  void observe(const Progress& progress, const Condition& condition, const std::vector<HostActionState>& states, Moment now);

  [[nodiscard]] const Task& task() const;
  /// The position given by the master (`initPosition`) since the last call; nothing if there was none.
  [[nodiscard]] std::optional<Whereabouts> take_place();
  /// Whether in its mode it drives by itself and is not driven by hand.
  [[nodiscard]] bool obeys() const;
  /// Whether it has been driven by hand, or carried, for so long that the robot has to forget where it is.
  [[nodiscard]] bool in_hand() const;
  /// The actions to be done now, in the order of their beginning.
  [[nodiscard]] std::vector<HostAction> host_actions() const;
  /// The messages to send, oldest first; each is given once.
  [[nodiscard]] std::vector<Message> take_messages();
  /// The last message: the vehicle leaves (`connection` OFFLINE).
  [[nodiscard]] Message farewell(std::int64_t utc_us);
  /// A connection was made, and whoever listens there may know nothing of the vehicle: tells all that it has told.
  void tell_again(std::int64_t utc_us);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kb::vda5050
