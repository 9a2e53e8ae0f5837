// Reads a master's messages. Makes the checks that do not depend on the vehicle: 6.6.1 and 6.6.4.1 of VDA 5050 2.1.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/kbc/vda5050/message.h"
#include "tools/kbc/vda5050/order.h"

namespace kb::vda5050 {

/// What a message says; or nothing, if its topic is none of the master's.
struct ReadMessage {
  /// An order, or its first fault: a `validationError`, or an `orderError` if it demands what none of our vehicles can do (a trajectory, a
  /// blocking action on an edge). Landmarks and ways are left empty.
  ///
  /// Versions other than 2.x, messages to other vehicles and those whose header is not complete are refused. A null counts as missing, as
  /// masters of version 2.0 write it.
  using ReadOrder = std::variant<Order, Complaint>;
  /// The same for instant actions; their list may be called `instantActions`, as before version 2.0.
  using ReadActions = std::variant<std::vector<Action>, Complaint>;
  std::variant<std::monostate, ReadOrder, ReadActions> said;
};
/// Reads a message of any topic: a large order takes as long as several control periods, so a link has its own thread do it. Never throws.
[[nodiscard]] ReadMessage read_message(const Message& message, const Identity& identity);

/// The position that `initPosition` gives a vehicle.
struct Position {
  Pose pose;
  std::string map_id, last_node;
};
/// Reads the parameters of such an action; or their first fault, in words.
[[nodiscard]] std::variant<Position, std::string> read_position(const std::string& parameters);

}  // namespace kb::vda5050
