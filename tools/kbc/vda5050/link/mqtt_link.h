// Messages over an MQTT 3.1.1 broker, as in VDA 5050 2.1 (section 6.3 on topics, 6.14 on `connection`).
//
// note [a broker that goes away]
// The network has a thread of its own, so that a robot never waits for it. A lost connection is tried again, at first after half a second,
// in the end after eight. A vehicle's message is its whole state, so messages that were missed need not be sent later: over a new connection
// it tells anew what it is like (`connected_anew`). Only what it said last is kept, for a link that ends before it has connected.
#pragma once

#include <memory>
#include <string>

#include "tools/kbc/vda5050/link/broker_url.h"
#include "tools/kbc/vda5050/message.h"

namespace kb::vda5050 {

struct MqttOptions {
  Broker broker;
  std::string password;    ///< empty: none
  std::string ca_file;     ///< trusted certificate authorities, PEM; empty: those of the system. Nothing: no TLS
  std::string topics;      ///< the prefix of each topic, `uagv/v2/Acme/7`
  std::string client;      ///< its name to the broker, unique among clients
  Will will;               ///< what the broker sends if the vehicle disappears without leaving; called by the thread, for each connection
  Prepare prepare;         ///< called by the thread with each message of the master; may be empty
};

/// Whether this program can speak MQTT.
[[nodiscard]] bool has_mqtt();

/// A link that begins to connect at once and keeps trying. Null if that is impossible; `error` says why. Subscribes `order` and
/// `instantActions` (QoS 0); sends `connection` with QoS 1, retained, and all else with QoS 0. At most 64 messages of the master wait to
/// be taken. The first one of a topic that finds no room is replaced by kDropped, the others are dropped. Of one of more than kMostBytes only
/// the beginning comes, one byte too long. Messages that the broker has retained from before are dropped. All this is reported by `news`. The destructor waits for sending to finish, at most a second, and disconnects from the broker.
[[nodiscard]] std::unique_ptr<Link> open_mqtt(MqttOptions options, std::string& error);

}  // namespace kb::vda5050
