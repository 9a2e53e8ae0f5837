// Ctrl-C as a wish instead of an end.
#pragma once

#include <csignal>

namespace kb::cli {

/// While it lives SIGINT and SIGTERM ask for an orderly end; a second one, 0.3 s later or more, ends the program. One at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  /// Any thread may ask.
  [[nodiscard]] static bool came();

 private:
  struct sigaction old_int_ {}, old_term_ {};
};

}  // namespace kb::cli
