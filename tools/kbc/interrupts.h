// Ctrl-C as a request to end instead of the end.
#pragma once

#include <csignal>
#include <iterator>

namespace kb::cli {

/// While an object of this class lives, SIGINT, SIGTERM and SIGHUP (the terminal was closed; not under nohup) request an orderly end. A
/// second signal, at least 0.3 s later, ends the program. With `reopens`, a SIGHUP that was ignored (by nohup, or since `put_off_hangups`) requests
/// that files be opened anew. Only one object may live at a time. Until `which` has told of the signal, each
/// second a call that waits in the main thread is broken off with EINTR (by SIGALRM). So no wait outlasts the request.
class Interrupts {
 public:
  explicit Interrupts(bool reopens = false);
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  /// If the process has no terminal that could be closed, SIGHUP is ignored from now on, until an object that `reopens` lives.
  static void put_off_hangups();
  /// The first signal that came; 0: none. Any thread may ask.
  [[nodiscard]] static int which();
  [[nodiscard]] static bool came() { return which() != 0; }
  /// Whether files are to be opened anew: once for each time.
  [[nodiscard]] static bool reopen();
  /// Whether an object lives.
  [[nodiscard]] static bool are_held();

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction old_[std::size(kSignals)] {}, old_alarm_ {};
};

}  // namespace kb::cli
