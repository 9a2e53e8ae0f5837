// What passes between a vehicle and its master, as VDA 5050 has it, whatever carries it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace kb::vda5050 {

/// One message, JSON. `topic` is the last part of the name: `order`, `instantActions`; `state`, `connection`, `factsheet`, `visualization`.
struct Message {
  std::string topic;
  std::string payload;
  bool retained = false;
};

/// Who a vehicle is, to its master.
struct Identity {
  std::string manufacturer, serial;
};

/// What carries messages: MQTT, or a file that somebody has written down before.
class Link {
 public:
  virtual ~Link() = default;
  /// The next message of the master that has come until `t_us`, the robot's clock; nothing: none. Does not wait.
  [[nodiscard]] virtual std::optional<Message> next(std::int64_t t_us) = 0;
  /// Sends, or keeps it until it can be sent. Does not wait.
  virtual void send(const Message& message, std::int64_t t_us) = 0;
  /// Microseconds since 1970, UTC, for the time stamps of messages.
  [[nodiscard]] virtual std::int64_t utc_us(std::int64_t t_us) = 0;
  /// Whether messages come while the robot says nothing. A file has its own by the robot's clock, which stands still then.
  [[nodiscard]] virtual bool live() const { return true; }
  /// Something to tell once: it cannot be reached, it is there again. Empty: nothing new.
  [[nodiscard]] virtual std::string news() { return {}; }
};

}  // namespace kb::vda5050
