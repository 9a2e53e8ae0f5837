#include "tools/kbc/interrupts.h"

#include <unistd.h>

#include <ctime>

namespace kb::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;   // the first signal that came; 0: none
volatile std::sig_atomic_t unseen = 0;        // whether it came and `which` has not told yet
bool held = false;
timespec first_came{};   // used only by the handler
constexpr unsigned kAgain_s = 1;

// `timeout` and some shells send a signal both to the program and to its group, so two signals at the same moment count as one.
void note(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted == 0) {
    first_came = now;
    interrupted = signal;
    unseen = 1;
    alarm(kAgain_s);
    return;
  }
  const double since_s = static_cast<double>(now.tv_sec - first_came.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - first_came.tv_nsec);
  if (since_s < 0.3) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);   // when the handler has returned
}

// The signal may have come between the last look at `which` and a call that waits, say for the reader of a pipe. That call would wait on.
void break_off_waiting(int /*signal*/) {
  if (unseen != 0) alarm(kAgain_s);
}

}  // namespace

Interrupts::Interrupts() {
  interrupted = 0;
  unseen = 0;
  held = true;
  struct sigaction again {};
  again.sa_handler = break_off_waiting;
  sigaction(SIGALRM, &again, &old_alarm_);
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
  if (interrupted != 0) alarm(0);
  sigaction(SIGALRM, &old_alarm_, nullptr);
}

int Interrupts::which() {
  const int signal = interrupted;
  if (signal != 0) unseen = 0;
  return signal;
}
bool Interrupts::are_held() { return held; }

}  // namespace kb::cli
