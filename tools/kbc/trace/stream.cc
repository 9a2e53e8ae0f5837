#include "tools/kbc/trace/stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "compiler/source/encoding.h"
#include "compiler/source/reason.h"

namespace kb::trace {
namespace {

using source::reason;

constexpr std::size_t kInputBytes = std::size_t{256} * 1024;

class FileStream final : public ByteStream {
 public:
  FileStream(int file, bool owned, bool (*stop)()) : file_(file), owned_(owned), stop_(stop) {
    struct ::stat about {};
    waits_ = ::fstat(file, &about) != 0 || !S_ISREG(about.st_mode);
  }
  FileStream(const FileStream&) = delete;
  FileStream& operator=(const FileStream&) = delete;
  ~FileStream() override {
    if (owned_) ::close(file_);
  }

  std::size_t read(char* to, std::size_t size) override {
    if (waits_ && before_read) before_read();
    while (stop_ == nullptr || !stop_()) {
      const ::ssize_t got = ::read(file_, to, size);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno == EINTR) continue;
      error_ = reason(errno);
      break;
    }
    return 0;
  }
  [[nodiscard]] std::string error() const override { return error_; }

 private:
  int file_;
  bool owned_, waits_ = true;
  bool (*stop_)();
  std::string error_;
};

}  // namespace

std::unique_ptr<ByteStream> open_stream(const std::string& path, std::string& error, bool (*stop)()) {
  if (path == "-") return std::make_unique<FileStream>(STDIN_FILENO, false, stop);
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    error = reason(errno);
    return nullptr;
  }
  struct ::stat about {};
  if (::fstat(file, &about) == 0 && S_ISDIR(about.st_mode)) {
    ::close(file);
    error = reason(EISDIR);
    return nullptr;
  }
  return std::make_unique<FileStream>(file, true, stop);
}

std::optional<std::string> read_all(const std::string& path, std::size_t most, std::string& error) {
  const auto stream = open_stream(path, error);
  if (!stream) return std::nullopt;
  std::string bytes;
  char chunk[1 << 16];
  while (const std::size_t got = stream->read(chunk, sizeof chunk)) {
    bytes.append(chunk, got);
    if (bytes.size() > most) return std::nullopt;
  }
  error = stream->error();
  return error.empty() ? std::optional(std::move(bytes)) : std::nullopt;
}

std::size_t MemoryStream::read(char* to, std::size_t size) {
  const std::size_t n = std::min({size, chunk_, rest_.size()});
  if (n > 0) std::memcpy(to, rest_.data(), n);
  rest_.remove_prefix(n);
  return n;
}

// Moves the unread rest to the front, makes room, and reads once. False at the end of the input.
bool LineReader::fill() {
  if (ended_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() < end_ + kInputBytes) buffer_.resize(end_ + kInputBytes);
  const std::size_t got = stream_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += got;
  ended_ = got == 0;
  return !ended_;
}

std::optional<LineReader::Line> LineReader::next() {
  std::size_t searched = 0;
  for (;;) {
    const char* begin = buffer_.data() + begin_;
    const std::size_t left = end_ - begin_;
    const void* found = left > searched ? std::memchr(begin + searched, '\n', left - searched) : nullptr;
    const bool whole = found != nullptr;
    if (!whole && left <= kMaxLineBytes + 1 && fill()) {
      searched = left;
      continue;
    }
    if (!whole && left == 0) return std::nullopt;

    Line line{.text = {}, .number = ++number_, .ended = whole};
    const std::size_t size = whole ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : left;
    begin = buffer_.data() + begin_;  // `fill` may have moved it
    begin_ += size + (whole ? 1 : 0);
    line.text = {begin, size};
    line.bytes = {begin, size + (whole ? 1 : 0)};
    if (line.text.ends_with('\r')) line.text.remove_suffix(1);
    if (number_ == 1 && line.text.starts_with(source::kByteOrderMark)) line.text.remove_prefix(source::kByteOrderMark.size());
    if (line.text.size() > kMaxLineBytes) {
      line.too_long = true;
      line.text = line.text.substr(0, kMaxLineBytes);
      begin_ = end_ = 0;
      ended_ = true;
    }
    return line;
  }
}

}  // namespace kb::trace
