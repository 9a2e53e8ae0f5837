// The address of a broker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace kb::vda5050 {

struct Broker {
  std::string host;         ///< a name, or an address; IPv6 without its brackets
  std::uint16_t port = 0;
  bool tls = false;
  std::string user;         ///< empty: none
};

/// Whether `text` is a URL and not the name of a file.
[[nodiscard]] inline bool is_url(std::string_view text) { return text.find("://") != std::string_view::npos; }

/// `mqtt://HOST`, `mqtts://USER@HOST:PORT`; or what is wrong with it, in words.
[[nodiscard]] std::variant<Broker, std::string> read_broker(std::string_view url);

/// The URL for a message, without the password in it.
[[nodiscard]] std::string without_password(std::string_view url);

}  // namespace kb::vda5050
