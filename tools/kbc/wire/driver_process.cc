#include "tools/kbc/wire/driver_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <utility>

#include "compiler/source/reason.h"

extern char** environ;

namespace kb::wire {
namespace {

constexpr int kEndsBySelf_ms = 5000;   // long enough for its files to get to a slow card
constexpr int kEndsSoon_ms = 1000, kEndsAsked_ms = 1000;

/// A pipe whose ends other programs do not inherit.
struct Pipe {
  int file[2] = {-1, -1};
  Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : file) {
      if (end >= 0) ::close(end);
    }
  }
  [[nodiscard]] bool open() { return ::pipe2(file, O_CLOEXEC) == 0; }
  [[nodiscard]] int take(int end) { return std::exchange(file[end], -1); }
};

int spawn(const std::string& command, const Pipe& to, const Pipe& from, ::pid_t& id) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, to.file[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from.file[1], STDOUT_FILENO);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);   // this process ignores it
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);   // a group of its own: Ctrl-C reaches only kbc, which passes it on
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::string shell = "/bin/sh", option = "-c", text = command;
  char* const words[] = {shell.data(), option.data(), text.data(), nullptr};
  const int error = ::posix_spawn(&id, shell.c_str(), &actions, &attributes, words, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::unique_ptr<DriverProcess> DriverProcess::start(const std::string& command, bool (*stop)(), std::string& error) {
  Pipe to, from;
  ::pid_t id = 0;
  const int failed = to.open() && from.open() ? spawn(command, to, from, id) : errno;
  if (failed != 0) {
    error = source::reason(failed);
    return nullptr;
  }
  for (const int end : {to.file[1], from.file[0]}) ::fcntl(end, F_SETFL, ::fcntl(end, F_GETFL) | O_NONBLOCK);
  return std::unique_ptr<DriverProcess>(new DriverProcess(id, from.take(0), to.take(1), stop));
}

/// Does not reap the process: until it is reaped, no other process gets its number, so `end` may still use the number of its group.
bool DriverProcess::ends_within(int ms) const {
  constexpr int kStep_ms = 5;
  for (int gone_ms = 0; gone_ms <= ms; gone_ms += kStep_ms) {
    siginfo_t info{};
    const int looked = ::waitid(P_PID, static_cast<::id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (looked == 0 ? info.si_pid == id_ : errno != EINTR) return true;
    if (channel_.stopped()) ms = std::min(ms, kEndsSoon_ms);
    const timespec step{0, kStep_ms * 1'000'000L};
    ::nanosleep(&step, nullptr);
  }
  return false;
}

std::string DriverProcess::end() {
  if (out_ >= 0) ::close(std::exchange(out_, -1));
  if (in_ >= 0) ::close(std::exchange(in_, -1));
  if (!std::exchange(ended_, true)) {
    if (!ends_within(failed_ ? kEndsSoon_ms : kEndsBySelf_ms)) {
      ::kill(-id_, SIGTERM);
      static_cast<void>(ends_within(kEndsAsked_ms));
    }
    ::kill(-id_, SIGKILL);   // also what it has started and left behind
    while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
    }
  }
  if (WIFSIGNALED(status_)) return "signal " + std::to_string(WTERMSIG(status_));
  return "exit code " + std::to_string(WEXITSTATUS(status_));
}

DriverProcess::~DriverProcess() { static_cast<void>(end()); }

}  // namespace kb::wire
