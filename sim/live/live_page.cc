#include "sim/live/live_page.h"

#include <arpa/inet.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "sim/report/data.h"
#include "sim/report/page.h"

namespace kb::sim {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kMostFrames = 5000;      // in one answer; a page that is opened late asks again for the rest
constexpr std::size_t kMostWaiting = 1000;       // commands that nobody has fetched
constexpr std::size_t kLongestCommand = 4096;    // bytes

constexpr std::size_t kConnections = 32;         // served at a time; each has a thread
constexpr time_t kLongestSilence_s = 2;          // of a browser in the middle of a request, and between two

constexpr std::pair<std::string_view, Command::What> kWords[] = {{"close", Command::What::kCloseRoad}, {"open", Command::What::kOpenRoad},
                                                                 {"press", Command::What::kPress},     {"pause", Command::What::kPause},
                                                                 {"resume", Command::What::kResume}};

/// Whether a `Host` header names this machine: `127.0.0.1:8080` or `localhost:8080`.
bool names_this_machine(std::string_view host) {
  const std::string_view name = host.substr(0, host.rfind(':'));
  return name == "127.0.0.1" || name == "localhost";
}

/// Ends the open connections to `port` of this machine. The library waits for the end of each, and has no call that ends one.
void end_connections(std::uint16_t port) {
  std::error_code unknown;
  for (std::filesystem::directory_iterator at("/dev/fd", unknown), end; !unknown && at != end; at.increment(unknown)) {
    const std::string name = at->path().filename().string();
    int socket = -1;
    std::from_chars(name.data(), name.data() + name.size(), socket);
    sockaddr_in own{};
    socklen_t size = sizeof own;
    if (::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0) continue;
    if (own.sin_family == AF_INET && own.sin_addr.s_addr == htonl(INADDR_LOOPBACK) && own.sin_port == htons(port)) ::shutdown(socket, SHUT_RDWR);
  }
}

}  // namespace

struct LivePage::Server {
  mutable std::mutex mutex;         // guards all but `http` and `thread`
  Recording recording;
  std::vector<Command> waiting;
  bool over = false;
  std::string drive;                // never changes
  httplib::Server http;
  std::thread thread;
  std::uint16_t port = 0;

  void take(const Recording& recording);   // with `mutex` held
  void listen();
  void answer_page(httplib::Response& response);
  void answer_frames(const httplib::Request& request, httplib::Response& response);
  void answer_command(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] std::optional<Command> understand(const std::string& body) const;
};

