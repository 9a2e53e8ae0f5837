// Ctrl-C as a wish instead of an end.
#pragma once

#include <csignal>
#include <iterator>

namespace kb::cli {

/// While it lives SIGINT, SIGTERM and SIGHUP (a terminal that is closed; not under nohup) ask for an orderly end; a second one, 0.3 s
/// later or more, ends the program. One at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  /// The first signal that came; 0: none. Any thread may ask.
  [[nodiscard]] static int which();
  [[nodiscard]] static bool came() { return which() != 0; }
  /// One lives.
  [[nodiscard]] static bool are_held();

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction old_[std::size(kSignals)] {};
};

}  // namespace kb::cli
