#include "tools/kbc/interrupts.h"

#include <fcntl.h>
#include <unistd.h>

#include <ctime>

namespace kb::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;   // the first signal that came; 0: none
volatile std::sig_atomic_t unseen = 0;        // whether it came and `which` has not told yet
volatile std::sig_atomic_t hung_up = 0;       // whether a SIGHUP came that means files, and `reopen` has not told yet
bool held = false, hangup_means_files = false;
timespec first_came{};   // used only by the handler
constexpr unsigned kAgain_s = 1;

// `timeout` and some shells send a signal both to the program and to its group, so two signals at the same moment count as one.
void note(int signal) {
  if (signal == SIGHUP && hangup_means_files) {
    hung_up = 1;
    return;
  }
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

bool has_terminal() {
  const int terminal = ::open("/dev/tty", O_RDONLY | O_NOCTTY | O_CLOEXEC);
  if (terminal >= 0) ::close(terminal);
  return terminal >= 0;
}

}  // namespace

void Interrupts::put_off_hangups() {
  if (!has_terminal()) std::signal(SIGHUP, SIG_IGN);
}

Interrupts::Interrupts(bool reopens) {
  interrupted = 0;
  unseen = 0;
  hung_up = 0;
  hangup_means_files = false;
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
    if (ignored && reopens) hangup_means_files = true;
    else if (ignored) sigaction(SIGHUP, &old_[i], nullptr);
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
bool Interrupts::reopen() {
  if (hung_up == 0) return false;
  hung_up = 0;
  return true;
}
bool Interrupts::are_held() { return held; }

}  // namespace kb::cli
