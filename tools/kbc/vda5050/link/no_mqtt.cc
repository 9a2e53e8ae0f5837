// Replaces mqtt_link.cc if libmosquitto was not found.
#include "tools/kbc/vda5050/link/mqtt_link.h"

namespace kb::vda5050 {

bool has_mqtt() { return false; }

std::unique_ptr<Link> open_mqtt(MqttOptions /*options*/, std::string& error) {
  error = "this program was built without MQTT";
  return nullptr;
}

}  // namespace kb::vda5050
