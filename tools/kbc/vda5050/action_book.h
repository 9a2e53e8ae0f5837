// The actions of an order and the master's instant actions, with the state of each (VDA 5050 2.1, 6.11 and 6.12).
//
// note [in which order actions are done]
// Reaching a node triggers its actions in order, after those of earlier nodes. A NONE action begins at once, a SOFT one when the vehicle
// stands, a HARD one when it stands and no other action runs. Actions after one that cannot begin yet wait for it. The vehicle does not
// drive on while a SOFT or HARD action is not over. Actions of an edge (only NONE) begin when the vehicle enters it, beside the others,
// and end with the edge.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/kbc/vda5050/order.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace kb::vda5050 {

enum class Status : std::uint8_t { kWaiting, kRunning, kPaused, kFinished, kFailed };

/// `WAITING`.
[[nodiscard]] std::string_view status_name(Status status);

struct ActionState {
  enum class Origin : std::uint8_t { kNode, kEdge, kInstant };
  Action action;
  Origin origin = Origin::kNode;
  std::uint32_t sequence = 0;             ///< that of its node or edge
  Status status = Status::kWaiting;
  std::string result = {};                ///< for the master
  bool triggered = false;                 ///< its node is reached, its edge is entered
  std::optional<std::int64_t> left_us = {};   ///< an action that no one performs is over after this time
  std::uint64_t begun = 0;                ///< its number in the order of beginning; 0: not begun
  bool own = false;                       ///< the vehicle does it itself: `cancelOrder`
  bool cancelled = false;                 ///< its order is being cancelled, and the host is asked to give it up

  [[nodiscard]] bool over() const { return status == Status::kFinished || status == Status::kFailed; }
  [[nodiscard]] bool doing() const { return status == Status::kRunning || status == Status::kPaused; }
};

/// Costs: each call at most O(all actions).
class ActionBook {
 public:
  explicit ActionBook(std::vector<Skill> skills) : skills_(std::move(skills)) {}
  [[nodiscard]] const Skill* skill(std::string_view type) const;
  [[nodiscard]] const std::vector<Skill>& skills() const { return skills_; }
  [[nodiscard]] const std::vector<ActionState>& all() const { return all_; }   ///< as they came
  [[nodiscard]] const ActionState* find(std::string_view id) const;

  /// Adds, as waiting, all actions of the edges and of the nodes except the first; with `first`, that of the first node too.
  void plan(const std::vector<Node>& nodes, const std::vector<Edge>& edges, bool first);
  /// Forgets actions that wait at nodes and edges after this sequence id.
  void forget_after(std::uint32_t sequence);
  /// Called for a new order: forgets all actions except instant ones that are running (6.10.6, actionStates).
  void forget_order();
  /// Adds an instant action that runs, or that the vehicle does itself, with its state.
  void begin_instant(const Action& action);
  void put_own(const Action& action, Status status, std::string result = {});
  void end_own(std::string_view id, Status status, std::string result = {});

  void trigger(ActionState::Origin origin, std::uint32_t sequence);
  /// The vehicle leaves an edge: actions that run there are over (6.10.2).
  void leave_edge(std::uint32_t sequence);
  /// The order is cancelled: its actions fail, except for those that the host does, which it is asked to give up.
  void cancel();
  /// The same, but running actions of the order fail too.
  void fail_order(const std::string& why);
  /// Pauses actions that no one performs, or lets them go on. The host is asked to do so with the others, and reports it.
  void pause(bool on);

  /// Lets time pass for actions that no one performs.
  void pass(std::int64_t us);
  /// Begins the actions that can begin. See note [in which order actions are done].
  void begin(bool stands);
  /// Takes what the host reports. Reports about actions that are not running are ignored.
  void hear(const HostActionState& report);

  [[nodiscard]] bool order_live() const;         ///< whether an action of the order is not over
  [[nodiscard]] bool must_stand() const;         ///< whether a triggered action demands it
  [[nodiscard]] bool hard_running() const;
  [[nodiscard]] bool any_running() const;        ///< not counting those that the vehicle does itself
  [[nodiscard]] std::size_t instants_live() const;
  [[nodiscard]] std::size_t live() const;
  [[nodiscard]] std::vector<HostAction> host_actions() const;
  /// Whether something has changed since the last call. Forgets actions that were over long ago, so that an endless order does not fill
  /// the memory.
  [[nodiscard]] bool take_changed();
  /// Actions that have failed since the last call, except those that the master cancelled.
  [[nodiscard]] std::vector<ActionState> take_failures();

 private:
  void start(ActionState& state);
  void end(ActionState& state, Status status, std::string result);
  void tidy();

  std::vector<Skill> skills_;
  std::vector<ActionState> all_;
  std::vector<ActionState> failures_;
  std::uint64_t begun_ = 0;
  bool changed_ = false, paused_ = false;
};

}  // namespace kb::vda5050