void LivePage::Server::listen() {
  http.set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}, {"X-Frame-Options", "DENY"}, {"Referrer-Policy", "no-referrer"}});
  http.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (names_this_machine(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    response.set_content("this page is for this machine\n", "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  });
  http.Get("/", [this](const httplib::Request&, httplib::Response& response) { answer_page(response); });
  http.Get("/live/frames", [this](const httplib::Request& request, httplib::Response& response) { answer_frames(request, response); });
  http.Post("/live/command", [this](const httplib::Request& request, httplib::Response& response) { answer_command(request, response); });
  thread = std::thread([this] { http.listen_after_bind(); });
}

void LivePage::Server::answer_page(httplib::Response& response) {
  const std::lock_guard lock(mutex);
  const auto frames = std::min(kMostFrames, static_cast<std::uint32_t>(recording.frames.size()));
  response.set_content(report::assemble_page(recording.title, drive, report::print_data(report::data_of_frames(recording, {0, frames})), "/live"), "text/html; charset=utf-8");
}

void LivePage::Server::answer_frames(const httplib::Request& request, httplib::Response& response) {
  const std::string text = request.get_param_value("from");
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != text.npos) {
    response.status = 400;
    response.set_content("`from` is the number of frames that are there already\n", "text/plain");
    return;
  }
  const std::lock_guard lock(mutex);
  const auto all = static_cast<std::uint32_t>(recording.frames.size());
  const std::uint32_t first = std::min(all, static_cast<std::uint32_t>(std::stoul(text))), last = std::min(all, first + kMostFrames);
  nlohmann::ordered_json answer = {{"over", over && last == all}};
  answer["frames"] = report::data_of_frames(recording, {first, last});
  response.set_content(report::print_data(answer), "application/json");
}

std::optional<Command> LivePage::Server::understand(const std::string& body) const {
  const Json asked = Json::parse(body, nullptr, false);
  if (!asked.is_object() || !asked.value("what", Json()).is_string() || !asked.value("name", Json("")).is_string()) return std::nullopt;
  const auto what = asked["what"].get<std::string>();
  const auto word = std::find_if(std::begin(kWords), std::end(kWords), [&](const auto& one) { return one.first == what; });
  if (word == std::end(kWords)) return std::nullopt;
  Command command{word->second, asked.value("name", "")};
  const auto named = [&](const auto& one) { return one.name == command.name; };
  const auto& roads = recording.picture.roads;
  const auto& cells = recording.names.cells;
  switch (command.what) {
    case Command::What::kCloseRoad:
    case Command::What::kOpenRoad: return std::any_of(roads.begin(), roads.end(), named) ? std::optional(command) : std::nullopt;
    case Command::What::kPress: return std::any_of(cells.begin(), cells.end(), [&](const auto& cell) { return cell.command && named(cell); }) ? std::optional(command) : std::nullopt;
    case Command::What::kPause:
    case Command::What::kResume: command.name.clear(); return command;
  }
  return std::nullopt;
}

void LivePage::Server::answer_command(const httplib::Request& request, httplib::Response& response) {
  const auto refuse = [&](int status, const char* why) {
    response.status = status;
    response.set_content(why, "text/plain");
  };
  if (request.get_header_value("Content-Type") != "application/json") return refuse(415, "commands are JSON\n");
  const std::lock_guard lock(mutex);
  const auto command = understand(request.body);
  if (!command) return refuse(400, "no such command, or nothing of that name\n");
  if (over) return refuse(409, "the drive is over\n");
  if (waiting.size() >= kMostWaiting) return refuse(429, "too many commands wait already\n");
  waiting.push_back(*command);
  response.set_content("{\"ok\":true}", "application/json");
}

LivePage::LivePage(const Recording& recording) : server_(std::make_unique<Server>()) {
  server_->recording = recording;
  server_->drive = report::print_data(report::data_of_drive(recording));
}

LivePage::~LivePage() {
  if (!server_->thread.joinable()) return;
  server_->http.stop();
  end_connections(server_->port);
  server_->thread.join();
}

bool LivePage::start(std::uint16_t port) {
  if (server_->thread.joinable()) return false;
  constexpr const char* kHere = "127.0.0.1";
  server_->http.set_payload_max_length(kLongestCommand);
  server_->http.set_read_timeout(kLongestSilence_s);
  server_->http.set_keep_alive_timeout(kLongestSilence_s);
  server_->http.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };   // the library deletes it
  // The default socket options of the library would let two programs share a port.
  server_->http.set_socket_options([](socket_t socket) {
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
  if (port != 0 && !server_->http.bind_to_port(kHere, port)) return false;
  const int bound = port != 0 ? port : server_->http.bind_to_any_port(kHere);
  if (bound <= 0) return false;
  server_->port = static_cast<std::uint16_t>(bound);
  server_->listen();
  // Waits until the server runs, since `stop` has no effect before.
  for (int i = 0; i < 1000 && !server_->http.is_running(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return server_->http.is_running();
}

std::uint16_t LivePage::port() const { return server_->port; }

void LivePage::Server::take(const Recording& given) {
  const std::size_t known = std::min(recording.frames.size(), given.frames.size());
  recording.frames.insert(recording.frames.end(), given.frames.begin() + static_cast<std::ptrdiff_t>(known), given.frames.end());
  recording.stays = given.stays;
  recording.outcome = given.outcome;
}

void LivePage::append(const Recording& recording) {
  const std::lock_guard lock(server_->mutex);
  server_->take(recording);
}

// Under one lock: no page is told how the drive ended before it is told that it ended.
void LivePage::finish(const Recording& recording) {
  const std::lock_guard lock(server_->mutex);
  server_->take(recording);
  server_->over = true;
}

std::vector<Command> LivePage::commands() {
  const std::lock_guard lock(server_->mutex);
  return std::exchange(server_->waiting, {});
}

}  // namespace kb::sim
