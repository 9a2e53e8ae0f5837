#include "tools/kbc/interrupts.h"

#include <ctime>

namespace kb::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;   // the first signal that came; 0: none
bool held = false;
timespec first_came{};   // used only by the handler

// `timeout` and some shells send a signal both to the program and to its group, so two signals at the same moment count as one.
void note(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted == 0) {
    first_came = now;
    interrupted = signal;
    return;
  }
  const double since_s = static_cast<double>(now.tv_sec - first_came.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - first_came.tv_nsec);
  if (since_s < 0.3) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);   // when the handler has returned
}

}  // namespace

Interrupts::Interrupts() {
  interrupted = 0;
  held = true;
  struct sigaction action {};
  action.sa_handler = note;
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    sigaction(kSignals[i], &action, &old_[i]);
    const bool ignored = kSignals[i] == SIGHUP && old_[i].sa_handler == SIG_IGN;
    if (ignored) sigaction(SIGHUP, &old_[i], nullptr);
  }
}

Interrupts::~Interrupts() {
  held = false;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) sigaction(kSignals[i], &old_[i], nullptr);
}

int Interrupts::which() { return interrupted; }
bool Interrupts::are_held() { return held; }

}  // namespace kb::cli
