// The actions of an order and of the master's own will, and how far each is (VDA 5050 2.1, 6.11 and 6.12).
//
// note [in which order actions are done]
// A node that is reached triggers its actions, in their order, after those of nodes before. NONE begins at once, SOFT when the vehicle stands, HARD when it
// stands and nothing else is being done; what comes after one that cannot begin yet waits for it. The vehicle does not drive on while a SOFT
// or HARD one is not over. Actions of an edge (only NONE) begin when it drives there, beside the others, and end with the edge.
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

struct Doing {
  enum class Origin : std::uint8_t { kNode, kEdge, kInstant };
  Action action;
  Origin origin = Origin::kNode;
  std::uint32_t sequence = 0;             ///< of its node or edge
  Status status = Status::kWaiting;
  std::string result = {};                ///< for the master
  bool triggered = false;                 ///< its node is reached, its edge is entered
  std::optional<std::int64_t> left_us = {};   ///< nobody does it: it is over after so long
  std::uint64_t begun = 0;                ///< they began in this order; 0: it has not
  bool own = false;                       ///< the vehicle does it itself: `cancelOrder`
  bool host_paused = false;               ///< the host says that it rests

  [[nodiscard]] bool over() const { return status == Status::kFinished || status == Status::kFailed; }
  [[nodiscard]] bool doing() const { return status == Status::kRunning || status == Status::kPaused; }
};

/// Costs: each call at most O(all actions).
class ActionBook {
 public:
  explicit ActionBook(std::vector<Skill> skills) : skills_(std::move(skills)) {}
  [[nodiscard]] const Skill* skill(std::string_view type) const;
  [[nodiscard]] const std::vector<Skill>& skills() const { return skills_; }
  [[nodiscard]] const std::vector<Doing>& all() const { return all_; }   ///< as they came
  [[nodiscard]] const Doing* find(std::string_view id) const;

  /// All actions of the edges and of the nodes but the first; with `first` also its. They wait.
  void plan(const std::vector<Node>& nodes, const std::vector<Edge>& edges, bool first);
  /// Forgets what waits at nodes and edges after this sequence id.
  void forget_after(std::uint32_t sequence);
  /// A new order comes: forgets all but instant actions that are being done (6.10.6, actionStates).
  void forget_order();
  /// Adds an instant action that runs, or that the vehicle does itself, with its state.
  void begin_instant(const Action& action);
  void put_own(const Action& action, Status status, std::string result = {});
  void end_own(std::string_view id, Status status, std::string result = {});

  void trigger(Doing::Origin origin, std::uint32_t sequence);
  /// The edge is left: what runs there is over (6.10.2).
  void leave_edge(std::uint32_t sequence);
  /// The order is cancelled: what waits fails, and so does what waits for somebody. What is being done is done to its end.
  void cancel();
  /// The same, and what is being done of the order fails too.
  void fail_order(const std::string& why);
  void pause(bool on);

  /// Time passes for what nobody does.
  void pass(std::int64_t us);
  /// Begins what can begin. See note [in which order actions are done].
  void begin(bool stands);
  /// What the host says. What is not being done is passed over.
  void hear(const DeedWord& word);

  [[nodiscard]] bool order_live() const;         ///< an action of the order is not over
  [[nodiscard]] bool must_stand() const;         ///< one that was triggered demands it
  [[nodiscard]] bool hard_running() const;
  [[nodiscard]] bool any_running() const;        ///< but what the vehicle does itself
  [[nodiscard]] std::size_t instants_live() const;
  [[nodiscard]] std::size_t live() const;
  [[nodiscard]] std::vector<Deed> deeds() const;
  /// Whether something has changed since the last call. Forgets what has been over for long, so that an order without end does not fill the memory.
  [[nodiscard]] bool take_changed();
  /// Actions that have failed since the last call, and not because the master wanted it.
  [[nodiscard]] std::vector<Doing> take_failures();

 private:
  void start(Doing& doing);
  void end(Doing& doing, Status status, std::string result);
  void tidy();

  std::vector<Skill> skills_;
  std::vector<Doing> all_;
  std::vector<Doing> failures_;
  std::uint64_t begun_ = 0;
  bool changed_ = false, paused_ = false;
};

}  // namespace kb::vda5050
