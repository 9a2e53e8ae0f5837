// The messages between a vehicle and its master (VDA 5050), independent of what carries them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace kb::vda5050 {

struct ReadMessage;   // read_order.h

/// One message, JSON. `topic` is the last part of the name: `order`, `instantActions`; `state`, `connection`, `factsheet`, `visualization`.
struct Message {
  std::string topic;
  std::string payload;
  bool retained = false;
  std::shared_ptr<ReadMessage> read = {};   ///< of a message of the master: what it says, if a link has had it read already
};

/// The payload of a message that the link had to drop. It is no JSON, so no master sends it.
inline constexpr const char* kDropped = "(dropped: too many messages waited)";

/// The identity of a vehicle to its master.
struct Identity {
  std::string manufacturer, serial;
};

/// Makes what a broker sends if the vehicle disappears without leaving: from the number and the time of the message.
using Will = std::function<Message(std::uint32_t header_id, std::int64_t utc_us)>;

/// Prepares a message of the master for whoever takes it. A link may call it on a thread of its own.
using Prepare = std::function<void(Message&)>;

/// A carrier of messages: MQTT, or a script file.
class Link {
 public:
  virtual ~Link() = default;
  /// The next message of the master that arrived by `t_us` of the robot's clock; nothing if there is none. Does not wait.
  [[nodiscard]] virtual std::optional<Message> next(std::int64_t t_us) = 0;
  /// Sends the message, or keeps it until it can be sent. Does not wait.
  virtual void send(const Message& message, std::int64_t t_us) = 0;
  /// Microseconds since 1970, UTC, for the time stamps of messages.
  [[nodiscard]] virtual std::int64_t utc_us(std::int64_t t_us) = 0;
  /// Whether messages arrive while the robot is silent. Those of a file do not: they come by the robot's clock, which then stands still.
  [[nodiscard]] virtual bool live() const { return true; }
  /// Whether a connection was made since the last call.
  [[nodiscard]] virtual bool connected_anew() { return false; }
  /// News to report once: the broker cannot be reached, or is back. Empty: nothing new.
  [[nodiscard]] virtual std::string news() { return {}; }
};

}  // namespace kb::vda5050
