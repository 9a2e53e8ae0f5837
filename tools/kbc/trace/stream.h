// Input as it arrives, cut into lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::trace {

/// Bytes in order of arrival. It need not be seekable, so a pipe will do.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Up to `size` bytes into `to`; 0 at the end or when reading failed (then `error` says why).
  virtual std::size_t read(char* to, std::size_t size) = 0;
  /// Why reading stopped, in words; empty at a regular end.
  [[nodiscard]] virtual std::string error() const { return {}; }

  /// Called before a read that may wait for whoever writes: who answers line by line hands over its answers here.
  std::function<void()> before_read;
};

/// The file at `path`, or standard input for "-". Null if it cannot be opened; `error` then says why. Once `stop` returns true,
/// the stream ends as at its regular end.
[[nodiscard]] std::unique_ptr<ByteStream> open_stream(const std::string& path, std::string& error, bool (*stop)() = nullptr);

/// All bytes of the file at `path`, or of standard input for "-". Nothing if it cannot be read (`error` says why) or holds more than
/// `most` bytes (`error` is empty).
[[nodiscard]] std::optional<std::string> read_all(const std::string& path, std::size_t most, std::string& error);

/// Bytes in memory, handed out at most `chunk` at a time; for tests and fuzzing. The bytes must outlive the stream.
class MemoryStream final : public ByteStream {
 public:
  explicit MemoryStream(std::string_view bytes, std::size_t chunk = SIZE_MAX) : rest_(bytes), chunk_(chunk) {}
  std::size_t read(char* to, std::size_t size) override;

 private:
  std::string_view rest_;
  std::size_t chunk_;
};

/// Cuts a stream into lines, in memory that does not grow with the stream. A line ends with LF or CR LF; the last may
/// lack it. A byte-order mark at the beginning is skipped.
class LineReader {
 public:
  /// The longest line in bytes, its line break not counted.
  static constexpr std::size_t kMaxLineBytes = std::size_t{1} << 20;

  explicit LineReader(ByteStream& stream) : stream_(stream) {}

  struct Line {
    std::string_view text;     ///< without the line break; valid until the next call
    std::uint64_t number = 0;  ///< the first line is 1
    bool ended = true;         ///< it has a line end: only the last may lack it
    bool too_long = false;     ///< over the limit: `text` is its beginning, and no further line can be read
    std::string_view bytes = {};   ///< `text` as it came, with its line break, and the byte-order mark before the first
  };
  /// The next line, or nothing at the end of the stream. Amortised O(bytes).
  [[nodiscard]] std::optional<Line> next();

 private:
  bool fill();
  ByteStream& stream_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // the part read and not yet handed out
  std::uint64_t number_ = 0;
  bool ended_ = false;
};

}  // namespace kb::trace
