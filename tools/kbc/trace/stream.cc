#include "tools/kbc/trace/stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace kb::trace {
namespace {

constexpr std::size_t kInputBytes = std::size_t{256} * 1024;
constexpr std::size_t kOutputBytes = std::size_t{64} * 1024;

// Not strerror: its words depend on the locale, and what we print may not.
std::string reason(int code) {
  switch (code) {
    case ENOENT: return "no such file";
    case ENOTDIR: return "a part of the path is not a folder";
    case EISDIR: return "is a folder";
    case EACCES:
    case EPERM: return "permission denied";
    case ENOSPC: return "no space left on the disk";
    case EDQUOT: return "the quota of the disk is used up";
    case EFBIG: return "the file would be too large";
    case EROFS: return "the disk is read-only";
    case EPIPE: return "the reader of the pipe has gone";
    case ENAMETOOLONG: return "the name is too long";
    case ELOOP: return "too many symbolic links";
    case EMFILE:
    case ENFILE: return "too many open files";
    default: return "error " + std::to_string(code);
  }
}

class FileStream final : public ByteStream {
 public:
  FileStream(int file, bool owned) : file_(file), owned_(owned) {}
  FileStream(const FileStream&) = delete;
  FileStream& operator=(const FileStream&) = delete;
  ~FileStream() override {
    if (owned_) ::close(file_);
  }

  std::size_t read(char* to, std::size_t size) override {
    for (;;) {
      const ::ssize_t got = ::read(file_, to, size);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) {
        error_ = reason(errno);
        return 0;
      }
    }
  }
  [[nodiscard]] std::string error() const override { return error_; }

 private:
  int file_;
  bool owned_;
  std::string error_;
};

}  // namespace

std::unique_ptr<ByteStream> open_stream(const std::string& path, std::string& error) {
  if (path == "-") return std::make_unique<FileStream>(STDIN_FILENO, false);
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
  return std::make_unique<FileStream>(file, true);
}

std::size_t MemoryStream::read(char* to, std::size_t size) {
  const std::size_t n = std::min({size, chunk_, rest_.size()});
  if (n > 0) std::memcpy(to, rest_.data(), n);
  rest_.remove_prefix(n);
  return n;
}

// Moves what is left to the front, makes room and reads once. False if there is nothing more.
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

    Line line{.text = {}, .number = ++number_};
    const std::size_t size = whole ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : left;
    begin = buffer_.data() + begin_;  // `fill` may have moved it
    begin_ += size + (whole ? 1 : 0);
    line.text = {begin, size};
    if (line.text.ends_with('\r')) line.text.remove_suffix(1);
    if (number_ == 1 && line.text.starts_with("\xEF\xBB\xBF")) line.text.remove_prefix(3);
    if (line.text.size() > kMaxLineBytes) {
      line.too_long = true;
      line.text = line.text.substr(0, kMaxLineBytes);
      begin_ = end_ = 0;
      ended_ = true;
    }
    return line;
  }
}

OutputFile::~OutputFile() {
  if (file_ > STDERR_FILENO) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::fail(int code) {
  if (error_.empty()) error_ = reason(code);
}

bool OutputFile::open(const std::string& path) {
  buffer_.reserve(kOutputBytes);
  if (path == "-") {
    file_ = STDOUT_FILENO;
    return true;
  }
  target_ = path;
  std::error_code ignored;
  if (const auto real = std::filesystem::canonical(path, ignored); !ignored) target_ = real.string();
  struct ::stat about {};
  const bool exists = ::stat(target_.c_str(), &about) == 0;
  if (exists && S_ISDIR(about.st_mode)) {
    fail(EISDIR);
    return false;
  }
  if (exists && !S_ISREG(about.st_mode)) {
    file_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail(errno);
    return file_ >= 0;
  }
  if (exists && ::access(target_.c_str(), W_OK) != 0) {
    fail(errno);
    return false;
  }
  temporary_ = target_ + ".XXXXXX";
  file_ = ::mkostemp(temporary_.data(), O_CLOEXEC);
  if (file_ < 0) {
    fail(errno);
    temporary_.clear();
    return false;
  }
  // mkostemp makes it private; the new file gets the rights of the old one, or those that any new file would get.
  const ::mode_t mask = ::umask(0);
  ::umask(mask);
  const ::mode_t mode = exists ? (about.st_mode & 07777u) : (0666u & ~mask);
  if (::fchmod(file_, mode) != 0) fail(errno);
  return !failed();
}

void OutputFile::write(std::string_view bytes) {
  if (failed()) return;
  buffer_.append(bytes);
  if (buffer_.size() >= kOutputBytes) flush();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty() && !failed()) {
    const ::ssize_t put = ::write(file_, rest.data(), rest.size());
    if (put >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(put));
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
  buffer_.clear();
}

bool OutputFile::commit() {
  if (file_ < 0) return false;
  flush();
  if (!temporary_.empty() && !failed() && ::fsync(file_) != 0) fail(errno);
  if (file_ > STDERR_FILENO && ::close(std::exchange(file_, -1)) != 0) fail(errno);
  if (failed() || temporary_.empty()) return !failed();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    fail(errno);
    return false;
  }
  temporary_.clear();
  return true;
}

}  // namespace kb::trace
