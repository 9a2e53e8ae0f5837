#include "tools/kbc/vda5050/link/broker_url.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "compiler/source/utf8.h"

namespace kb::vda5050 {
namespace {

constexpr std::uint16_t kPort = 1883, kPortTls = 8883;   // registered for MQTT at IANA

bool in_name(char c) { return source::is_letter_or_digit(c) || c == '.' || c == '-' || c == '_'; }
bool in_address(char c) { return (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F') || source::is_digit(c) || c == '.' || c == ':'; }

/// The parts of what stands between `://` and the first `/`.
struct Authority {
  std::string_view user, host, port;
  bool has_user = false, has_port = false, brackets = false;
};

Authority divide(std::string_view text) {
  Authority parts;
  if (const std::size_t at = text.rfind('@'); at != std::string_view::npos) {
    parts.user = text.substr(0, at);
    parts.has_user = true;
    text.remove_prefix(at + 1);
  }
  parts.brackets = text.starts_with('[') && text.find(']') != std::string_view::npos;
  const std::size_t begin = parts.brackets ? 1 : 0, end = text.find(parts.brackets ? ']' : ':');
  parts.host = text.substr(begin, end == std::string_view::npos ? end : end - begin);
  if (end == std::string_view::npos) return parts;
  const std::string_view rest = text.substr(end + begin);
  parts.has_port = !rest.empty();
  parts.port = rest.substr(rest.starts_with(':') ? 1 : 0);
  return parts;
}

std::string wrong_host(const Authority& parts) {
  if (parts.host.empty()) return "it has no host";
  const bool good = parts.brackets ? std::all_of(parts.host.begin(), parts.host.end(), in_address) : std::all_of(parts.host.begin(), parts.host.end(), in_name);
  return good ? std::string() : fmt::format("`{}` is no host", source::printable(parts.host));
}

}  // namespace

std::variant<Broker, std::string> read_broker(std::string_view url) {
  const std::size_t colon = url.find("://");
  const std::string_view scheme = url.substr(0, colon);
  if (colon == std::string_view::npos || (scheme != "mqtt" && scheme != "mqtts")) return fmt::format("`{}` is no way to one", source::printable(scheme));
  std::string_view rest = url.substr(colon + 3);
  if (rest.ends_with('/')) rest.remove_suffix(1);
  const Authority parts = divide(rest);
  if (parts.has_user && parts.user.find(':') != std::string_view::npos) return "a password does not stand in it; WAYMARK_MQTT_PASSWORD of the environment says it";
  if (parts.has_user && parts.user.empty()) return "no user stands before `@`";
  if (rest.find_first_of("/?#") != std::string_view::npos) return "something stands after the host";
  if (std::string wrong = wrong_host(parts); !wrong.empty()) return wrong;
  Broker broker{std::string(parts.host), scheme == "mqtts" ? kPortTls : kPort, scheme == "mqtts", std::string(parts.user)};
  if (parts.has_port && (!source::read_number(parts.port, broker.port) || broker.port == 0)) {
    return fmt::format("`{}` is no port from 1 to 65535", source::printable(parts.port));
  }
  return broker;
}

std::string without_password(std::string_view url) {
  const std::size_t begin = url.find("://"), at = url.rfind('@');
  const std::size_t colon = begin == std::string_view::npos ? begin : url.find(':', begin + 3);
  if (at == std::string_view::npos || colon == std::string_view::npos || colon > at) return std::string(url);
  return std::string(url.substr(0, colon + 1)) + "..." + std::string(url.substr(at));
}

}  // namespace kb::vda5050
