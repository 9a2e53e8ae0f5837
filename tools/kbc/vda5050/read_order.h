// Reads what a master sends. What it demands can be said without knowing the vehicle: 6.6.1 and 6.6.4.1 of VDA 5050 2.1.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/kbc/vda5050/message.h"
#include "tools/kbc/vda5050/order.h"

namespace kb::vda5050 {

/// The order in a message, or the first thing that is wrong with it: a `validationError`, or an `orderError` where it demands what no
/// vehicle of ours can do (a trajectory, a blocking action on an edge). Never throws. Landmarks and ways are left empty.
///
/// Other versions than 2.x and other vehicles' messages are refused. `headerId` and `timestamp` decide nothing, and may be missing. What is
/// null is not there, as masters of version 2.0 write it.
[[nodiscard]] std::variant<Order, Complaint> read_order(std::string_view payload, const Identity& identity);

/// The same of instant actions; their list may be called `instantActions`, as before version 2.0.
[[nodiscard]] std::variant<std::vector<Action>, Complaint> read_instant_actions(std::string_view payload, const Identity& identity);

/// Where `initPosition` says that a vehicle stands.
struct Position {
  Pose pose;
  std::string map_id, last_node;
};
/// Out of the parameters of such an action; or the first thing that is wrong with them, in words.
[[nodiscard]] std::variant<Position, std::string> read_position(const std::string& parameters);

}  // namespace kb::vda5050
