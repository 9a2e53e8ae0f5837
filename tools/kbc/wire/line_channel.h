// Lines over two file descriptors, with a time limit and an end on request.
#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kb::wire {

/// While an object lives, writing to a pipe without a reader fails with EPIPE instead of ending the program. Only one may live at a time.
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
    kTooLong,   ///< a line longer than `kLongestLine`: the result is its first `kLongestLine` + 1 bytes, the rest is skipped
    kEnd,       ///< the input has ended; a last line without line break counted as a line
    kLate,      ///< the time is up
    kStopped,   ///< `stop` returned true
    kFailed,    ///< see `error`
  };

  /// Neither is owned. `stop` is asked at least ten times a second, and may be null.
  LineChannel(int in, int out, bool (*stop)()) : in_(in), out_(out), stop_(stop) {}

  /// The next line, without LF or CR LF, waiting for it at most `within_ms`.
  [[nodiscard]] Came read(std::string& line, int within_ms);
  /// Whether something arrived that was not read.
  [[nodiscard]] bool holds_more() const;
  /// Writes the line and a line break, waiting at most `within_ms` for room. kLine: it is written; kEnd: there is no reader; kLate: `write_on`
  /// can write the rest of it.
  [[nodiscard]] Came write(std::string_view line, int within_ms);
  [[nodiscard]] Came write_on(int within_ms);
  /// What `stop` says.
  [[nodiscard]] bool stopped() const { return stop_ != nullptr && stop_(); }
  /// errno of the failure.
  [[nodiscard]] int error() const { return error_; }

 private:
  [[nodiscard]] Came wait(int file, short for_what, std::int64_t until_ms) const;
  [[nodiscard]] bool take(std::string& line, Came& came);

  int in_, out_;
  bool (*stop_)();
  std::string come_;              // arrived and not read
  std::string going_;             // not written yet
  std::size_t looked_ = 0;        // how much of it is known to have no line break
  bool skips_ = false, ended_ = false;   // skipping the rest of a line that was too long
  int error_ = 0;
};

}  // namespace kb::wire
