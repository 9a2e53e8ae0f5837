// `--orders`: the source of a master's messages.
#pragma once

#include <memory>
#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "tools/kbc/vda5050/message.h"

namespace kb::vda5050 {

/// As given on the command line.
struct LinkOptions {
  std::string orders;                  ///< a broker, `mqtt://[USER@]HOST[:PORT]` or `mqtts://...`, or a file: see note [a script of messages]
  Identity identity{"Waymark", "1"};
  std::string interface_name = "uagv"; ///< the first part of all topics
  std::string ca_file;                 ///< with `mqtts://`: the trusted certificate authorities, PEM; empty: those of the system
  std::string user, password;          ///< for the broker; empty: none. A user in the URL overrides this one
  Will will;                           ///< what the broker sends if the vehicle disappears without leaving
  Prepare prepare;                     ///< what is done with each message of the master before it can be taken; empty: nothing
};

/// Takes WAYMARK_MQTT_USER and WAYMARK_MQTT_PASSWORD from the environment.
void take_credentials(LinkOptions& options);

/// The link; one to a broker begins to connect at once. Null if something in the options is wrong (reported).
[[nodiscard]] std::unique_ptr<Link> make_link(const LinkOptions& options, const source::FileSystem& files, source::Sources& sources, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::vda5050
