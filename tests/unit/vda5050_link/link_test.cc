// What `--orders` may say, and what is said where it may not.
#include "tools/kbc/vda5050/link/link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "compiler/diagnostics/consumers.h"
#include "tools/kbc/vda5050/link/broker_url.h"
#include "tools/kbc/vda5050/link/mqtt_link.h"

namespace kb::vda5050 {
namespace {

/// `host port user`, `tls` behind it; or what is wrong.
std::string broker_of(std::string_view url) {
  const auto read = read_broker(url);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const auto& broker = std::get<Broker>(read);
  return broker.host + " " + std::to_string(broker.port) + " " + broker.user + (broker.tls ? " tls" : "");
}

TEST(BrokerUrl, NamesHostPortAndUser) {
  EXPECT_EQ(broker_of("mqtt://broker"), "broker 1883 ");
  EXPECT_EQ(broker_of("mqtt://broker/"), "broker 1883 ");
  EXPECT_EQ(broker_of("mqtts://plant-1.example.org"), "plant-1.example.org 8883  tls");
  EXPECT_EQ(broker_of("mqtt://agv@10.0.0.7:65535"), "10.0.0.7 65535 agv");
  EXPECT_EQ(broker_of("mqtt://agv@plant@broker:1"), "broker 1 agv@plant") << "the last `@` divides";
  EXPECT_EQ(broker_of("mqtts://agv@[fe80::1]:8884"), "fe80::1 8884 agv tls");
  EXPECT_EQ(broker_of("mqtt://[::1]"), "::1 1883 ");
}

TEST(BrokerUrl, IsRefusedWithAReason) {
  EXPECT_EQ(broker_of("http://broker"), "`http` is no way to one");
  EXPECT_EQ(broker_of("MQTT://broker"), "`MQTT` is no way to one");
  EXPECT_EQ(broker_of("broker"), "`broker` is no way to one");
  EXPECT_EQ(broker_of("mqtt://"), "it has no host");
  EXPECT_EQ(broker_of("mqtt://:1883"), "it has no host");
  EXPECT_EQ(broker_of("mqtt://[]:1883"), "it has no host");
  EXPECT_EQ(broker_of("mqtt://@broker"), "no user stands before `@`");
  EXPECT_EQ(broker_of("mqtt://a b"), "`a b` is no host");
  EXPECT_EQ(broker_of("mqtt://[broker]"), "`broker` is no host");
  EXPECT_EQ(broker_of("mqtt://[::1"), "`[` is no host");
  EXPECT_EQ(broker_of("mqtt://::1"), "it has no host");
  EXPECT_EQ(broker_of("mqtt://[::1]x"), "`x` is no port from 1 to 65535");
  for (const char* const port : {"0", "65536", "-1", "18x", "+1"}) EXPECT_EQ(broker_of(std::string("mqtt://broker:") + port), std::string("`") + port + "` is no port from 1 to 65535");
  EXPECT_EQ(broker_of("mqtt://broker:"), "`` is no port from 1 to 65535");
  EXPECT_EQ(broker_of("mqtt://broker/uagv"), "something stands after the host");
  EXPECT_EQ(broker_of("mqtt://agv:secret@broker"), "a password does not stand in it; WAYMARK_MQTT_PASSWORD of the environment says it");
}

TEST(BrokerUrl, IsShownWithoutItsPassword) {
  EXPECT_EQ(without_password("mqtt://agv:secret@broker:1883"), "mqtt://agv:...@broker:1883");
  EXPECT_EQ(without_password("mqtt://agv:se:cr@et@broker"), "mqtt://agv:...@broker");
  EXPECT_EQ(without_password("mqtt://agv@broker:1883"), "mqtt://agv@broker:1883");
  EXPECT_EQ(without_password("mqtt://broker:1883"), "mqtt://broker:1883");
}

/// The link that options make, or null; and what is wrong with them.
std::pair<std::unique_ptr<Link>, std::string> made(const LinkOptions& options) {
  source::MemoryFileSystem files;
  files.add("orders.jsonl", "{\"t\":1,\"topic\":\"order\",\"message\":{}}\n");
  files.add("wrong.jsonl", "{\"t\":1,\"topic\":\"order\"}\n");
  files.add("plant.key", "-----BEGIN PRIVATE KEY-----\n");
  std::string said;
  source::Sources sources;
  diagnostics::ErrorLines lines(sources, said);
  diagnostics::Diagnostics messages(sources, lines);
  auto link = make_link(options, files, sources, messages);
  EXPECT_EQ(link != nullptr, said.empty()) << said;
  return {std::move(link), std::move(said)};
}

std::string told_of(const LinkOptions& options) { return made(options).second; }

LinkOptions options_with(std::string orders, std::string manufacturer = "Acme", std::string serial = "7") {
  LinkOptions options;
  options.orders = std::move(orders);
  options.identity = {std::move(manufacturer), std::move(serial)};
  options.will = [](std::uint32_t, std::int64_t) { return Message{"connection", "{}", true}; };
  return options;
}

TEST(Link, IsAFileWhereNoBrokerIsNamed) {
  EXPECT_EQ(told_of(options_with("orders.jsonl")), "");
  EXPECT_NE(told_of(options_with("order.jsonl")).find("order.jsonl"), std::string::npos);
  EXPECT_EQ(told_of(options_with("wrong.jsonl")).substr(0, 17), "wrong.jsonl:1:1: ");
}

TEST(Link, WantsNamesThatCanStandInATopic) {
  EXPECT_EQ(told_of(options_with("orders.jsonl", "Ac/me", "")),
            "-: `Ac/me` cannot stand in the name of a topic as the manufacturer: `/` stands in it\n"
            "-: `\"\"` cannot stand in the name of a topic as the serial number: it is empty\n");
  for (const char* const serial : {"a+", "#", "$7", "7\n", "\xFF"}) EXPECT_NE(told_of(options_with("orders.jsonl", "Acme", serial)), "") << serial;
  EXPECT_EQ(told_of(options_with("orders.jsonl", "Acme \xC3\xA9", "a.b_c:d-7")), "");
  LinkOptions options = options_with("orders.jsonl");
  options.interface_name = "a/b";
  EXPECT_EQ(told_of(options), "-: `a/b` cannot stand in the name of a topic as the interface: `/` stands in it\n");
}

TEST(Link, IsToldOfABrokerThatCannotBeOne) {
  EXPECT_EQ(told_of(options_with("mqtt://agv:secret@broker")),
            "-: `mqtt://agv:...@broker` names no broker: a password does not stand in it; WAYMARK_MQTT_PASSWORD of the environment says it; write `mqtt://HOST`, `mqtt://USER@HOST:PORT` or `mqtts://HOST`\n");
  LinkOptions options = options_with("mqtt://broker");
  options.ca_file = "plant.pem";
  EXPECT_EQ(told_of(options), "-: `--ca` names who vouches for the broker, and `mqtt://broker` asks for no proof of it; write `mqtts://`\n");
  options.orders = "mqtts://broker";
  EXPECT_NE(told_of(options).find("plant.pem"), std::string::npos);
  options.ca_file = "plant.key";
  EXPECT_EQ(told_of(options), "-: `plant.key` holds no certificate; one begins with `-----BEGIN CERTIFICATE-----`\n");
}

/// A port of this machine that nobody listens at, and that nobody else can take.
class ClosedPort {
 public:
  ClosedPort() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::socklen_t size = sizeof at;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size), 0);
    number_ = ntohs(at.sin_port);
  }
  ~ClosedPort() { ::close(socket_); }
  ClosedPort(const ClosedPort&) = delete;
  ClosedPort& operator=(const ClosedPort&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int socket_, number_ = 0;
};

TEST(Link, SaysOnceThatItsBrokerCannotBeReached) {
  if (!has_mqtt()) {
    EXPECT_NE(told_of(options_with("mqtt://127.0.0.1")).find("libmosquitto-dev"), std::string::npos);
    GTEST_SKIP() << "built without MQTT";
  }
  const ClosedPort port;
  const auto link = made(options_with("mqtt://127.0.0.1:" + std::to_string(port.number()))).first;
  ASSERT_NE(link, nullptr);
  link->send({"connection", "{}", true}, 0);
  std::string news;
  for (int look = 0; look < 600 && (news = link->news()).empty(); ++look) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(news, "the broker cannot be reached: connection refused");
  std::this_thread::sleep_for(std::chrono::milliseconds(700));   // it is tried again after half a second
  EXPECT_EQ(link->news(), "");
  EXPECT_FALSE(link->next(0));
}

}  // namespace
}  // namespace kb::vda5050
