#include "tools/kbc/vda5050/link/mqtt_link.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <pthread.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include "compiler/source/reason.h"
#include "tools/kbc/vda5050/order.h"

namespace kb::vda5050 {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kKeepAlive_s = 15;                          // as section 6.14 recommends
constexpr int kLook_ms = 100;                             // how long the thread may take to notice that it should leave
constexpr milliseconds kShortestPause{500}, kLongestPause{8000};
constexpr milliseconds kFarewell{1000};
constexpr std::size_t kMostWaiting = 64, kMostNews = 16;
constexpr std::string_view kConnection = "connection";

std::int64_t now_utc_us() { return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch()).count(); }

/// Why the broker refuses, by its answer to CONNECT (MQTT 3.1.1, table 3.1).
std::string refusal(int code) {
  static constexpr const char* kWords[] = {"it does not speak MQTT 3.1.1", "it does not want a client of this name", "it is not ready", "user or password are wrong", "this user may not connect"};
  return code >= 1 && code <= 5 ? kWords[code - 1] : fmt::format("it refuses with code {}", code);
}

/// What the link and its thread share. The thread may outlive the link, because looking up the name of a host can take long.
class Session {
 public:
  explicit Session(MqttOptions options) : options_(std::move(options)) { mosquitto_lib_init(); }
  ~Session() { mosquitto_lib_cleanup(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// False if libmosquitto cannot do what the options want; `error` says why.
  [[nodiscard]] bool prepare(std::string& error) { return (client_ = make_client(error)) != nullptr; }
  /// What the thread does.
  void run();
  /// Asks the thread to end. True if it has, within the time that a farewell may take.
  [[nodiscard]] bool leave();

  [[nodiscard]] std::optional<Message> next();
  void send(const Message& message);
  [[nodiscard]] bool connected_anew();
  [[nodiscard]] std::string news();

 private:
  struct Ended {
    bool connected = false;      // there was a connection
    bool not_there = false;      // nothing listens at that address
    std::string why;
  };

  using Client = std::unique_ptr<mosquitto, void (*)(mosquitto*)>;
  [[nodiscard]] Client make_client(std::string& error);
  [[nodiscard]] std::uint32_t next_will();
  void set_callbacks(mosquitto* client);
  [[nodiscard]] Ended attempt(const char* from);
  void disconnect();
  [[nodiscard]] bool wants_to_go_on();
  [[nodiscard]] std::string reason(int code, int system_error);
  [[nodiscard]] std::string closed();
  void publish(const Message& message);
  void tell(std::string text);
  [[nodiscard]] std::string topic(std::string_view last) const { return fmt::format("{}/{}", options_.topics, last); }

  void on_connect(int code);
  void on_disconnect();
  void on_message(const mosquitto_message& message);

  const MqttOptions options_;
  Client client_{nullptr, mosquitto_destroy};   // one for each connection: libmosquitto 2.0.11 does not connect twice with some of the options that are set

  // Guards all members below, and the pointer `client_`, which only the thread replaces. libmosquitto's callbacks take it while libmosquitto
  // holds a mutex of its own; the functions that are called here with it held do not take that mutex, so there is no deadlock.
  std::mutex mutex_;
  std::condition_variable changed_;
  bool leaves_ = false, gone_ = false, connected_ = false, was_connected_ = false;
  bool anew_ = false;                    // connected since the last question
  Clock::time_point leaves_at_{};
  std::deque<Message> came_;
  std::map<std::string, Message> kept_;  // by topic
  std::set<int> under_way_;              // numbers of messages handed to libmosquitto and not yet sent or acknowledged
  std::deque<std::string> news_;
  std::string told_, refused_, tls_;     // the last news; why the broker refused; why TLS failed
  std::size_t dropped_ = 0;
  std::uint32_t connections_told_ = 0;   // how many messages `connection` the vehicle has sent
  int closed_ = 0;                       // how many connections the broker has closed without a word
};

void Session::set_callbacks(mosquitto* client) {
  mosquitto_connect_callback_set(client, [](mosquitto*, void* self, int code) { static_cast<Session*>(self)->on_connect(code); });
  mosquitto_disconnect_callback_set(client, [](mosquitto*, void* self, int) { static_cast<Session*>(self)->on_disconnect(); });
  mosquitto_message_callback_set(client, [](mosquitto*, void* self, const mosquitto_message* message) { static_cast<Session*>(self)->on_message(*message); });
  mosquitto_publish_callback_set(client, [](mosquitto*, void* self, int number) {
    Session& session = *static_cast<Session*>(self);
    const std::lock_guard lock(session.mutex_);
    session.under_way_.erase(number);
  });
  // "OpenSSL Error[0]: error:0A000086:SSL routines::certificate verify failed"; errors are logged by the thread alone.
  mosquitto_log_callback_set(client, [](mosquitto*, void* self, int level, const char* text) {
    if (level != MOSQ_LOG_ERR || text == nullptr) return;
    const std::string_view line(text);
    static_cast<Session*>(self)->tls_ = line.substr(line.rfind(':') + 1);
  });
}

/// The number of the will: ONLINE comes before it.
std::uint32_t Session::next_will() {
  const std::lock_guard lock(mutex_);
  return connections_told_ + 1;
}

Session::Client Session::make_client(std::string& error) {
  Client client(mosquitto_new(options_.client.c_str(), true, this), mosquitto_destroy);
  if (client == nullptr) throw std::bad_alloc();
  mosquitto* const raw = client.get();
  mosquitto_threaded_set(raw, true);
  set_callbacks(raw);
  const Broker& broker = options_.broker;
  const Message will = options_.will(next_will(), now_utc_us());
  int code = mosquitto_will_set(raw, topic(will.topic).c_str(), static_cast<int>(will.payload.size()), will.payload.data(), 1, true);
  const auto then = [&code](auto set) {
    if (code == MOSQ_ERR_SUCCESS) code = set();
  };
  const char* const password = options_.password.empty() ? nullptr : options_.password.c_str();
  if (!broker.user.empty()) then([&] { return mosquitto_username_pw_set(raw, broker.user.c_str(), password); });
  if (broker.tls && options_.ca_file.empty()) then([&] { return mosquitto_int_option(raw, MOSQ_OPT_TLS_USE_OS_CERTS, 1); });
  else if (broker.tls) then([&] { return mosquitto_tls_set(raw, options_.ca_file.c_str(), nullptr, nullptr, nullptr, nullptr); });
  if (code == MOSQ_ERR_SUCCESS) return client;
  error = mosquitto_strerror(code);
  return {nullptr, mosquitto_destroy};
}

/// Connects again and again until it is to leave. If a name has addresses of IPv6 and of IPv4, libmosquitto tries only the first of them when it
/// must not block. For `localhost` that is mostly IPv6, while many brokers listen on IPv4 only; so if nothing listens, it tries IPv4 as well.
void Session::run() {
  milliseconds pause = kShortestPause;
  for (std::unique_lock lock(mutex_); !leaves_;) {
    lock.unlock();
    const Clock::time_point began = Clock::now();
    Ended ended = attempt(nullptr);
    if (ended.not_there && wants_to_go_on()) {
      if (Ended other = attempt("0.0.0.0"); other.connected) ended = std::move(other);
    }
    lock.lock();
    if (leaves_) break;
    tell(fmt::format("{}: {}", ended.connected ? "the connection to the broker is lost" : "the broker cannot be reached", ended.why));
    pause = ended.connected && Clock::now() - began > kLongestPause ? kShortestPause : pause;   // but a broker that ends each connection at once is asked less and less often
    changed_.wait_for(lock, pause, [this] { return leaves_; });
    pause = std::min(2 * pause, kLongestPause);
  }
  const std::lock_guard lock(mutex_);
  gone_ = true;
  changed_.notify_all();
}

/// One connection, from its beginning to its end.
Session::Ended Session::attempt(const char* from) {
  std::string why;
  Client client = make_client(why);
  if (client == nullptr) return {false, false, why};   // for example, the file of certificates has gone
  {
    const std::lock_guard lock(mutex_);
    client_.swap(client);
    was_connected_ = false;
    refused_.clear(), tls_.clear();
  }
  errno = 0;
  mosquitto* const raw = client_.get();
  int code = from == nullptr ? mosquitto_connect_async(raw, options_.broker.host.c_str(), options_.broker.port, kKeepAlive_s)
                             : mosquitto_connect_bind_async(raw, options_.broker.host.c_str(), options_.broker.port, kKeepAlive_s, from);
  int system_error = errno;
  while (code == MOSQ_ERR_SUCCESS && wants_to_go_on()) {
    errno = 0;
    code = mosquitto_loop(raw, kLook_ms, 1);
    system_error = errno;
  }
  if (code == MOSQ_ERR_SUCCESS) disconnect();
  on_disconnect();
  const std::lock_guard lock(mutex_);
  return {was_connected_, !was_connected_ && code == MOSQ_ERR_ERRNO, reason(code, system_error)};
}

/// Disconnects in order, so that the broker does not publish the will.
void Session::disconnect() {
  mosquitto* const raw = client_.get();
  if (mosquitto_disconnect(raw) != MOSQ_ERR_SUCCESS) return;
  const Clock::time_point until = Clock::now() + kFarewell / 4;
  while (mosquitto_loop(raw, kLook_ms, 1) == MOSQ_ERR_SUCCESS && Clock::now() < until) {}
}

/// Whether the connection is still needed: until it is to leave, and then for a second while it still connects or messages are under way.
bool Session::wants_to_go_on() {
  const std::lock_guard lock(mutex_);
  return !leaves_ || (Clock::now() < leaves_at_ && (!connected_ || !under_way_.empty()));
}

bool Session::leave() {
  std::unique_lock lock(mutex_);
  leaves_ = true;
  leaves_at_ = Clock::now() + kFarewell;
  changed_.notify_all();
  return changed_.wait_for(lock, kFarewell + kFarewell / 2, [this] { return gone_; });
}

std::string Session::reason(int code, int system_error) {
  switch (code) {
    case MOSQ_ERR_ERRNO: return source::reason(system_error);
    case MOSQ_ERR_EAI: return "there is no such host";
    case MOSQ_ERR_CONN_LOST: return !refused_.empty() ? refused_ : closed();
    case MOSQ_ERR_CONN_REFUSED: return refused_;
    case MOSQ_ERR_KEEPALIVE: return "it does not answer";
    case MOSQ_ERR_TLS: return tls_.empty() ? "TLS failed" : "TLS: " + tls_;
    default: return mosquitto_strerror(code);
  }
}

/// Brokers close a connection without a word if another client comes with the same name, and the two then take it from each other in turn.
std::string Session::closed() {
  const std::string text = "it has closed the connection";
  if (was_connected_) ++closed_;
  return closed_ < 2 ? text : fmt::format("{}; if this goes on, another program has the name of this vehicle, `{}`", text, options_.client);
}

/// This and the functions below are called with the mutex held.
void Session::tell(std::string text) {
  if (text == told_) return;
  told_ = text;
  if (news_.size() == kMostNews) news_.pop_front();
  news_.push_back(std::move(text));
}

void Session::publish(const Message& message) {
  const bool keeps = message.topic == kConnection;
  int number = 0;
  const int code = mosquitto_publish(client_.get(), &number, topic(message.topic).c_str(), static_cast<int>(message.payload.size()), message.payload.data(), keeps ? 1 : 0, keeps || message.retained);
  if (code == MOSQ_ERR_SUCCESS) under_way_.insert(number);
  else if (code != MOSQ_ERR_NO_CONN && code != MOSQ_ERR_CONN_LOST) tell(fmt::format("`{}` could not be sent: {}", message.topic, mosquitto_strerror(code)));
}

void Session::send(const Message& message) {
  const std::lock_guard lock(mutex_);
  if (connected_) publish(message);
  if (message.topic != "visualization") kept_[message.topic] = message;
  if (message.topic == kConnection) ++connections_told_;
}

void Session::on_connect(int code) {
  const std::lock_guard lock(mutex_);
  if (code != 0) {
    refused_ = refusal(code);
    return;
  }
  connected_ = was_connected_ = true;
  tell("connected");
  // Subscribe before `connection` is published: a master may answer that with an order at once.
  for (const char* const name : {"order", "instantActions"}) static_cast<void>(mosquitto_subscribe(client_.get(), nullptr, topic(name).c_str(), 0));
  anew_ = !leaves_;
  if (anew_) return;
  if (const auto first = kept_.find(std::string(kConnection)); first != kept_.end()) publish(first->second);
  for (const auto& [name, message] : kept_) {
    if (name != kConnection) publish(message);
  }
}

void Session::on_disconnect() {
  const std::lock_guard lock(mutex_);
  connected_ = false;
  under_way_.clear();
}

void Session::on_message(const mosquitto_message& message) {
  const std::string_view name(message.topic);
  const auto size = static_cast<std::size_t>(message.payloadlen);
  const std::string last(name.substr(name.rfind('/') + 1));
  Message came{last, std::string(static_cast<const char*>(message.payload), std::min(size, kMostBytes + 1))};
  if (options_.prepare && !message.retain) options_.prepare(came);
  const std::lock_guard lock(mutex_);
  if (message.retain) return tell(fmt::format("`{}` that the broker had kept is passed over: it may be of any day", last));
  const bool room = came_.size() < kMostWaiting;
  if (!room || size > kMostBytes) ++dropped_;
  if (room) {
    came_.push_back(std::move(came));
  } else if (std::none_of(came_.begin(), came_.end(), [&](const Message& one) { return one.topic == last && one.payload == kDropped; })) {
    came_.push_back({last, kDropped});
  }
}

std::optional<Message> Session::next() {
  const std::lock_guard lock(mutex_);
  if (came_.empty()) return std::nullopt;
  Message message = std::move(came_.front());
  came_.pop_front();
  return message;
}

bool Session::connected_anew() {
  const std::lock_guard lock(mutex_);
  return std::exchange(anew_, false);
}

std::string Session::news() {
  const std::lock_guard lock(mutex_);
  if (!news_.empty()) {
    std::string text = std::move(news_.front());
    news_.pop_front();
    return text;
  }
  const std::size_t dropped = std::exchange(dropped_, 0);
  return dropped == 0 ? std::string() : fmt::format("{} of the master's messages were dropped: {} others waited, or they have more than {} bytes", dropped, kMostWaiting, kMostBytes);
}

class MqttLink final : public Link {
 public:
  explicit MqttLink(std::shared_ptr<Session> session) : session_(std::move(session)) {
    // The thread takes no signals: they are for the thread that reads the robot's lines, and SIGPIPE must not end the program.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([session = session_] { session->run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~MqttLink() override {
    if (session_->leave()) thread_.join();
    else thread_.detach();
  }
  MqttLink(const MqttLink&) = delete;
  MqttLink& operator=(const MqttLink&) = delete;

  [[nodiscard]] std::optional<Message> next(std::int64_t /*t_us*/) override { return session_->next(); }
  void send(const Message& message, std::int64_t /*t_us*/) override { session_->send(message); }
  [[nodiscard]] std::int64_t utc_us(std::int64_t /*t_us*/) override { return now_utc_us(); }
  [[nodiscard]] bool connected_anew() override { return session_->connected_anew(); }
  [[nodiscard]] std::string news() override { return session_->news(); }

 private:
  std::shared_ptr<Session> session_;
  std::thread thread_;
};

}  // namespace

bool has_mqtt() { return true; }

std::unique_ptr<Link> open_mqtt(MqttOptions options, std::string& error) {
  auto session = std::make_shared<Session>(std::move(options));
  if (!session->prepare(error)) return nullptr;
  return std::make_unique<MqttLink>(std::move(session));
}

}  // namespace kb::vda5050
