// Messages over a broker of MQTT 3.1.1, as VDA 5050 2.1 has them (section 6.3 on topics, 6.14 on `connection`).
//
// note [a broker that goes away]
// The network has a thread of its own, so that a robot never waits for it. When the connection ends it is tried again, after half a second at first and
// after eight at last. What a vehicle says is its state as a whole, so what was said while nobody heard need not be said later: of each topic the last
// message is kept, and said again with a new connection, because nobody knows whether the one before still carried it: `connection` first, as the
// broker has said CONNECTIONBROKEN in between. `visualization` is not kept.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/kbc/vda5050/link/broker_url.h"
#include "tools/kbc/vda5050/message.h"

namespace kb::vda5050 {

struct MqttOptions {
  Broker broker;
  std::string password;    ///< empty: none
  std::string ca_file;     ///< who may vouch for the broker, PEM; empty: whom the system trusts. Without TLS nothing
  std::string topics;      ///< what stands before each, `uagv/v2/Acme/7`
  std::string client;      ///< its name to the broker, which no other client has
  Message will;            ///< what the broker says when the vehicle is gone without a word
};

/// Whether this program can speak MQTT.
[[nodiscard]] bool has_mqtt();

/// A link that begins to connect at once, and goes on to try. Null if it cannot be: `error` says why. Subscribes `order` and `instantActions` (QoS 0);
/// sends `connection` with QoS 1, retained, and all else with QoS 0. At most 64 messages of the master wait to be taken, each of kMostBytes at most;
/// others are dropped, which is news, as is what the broker has kept from before. The destructor waits for what is under way, a second at most, and takes its leave of the broker.
[[nodiscard]] std::unique_ptr<Link> open_mqtt(MqttOptions options, std::string& error);

}  // namespace kb::vda5050
