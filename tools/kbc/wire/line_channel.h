// Lines over two file descriptors, with a time limit, and with an end that can be asked for.
#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kb::wire {

/// While it lives, writing to a pipe that nobody reads fails with EPIPE instead of ending the program. One at a time.
class NoPipeSignal {
 public:
  NoPipeSignal();
  ~NoPipeSignal();
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  struct sigaction old_ {};
};

class LineChannel {
 public:
  static constexpr int kForEver = -1;
  enum class Came : std::uint8_t {
    kLine,
    kTooLong,   ///< a line of more than `kLongestLine` bytes: its beginning, one byte too long as well; what is left of it will be passed over
    kEnd,       ///< nothing comes any more; a last line without a line break was a line
    kLate,      ///< the time is up
    kStopped,   ///< `stop` says so
    kFailed,    ///< see `error`
  };

  /// Neither is owned. `stop` is asked at least ten times a second, and may be null.
  LineChannel(int in, int out, bool (*stop)()) : in_(in), out_(out), stop_(stop) {}

  /// The next line, without LF or CR LF, waiting for it at most `within_ms`.
  [[nodiscard]] Came read(std::string& line, int within_ms);
  /// Something came that was not read.
  [[nodiscard]] bool holds_more() const;
  /// The line, and a line break, waiting at most `within_ms` for room. kLine: it is written; kEnd: nobody reads.
  [[nodiscard]] Came write(std::string_view line, int within_ms);
  /// errno of what failed.
  [[nodiscard]] int error() const { return error_; }

 private:
  [[nodiscard]] Came wait(int file, short for_what, std::int64_t until_ms) const;
  [[nodiscard]] bool take(std::string& line, Came& came);

  int in_, out_;
  bool (*stop_)();
  std::string come_;              // and not read
  std::size_t looked_ = 0;        // so much of it has no line break
  bool skips_ = false, ended_ = false;   // the rest of a line that was too long
  int error_ = 0;
};

}  // namespace kb::wire
