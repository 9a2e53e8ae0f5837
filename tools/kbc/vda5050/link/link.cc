#include "tools/kbc/vda5050/link/link.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>
#include <variant>

#include "compiler/source/utf8.h"
#include "tools/kbc/vda5050/link/broker_url.h"
#include "tools/kbc/vda5050/link/mqtt_link.h"
#include "tools/kbc/vda5050/link/script_link.h"

namespace kb::vda5050 {

using diagnostics::Kind;

namespace {

/// Why `name` cannot stand between two `/` of a topic; empty if it can. VDA 5050, section 6.3, and MQTT 3.1.1, section 4.7.
std::string wrong_in_topic(std::string_view name) {
  if (name.empty()) return "it is empty";
  if (source::find_ill_formed(name) != std::string_view::npos) return "it is no UTF-8";
  for (const char c : name) {
    if (std::string_view("/+#$").find(c) != std::string_view::npos) return fmt::format("`{}` stands in it", c);
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return "a control character stands in it";
  }
  return {};
}

bool check_names(const LinkOptions& options, diagnostics::Diagnostics& diagnostics) {
  bool good = true;
  for (const auto& [name, what] : {std::pair(&options.interface_name, "the interface"), std::pair(&options.identity.manufacturer, "the manufacturer"), std::pair(&options.identity.serial, "the serial number")}) {
    const std::string why = wrong_in_topic(*name);
    if (why.empty()) continue;
    diagnostics.report(Kind::kLinkName, {}, {source::printable(*name), what, why});
    good = false;
  }
  return good;
}

/// Checks that a file of certificates goes with a URL that uses TLS, and that it has certificates: libmosquitto would fail at each attempt.
bool check_certificates(const LinkOptions& options, const Broker& broker, const source::FileSystem& files, diagnostics::Diagnostics& diagnostics) {
  if (options.ca_file.empty()) return true;
  if (!broker.tls) {
    diagnostics.report(Kind::kLinkNoTls, {}, {options.orders});
    return false;
  }
  const auto read = files.read(options.ca_file);
  if (!read.bytes) {
    diagnostics.report(Kind::kCannotRead, {}, {options.ca_file, read.too_large ? "is too large" : read.error});
    return false;
  }
  if (read.bytes->find("-----BEGIN CERTIFICATE-----") != std::string::npos) return true;
  diagnostics.report(Kind::kLinkNoCertificate, {}, {options.ca_file});
  return false;
}

std::unique_ptr<Link> make_mqtt_link(const LinkOptions& options, const source::FileSystem& files, diagnostics::Diagnostics& diagnostics) {
  const std::string url = without_password(options.orders);
  auto read = read_broker(options.orders);
  if (const auto* why = std::get_if<std::string>(&read)) {
    diagnostics.report(Kind::kLinkUrl, {}, {url, *why});
    return nullptr;
  }
  Broker broker = std::get<Broker>(std::move(read));
  if (!check_certificates(options, broker, files, diagnostics)) return nullptr;
  if (!has_mqtt()) {
    diagnostics.report(Kind::kLinkNoMqtt, {});
    return nullptr;
  }
  if (broker.user.empty()) broker.user = options.user;
  const Identity& who = options.identity;
  std::string error;
  auto link = open_mqtt({std::move(broker), options.password, options.ca_file, fmt::format("{}/v2/{}/{}", options.interface_name, who.manufacturer, who.serial),
                         fmt::format("waymark-{}-{}", who.manufacturer, who.serial), options.will, options.prepare}, error);
  if (link == nullptr) diagnostics.report(Kind::kLinkUrl, {}, {url, error});
  return link;
}

}  // namespace

void take_credentials(LinkOptions& options) {
  if (const char* user = std::getenv("WAYMARK_MQTT_USER")) options.user = user;
  if (const char* password = std::getenv("WAYMARK_MQTT_PASSWORD")) options.password = password;
}

std::unique_ptr<Link> make_link(const LinkOptions& options, const source::FileSystem& files, source::Sources& sources, diagnostics::Diagnostics& diagnostics) {
  if (!check_names(options, diagnostics)) return nullptr;
  if (is_url(options.orders)) return make_mqtt_link(options, files, diagnostics);
  auto messages = read_script(options.orders, files, sources, diagnostics);
  return messages ? std::make_unique<ScriptLink>(std::move(*messages)) : nullptr;
}

}  // namespace kb::vda5050
