#include "tools/kbc/wire/line_channel.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <limits>

#include "tools/kbc/wire/fields.h"

namespace kb::wire {
namespace {

constexpr std::int64_t kLook_ms = 100;   // it waits no longer than this at once, because a signal may come just before it waits

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::int64_t until(int within_ms) { return within_ms < 0 ? std::numeric_limits<std::int64_t>::max() : now_ms() + within_ms; }

}  // namespace

NoPipeSignal::NoPipeSignal() {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &old_);
}
NoPipeSignal::~NoPipeSignal() { sigaction(SIGPIPE, &old_, nullptr); }

/// Waits until the file is ready (kLine) or something else ends the wait.
LineChannel::Came LineChannel::wait(int file, short for_what, std::int64_t until_ms) const {
  for (;;) {
    if (stopped()) return Came::kStopped;
    const std::int64_t left_ms = until_ms - now_ms();
    pollfd one{file, for_what, 0};
    const int ready = ::poll(&one, 1, static_cast<int>(std::clamp<std::int64_t>(left_ms, 0, kLook_ms)));
    if (ready > 0) return Came::kLine;
    if (ready < 0 && errno != EINTR) return Came::kFailed;
    if (left_ms <= 0) return Came::kLate;
  }
}

/// True if the buffer has a line, or a text that is too long for one.
bool LineChannel::take(std::string& line, Came& came) {
  for (;;) {
    const std::size_t end = come_.find('\n', looked_);
    const bool whole = end != std::string::npos;
    const std::size_t size = whole ? end : come_.size();
    looked_ = size;
    if (!whole && size <= kLongestLine && !(ended_ && size > 0)) {
      if (skips_) come_.clear(), looked_ = 0;
      return false;
    }
    const bool rest = skips_;
    came = size > kLongestLine ? Came::kTooLong : Came::kLine;
    skips_ = !whole && !ended_;
    if (!rest) line.assign(come_, 0, std::min(size, kLongestLine + 1));
    come_.erase(0, whole ? end + 1 : size);
    looked_ = 0;
    if (rest) {
      if (ended_ && !whole) return false;
      continue;
    }
    if (came == Came::kLine && line.ends_with('\r')) line.pop_back();
    return true;
  }
}

LineChannel::Came LineChannel::read(std::string& line, int within_ms) {
  const std::int64_t until_ms = until(within_ms);
  bool late = false;   // something always comes, and never a line
  for (Came came{};; late = now_ms() > until_ms) {
    if (take(line, came)) return came;
    if (ended_) return Came::kEnd;
    if (late) return Came::kLate;
    if (const Came ready = wait(in_, POLLIN, until_ms); ready != Came::kLine) return ready;
    char chunk[1 << 14];
    const ::ssize_t got = ::read(in_, chunk, sizeof chunk);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) {
      error_ = errno;
      return Came::kFailed;
    }
    ended_ = got == 0;
    come_.append(chunk, static_cast<std::size_t>(got));
  }
}

bool LineChannel::holds_more() const {
  pollfd one{in_, POLLIN, 0};
  return !come_.empty() || (::poll(&one, 1, 0) > 0 && (one.revents & POLLIN) != 0);
}

LineChannel::Came LineChannel::write(std::string_view line, int within_ms) {
  going_ = line;
  going_ += '\n';
  return write_on(within_ms);
}

LineChannel::Came LineChannel::write_on(int within_ms) {
  const std::int64_t until_ms = until(within_ms);
  for (std::size_t done = 0;;) {
    const std::string_view rest = std::string_view(going_).substr(done);
    const Came ready = rest.empty() ? Came::kLine : wait(out_, POLLOUT, until_ms);
    if (rest.empty() || ready != Came::kLine) {
      going_.erase(0, done);
      return ready;
    }
    const ::ssize_t put = ::write(out_, rest.data(), std::min<std::size_t>(rest.size(), 4096));   // a pipe with any room has room for so much
    if (put < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (put < 0) {
      error_ = errno;
      return error_ == EPIPE ? Came::kEnd : Came::kFailed;
    }
    done += static_cast<std::size_t>(put);
  }
}

}  // namespace kb::wire
