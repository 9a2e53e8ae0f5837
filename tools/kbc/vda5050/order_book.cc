#include "tools/kbc/vda5050/order_book.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace kb::vda5050 {
namespace {

using References = std::vector<std::pair<std::string, std::string>>;

OrderBook::Judgement refuse(const Order& order, std::string type, std::string description, References more = {}) {
  References references{{"topic", "order"}, {"orderId", order.id}, {"orderUpdateId", std::to_string(order.update)}};
  references.insert(references.end(), more.begin(), more.end());
  return {OrderBook::Verdict::kRefused, {std::move(type), std::move(description), std::move(references)}};
}

/// What an order says wrongly of where a node lies: then it is for another plant, or has mixed up its nodes. Empty: nothing.
std::string wrong_position(const Node& node, const Plant& plant) {
  if (!node.position) return {};
  const NodePosition& said = *node.position;
  if (!said.map.empty() && said.map != plant.map_id()) return fmt::format("node `{}` is on map `{}`; the positions of this vehicle are on map `{}`", node.id, said.map, plant.map_id());
  const std::optional<Pose> place = plant.place_of(node.id);
  if (!place) return {};
  const double off_m = std::hypot(said.x_m - place->x_m, said.y_m - place->y_m);
  if (off_m <= std::max(said.deviation_m, kNodeWithin_m)) return {};
  return fmt::format("node `{}` lies at ({:.2f}, {:.2f}), {:.2f} m from where the order says", node.id, place->x_m, place->y_m, off_m);
}

/// Finds the landmarks and ways of the whole order, including its horizon: what cannot be driven later is better refused now.
std::optional<OrderBook::Judgement> locate(Order& order, const Plant& plant) {
  for (Node& node : order.nodes) {
    std::optional<std::string> landmark = plant.landmark_of(node.id);
    if (!landmark) return refuse(order, "noRouteError", fmt::format("there is no node `{}`", node.id), {{"nodeId", node.id}});
    node.landmark = std::move(*landmark);
    if (std::string wrong = wrong_position(node, plant); !wrong.empty()) return refuse(order, "noRouteError", std::move(wrong), {{"nodeId", node.id}});
  }
  for (Edge& edge : order.edges) {
    std::optional<std::vector<Visit>> way = plant.way(edge.id, edge.from, edge.to);
    if (!way) return refuse(order, "noRouteError", fmt::format("there is no edge `{}` from `{}` to `{}`", edge.id, edge.from, edge.to), {{"edgeId", edge.id}});
    edge.way = std::move(*way);
    for (Visit& visit : edge.way) visit.limit_m_s = edge.limit_m_s;
  }
  return std::nullopt;
}

}  // namespace

bool leads_on(const Node& first, const Edge* then, const Whereabouts& on) {
  return first.actions.empty() && (then == nullptr || (on.outwards && !then->way.empty() && then->way.front().is_on(on.road)));
}

OrderBook::Judgement OrderBook::judge(Order& order, const Plant& plant, bool busy, std::string_view here, const Whereabouts* on) const {
  if (auto refused = locate(order, plant)) return *refused;
  return order.id == id_ ? judge_update(order, busy) : judge_new(order, plant, busy, here, on);
}

OrderBook::Judgement OrderBook::judge_new(const Order& order, const Plant& plant, bool busy, std::string_view here, const Whereabouts* on) const {
  if (busy) return refuse(order, "orderError", fmt::format("order `{}` is not over yet", id_), {{"activeOrderId", id_}});
  const Node& first = order.nodes.front();
  if (!here.empty() && first.landmark != here) {
    return refuse(order, "noRouteError", fmt::format("the order begins at node `{}`{}; the vehicle is at `{}`", first.id, first.id == first.landmark ? "" : fmt::format(", which is at `{}`", first.landmark), here), {{"nodeId", first.id}});
  }
  const bool goes_on = on == nullptr || !on->outwards || leads_on(first, order.edges.empty() ? nullptr : &order.edges.front(), *on);
  if (goes_on || plant.leads_back(on->road)) return {Verdict::kNew};
  return refuse(order, "noRouteError",
                fmt::format("the order begins at node `{}`, which is behind the vehicle; it is on the road that leaves by `{}.{}`, and cannot turn back there", first.id, on->road.landmark, on->road.exit),
                {{"nodeId", first.id}});
}

OrderBook::Judgement OrderBook::judge_update(const Order& order, bool busy) const {
  if (order.update < update_) return refuse(order, "orderUpdateError", fmt::format("update {} of this order was taken before", update_));
  if (order.update == update_) {
    if (order.nodes == accepted_.nodes && order.edges == accepted_.edges) return {Verdict::kKnown};
    return refuse(order, "orderUpdateError", fmt::format("update {} of this order was taken before, and said something else", update_));
  }
  if (dropped_) return refuse(order, "orderUpdateError", "this order was cancelled");
  const Node& first = order.nodes.front();
  const Node& stitch = busy ? nodes_[base_end_] : last_;   // tests (7) and (8) of figure 8
  if (first.id != stitch.id || first.sequence != stitch.sequence) {
    return refuse(order, "orderUpdateError", fmt::format("the update begins at node `{}` ({}), not at the end of the base, `{}` ({})", first.id, first.sequence, stitch.id, stitch.sequence),
                  {{"nodeId", first.id}});
  }
  if (base_end_ - at_ + order.nodes.size() > kMostNodes) return refuse(order, "orderUpdateError", fmt::format("more than {} nodes would be left to drive", kMostNodes));
  return {Verdict::kUpdate};
}

void OrderBook::begin(Order order) {
  accepted_ = order;
  id_ = std::move(order.id);
  update_ = order.update;
  nodes_ = std::move(order.nodes);
  edges_ = std::move(order.edges);
  dropped_ = back_ = false;
  last_ = {nodes_.front().id, nodes_.front().sequence, true, {}, nodes_.front().landmark};
  at_ = base_end_ = 0;
  find_base_end();
}

void OrderBook::extend(Order order) {
  accepted_ = order;
  update_ = order.update;
  nodes_.resize(base_end_ + 1);
  edges_.resize(base_end_);
  nodes_.insert(nodes_.end(), std::make_move_iterator(order.nodes.begin() + 1), std::make_move_iterator(order.nodes.end()));
  edges_.insert(edges_.end(), std::make_move_iterator(order.edges.begin()), std::make_move_iterator(order.edges.end()));
  find_base_end();
}

void OrderBook::find_base_end() {
  while (base_end_ < edges_.size() && edges_[base_end_].released) ++base_end_;
}

void OrderBook::reach_next() {
  ++at_;
  last_ = {nodes_[at_].id, nodes_[at_].sequence, true, {}, nodes_[at_].landmark};
}

void OrderBook::cut(std::size_t nodes) {
  if (nodes_.empty()) return;
  if (back_ && nodes > 0) --nodes;
  else back_ = false;
  base_end_ = std::min(base_end_, at_ + nodes);
  nodes_.resize(base_end_ + 1);
  edges_.resize(base_end_);
}

void OrderBook::drop() {
  if (nodes_.empty()) return;
  dropped_ = true;
  back_ = false;
  nodes_.clear();
  edges_.clear();
  at_ = base_end_ = 0;
}

void OrderBook::forget_passed() {
  nodes_.erase(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(at_));
  edges_.erase(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(at_));
  base_end_ -= at_;
  at_ = 0;
}

void OrderBook::go_back() {
  forget_passed();
  back_ = true;
}

void OrderBook::stand_at(std::string node, std::string landmark) { last_ = {std::move(node), 0, true, {}, std::move(landmark)}; }

}  // namespace kb::vda5050
