// The order that a vehicle drives: the part behind it, the base, the horizon (VDA 5050 2.1, 6.6.2).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/vda5050/order.h"
#include "tools/kbc/vda5050/plant.h"

namespace kb::vda5050 {

/// Whether an order that begins beyond its first node continues along that road, with nothing to do at the node. An order of one
/// node counts as continuing.
[[nodiscard]] bool leads_on(const Node& first, const Edge* then, const Whereabouts& on);

class OrderBook {
 public:
  enum class Verdict : std::uint8_t { kNew, kUpdate, kKnown, kRefused };
  struct Judgement {
    Verdict verdict = Verdict::kRefused;
    Complaint complaint = {};   ///< if it is refused
  };

  /// Figure 8 of the standard. `busy`: an order is being driven, or its actions are not over. `here`: the landmark where the vehicle
  /// stands; empty: unknown, so it is taken to be where the order says. `on`: the road on which it is, beyond that landmark. Fills in the
  /// landmarks and ways of `order`; changes nothing here.
  [[nodiscard]] Judgement judge(Order& order, const Plant& plant, bool busy, std::string_view here, const Whereabouts* on) const;
  /// Takes an order judged to be new. Its first node counts as reached.
  void begin(Order order);
  /// Takes an order judged to be an update: its base is appended to the present one, its horizon replaces the present one.
  void extend(Order order);

  /// The next node is reached.
  void reach_next();
  /// The last node reached lies ahead again, before all others: see note [beyond a node]. Forgets what is behind it.
  void go_back();
  /// That node is reached once more.
  void come_back() { back_ = false; }
  [[nodiscard]] bool goes_back() const { return back_; }
  /// Keeps only the base's next `nodes` nodes, including one to which the vehicle goes back.
  void cut(std::size_t nodes);
  /// Ends the order early: it can no longer be updated. Its id stays (6.6.3).
  void drop();
  /// Forgets what is behind the vehicle. at() becomes 0.
  void forget_passed();
  /// Sets that the vehicle stands at a node to which no order has led it.
  void stand_at(std::string node, std::string landmark);

  [[nodiscard]] const std::string& id() const { return id_; }
  [[nodiscard]] std::uint32_t update() const { return update_; }
  [[nodiscard]] const std::string& last_node() const { return last_.id; }
  [[nodiscard]] std::uint32_t last_sequence() const { return last_.sequence; }
  [[nodiscard]] const std::string& last_landmark() const { return last_.landmark; }

  // By index: node i, edge i after it, node i + 1.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] std::size_t at() const { return at_; }                ///< the last node reached
  [[nodiscard]] std::size_t base_end() const { return base_end_; }    ///< the decision point
  /// The nodes left to drive, of base and horizon.
  [[nodiscard]] std::span<const Node> nodes_left() const { return nodes_.empty() ? std::span<const Node>{} : std::span(nodes_).subspan(back_ ? at_ : at_ + 1); }
  [[nodiscard]] std::span<const Edge> edges_left() const { return nodes_.empty() ? std::span<const Edge>{} : std::span(edges_).subspan(at_); }
  [[nodiscard]] bool base_left() const { return back_ || at_ < base_end_; }
  [[nodiscard]] bool has_horizon() const { return !nodes_.empty() && base_end_ + 1 < nodes_.size(); }
  /// Fields of the last message that were ignored.
  [[nodiscard]] const std::vector<std::string>& unused() const { return accepted_.unused; }

 private:
  [[nodiscard]] Judgement judge_new(const Order& order, const Plant& plant, bool busy, std::string_view here, const Whereabouts* on) const;
  [[nodiscard]] Judgement judge_update(const Order& order, bool busy) const;
  void find_base_end();

  std::string id_;
  std::uint32_t update_ = 0;
  bool dropped_ = false, back_ = false;
  Node last_;                       // without its actions
  std::vector<Node> nodes_;         // empty: no order was taken, or it was dropped
  std::vector<Edge> edges_;
  std::size_t at_ = 0, base_end_ = 0;
  Order accepted_;                  // the last message
};

}  // namespace kb::vda5050
