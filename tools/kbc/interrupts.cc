#include "tools/kbc/interrupts.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace kb::cli {
namespace {

// Any thread may be interrupted by a signal, and another may ask for it at the same time.
std::atomic<int> interrupted{0};               // the first signal that came; 0: none
std::atomic<bool> unseen{false};               // whether it came and `which` has not told yet
std::atomic<bool> hung_up{false};              // whether a SIGHUP came that means files, and `reopen` has not told yet
std::atomic<bool> hangup_means_files{false};
std::atomic<std::int64_t> first_came_ns{0};    // when; 0: none has come
static_assert(decltype(interrupted)::is_always_lock_free && decltype(unseen)::is_always_lock_free && decltype(first_came_ns)::is_always_lock_free);
bool held = false;
constexpr unsigned kAgain_s = 1;
constexpr std::int64_t kSameMoment_ns = 300'000'000;

// `timeout` and some shells send a signal both to the program and to its group, so two signals at the same moment count as one.
void note(int signal) {
  if (signal == SIGHUP && hangup_means_files) {
    hung_up = true;
    return;
  }
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  std::int64_t first_ns = 0;
  if (first_came_ns.compare_exchange_strong(first_ns, now_ns)) {
    unseen = true;
    interrupted = signal;
    alarm(kAgain_s);
    return;
  }
  if (now_ns - first_ns < kSameMoment_ns) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);   // when the handler has returned
}

// The signal may have come between the last look at `which` and a call that waits, say for the reader of a pipe. That call would wait on.
void break_off_waiting(int /*signal*/) {
  if (unseen) alarm(kAgain_s);
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
  first_came_ns = 0;
  unseen = hung_up = hangup_means_files = false;
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
  if (signal != 0) unseen = false;
  return signal;
}
bool Interrupts::reopen() { return hung_up.exchange(false); }
bool Interrupts::are_held() { return held; }

}  // namespace kb::cli
