#include "tools/kbc/vda5050/vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "tools/kbc/vda5050/read_order.h"
#include "tools/kbc/vda5050/vehicle_state.h"

namespace kb::vda5050 {
namespace {

constexpr std::int64_t kAtLatestUs = 30'000'000;   // the longest time between two states (6.10)
constexpr std::size_t kMostComplaints = 20;

bool one_of(std::string_view word, std::span<const std::string_view> words) { return std::find(words.begin(), words.end(), word) != words.end(); }

}  // namespace

Vehicle::Vehicle(Identity identity, std::vector<Skill> skills, const Plant& plant, Sheet sheet)
    : state_(std::make_unique<State>(std::move(identity), std::move(skills), plant, std::move(sheet))) {}
Vehicle::~Vehicle() = default;
Vehicle::Vehicle(Vehicle&&) noexcept = default;

void Vehicle::hear(const Message& message, std::int64_t utc_us) {
  state_->greet(utc_us);
  ReadMessage read = message.read != nullptr ? std::move(*message.read) : read_message(message, state_->identity);
  if (auto* order = std::get_if<ReadMessage::ReadOrder>(&read.said)) state_->take_order(std::move(*order));
  else if (const auto* actions = std::get_if<ReadMessage::ReadActions>(&read.said)) state_->take_instant_actions(*actions, utc_us);
  else return;
  state_->settle();
  state_->finish(utc_us);
}

void Vehicle::observe(const Progress& progress, const Condition& condition, const std::vector<HostActionState>& states, Moment now) {
  State& state = *state_;
  state.greet(now.utc_us);
  state.look(condition);
  for (const HostActionState& report : states) state.actions.hear(report);
  const std::int64_t passed_us = std::max<std::int64_t>(now.t_us - state.seen_us.value_or(now.t_us), 0);
  state.actions.pass(passed_us);
  state.seen_us = now.t_us;
  state.by_hand_us = state.obeys() ? 0 : state.by_hand_us + passed_us;
  state.follow(progress, passed_us);
  if (state.in_hand()) state.forget_place();
  state.settle();
  state.stand();
  state.finish(now.utc_us);
}

const Task& Vehicle::task() const { return state_->stretch.task(); }
std::optional<Whereabouts> Vehicle::take_place() { return std::exchange(state_->placed, std::nullopt); }
bool Vehicle::obeys() const { return state_->obeys(); }
bool Vehicle::in_hand() const { return state_->in_hand(); }
std::vector<HostAction> Vehicle::host_actions() const { return state_->actions.host_actions(); }
std::vector<Message> Vehicle::take_messages() { return std::exchange(state_->outbox, {}); }
Message Vehicle::farewell(std::int64_t utc_us) { return connection_message(state_->identity, "OFFLINE", state_->connections++, utc_us); }
void Vehicle::tell_again(std::int64_t utc_us) { state_->tell_again(utc_us); }
Message will_of(const Identity& identity, std::uint32_t header_id, std::int64_t utc_us) { return connection_message(identity, "CONNECTIONBROKEN", header_id, utc_us); }

void Vehicle::State::greet(std::int64_t utc_us) {
  if (std::exchange(greeted, true)) return;
  send(connection_message(identity, "ONLINE", connections++, utc_us));
}

void Vehicle::State::tell_again(std::int64_t utc_us) {
  if (!greeted) return;
  send(connection_message(identity, "ONLINE", connections++, utc_us));   // first, because the broker may have sent CONNECTIONBROKEN in between
  if (factsheets > 0) send_factsheet(utc_us);
  changed = true;
}

void Vehicle::State::complain(Complaint complaint) {
  changed = true;
  std::erase(complaints, complaint);   // if it is repeated, only the newest stays
  complaints.push_back(std::move(complaint));
  if (complaints.size() > kMostComplaints) complaints.erase(complaints.begin());
}

void Vehicle::State::take_order(std::variant<Order, Complaint> read) {
  changed = true;   // each order is answered by a state (6.10)
  if (auto* complaint = std::get_if<Complaint>(&read)) return complain(std::move(*complaint));
  auto& order = std::get<Order>(read);
  if (!obeys()) return complain({"orderError", "the vehicle is in mode " + condition.mode, {{"topic", "order"}, {"orderId", order.id}, {"orderUpdateId", std::to_string(order.update)}}});
  OrderBook::Judgement judgement = book.judge(order, plant, active(), where(), beyond());
  using Verdict = OrderBook::Verdict;
  if (judgement.verdict == Verdict::kKnown) return;   // the master has sent it again, as it does if it gets no answer (6.6.4.3)
  if (judgement.verdict == Verdict::kRefused) return complain(std::move(judgement.complaint));
  const bool update = judgement.verdict == Verdict::kUpdate;
  if (auto objection = object_to(order, update)) return complain(std::move(*objection));
  complaints.clear();
  if (update) extend(std::move(order));
  else begin(std::move(order));
}

void Vehicle::State::extend(Order order) {
  complain_of_late(order);
  actions.forget_after(book.nodes()[book.base_end()].sequence);
  actions.plan(order.nodes, order.edges, false);
  book.extend(std::move(order));
}

/// The node at the end of the base must not be changed by an update (6.6.2); a master that adds an action there would wait for it in vain.
void Vehicle::State::complain_of_late(const Order& order) {
  for (const Action& action : order.nodes.front().actions) {
    if (actions.find(action.id) != nullptr) continue;
    complain({"orderUpdateError", fmt::format("action `{}` is passed over: node `{}` was released without it", action.id, order.nodes.front().id),
              {{"topic", "order"}, {"orderId", order.id}, {"orderUpdateId", std::to_string(order.update)}, {"actionId", action.id}, {"nodeId", order.nodes.front().id}}});
  }
}

void Vehicle::State::begin(Order order) {
  believed = set_down;
  const bool comes_to_first = beyond() != nullptr || where().empty();   // by turning round, or because nobody knows where it is
  actions.forget_order();
  actions.plan(order.nodes, order.edges, true);
  stretch.close();
  gave_up = on_mission = was_on_mission = false;
  passed_m = 0.0;
  book.begin(std::move(order));
  if (comes_to_first && !book.nodes().front().actions.empty()) book.go_back();   // see note [beyond a node]
  else actions.trigger(ActionState::Origin::kNode, book.last_sequence());
}

/// Why a valid order is not taken all the same. The vehicle may be unable to set off from where it stands, or unable to do an action (6.6.4.2), or
/// an action may have the id of another.
std::optional<Complaint> Vehicle::State::object_to(const Order& order, bool update) const {
  if (cancelling) return Complaint{"orderUpdateError", "the order is being cancelled", {{"orderId", order.id}}};
  if (in_crossing && !update) {
    return Complaint{"noRouteError", fmt::format("the vehicle stands in the crossing of `{}`, where no order can begin: put it on a road, and tell it so by mode MANUAL or initPosition", book.last_node()), {{"orderId", order.id}}};
  }
  std::optional<Complaint> complaint;
  std::set<std::string_view> taken;
  const std::uint32_t base_end = update ? book.nodes()[book.base_end()].sequence : 0;
  for (const ActionState& known : actions.all()) {   // collects the ids of those that stay when the order is taken
    const bool instant = known.origin == ActionState::Origin::kInstant;
    if (update ? instant || known.sequence <= base_end : instant && !known.over()) taken.insert(known.action.id);
  }
  std::size_t live = actions.live();
  const auto good = [&](const Action& action) {
    ++live;
    const auto refuse = [&](std::string type, std::string what) {
      complaint = Complaint{std::move(type), std::move(what), {{"topic", "order"}, {"orderId", order.id}, {"orderUpdateId", std::to_string(order.update)}, {"actionId", action.id}, {"actionType", action.type}}};
      return false;
    };
    if (actions.skill(action.type) == nullptr) return refuse("orderError", fmt::format("this vehicle cannot do `{}`", action.type));
    if (taken.count(action.id) > 0) return refuse("validationError", fmt::format("there is an action with actionId `{}` already", action.id));
    if (live > kMostActions) return refuse("orderError", fmt::format("more than {} actions would not be over", kMostActions));
    return true;
  };
  for (std::size_t i = 0; i < order.nodes.size(); ++i) {
    if (i > 0 && !std::all_of(order.edges[i - 1].actions.begin(), order.edges[i - 1].actions.end(), good)) break;
    if ((i > 0 || !update) && !std::all_of(order.nodes[i].actions.begin(), order.nodes[i].actions.end(), good)) break;
  }
  return complaint;
}

void Vehicle::State::look(const Condition& now) {
  const std::string before = condition.mode;
  const bool obeyed = obeys();
  condition = now;
  if (!one_of(now.mode, kModes)) condition.mode = "MANUAL";
  if (!one_of(now.e_stop, kStops)) condition.e_stop = "MANUAL";
  if (obeyed != obeys()) clear_order(fmt::format("the vehicle went from mode {} to {}", before, condition.mode));   // 6.10.6, table 1
}

void Vehicle::State::clear_order(const std::string& why) {
  changed = true;
  actions.fail_order(why);
  stretch.close();
  book.drop();
  gave_up = on_mission = was_on_mission = false;
  end_cancel("");
}

void Vehicle::State::finish(std::int64_t utc_us) {
  for (const ActionState& failed : actions.take_failures()) {
    complain({"actionFailed", fmt::format("`{}` failed{}{}", failed.action.type, failed.result.empty() ? "" : ": ", failed.result), {{"actionId", failed.action.id}, {"actionType", failed.action.type}}});
  }
  if (actions.take_changed()) changed = true;
  const auto past = [&](std::int64_t last_us, std::int64_t period_us) { return utc_us - last_us >= period_us || utc_us < last_us; };
  if (sheet.visualization_s > 0.0 && past(shown_us, static_cast<std::int64_t>(sheet.visualization_s * 1e6))) {
    shown_us = utc_us;
    send_visualization(utc_us);
  }
  const bool due = past(told_us, kAtLatestUs);
  Shown now = shown();
  if (!changed && !due && now == told) return;
  told = std::move(now);
  told_us = utc_us;
  changed = false;
  send_state(utc_us);
}

}  // namespace kb::vda5050
