#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "compiler/source/reason.h"
#include "compiler/source/source.h"

namespace kb::source {
namespace {

constexpr std::size_t kPipeBytes = std::size_t{64} * 1024;

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

/// Whether the path is of a file that whoever started this process has opened for it: `<(...)` of a shell is `/dev/fd/63`.
bool is_handed_over(std::string_view path) { return path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/") || path == "/dev/stdin"; }

std::string normal(std::string_view path) { return std::filesystem::path(path).lexically_normal().string(); }

}  // namespace

FileSystem::Result RealFileSystem::read(std::string_view path) const {
  const std::string name(path);
  if (name.find('\0') != std::string::npos) return {std::nullopt, "the name holds a NUL byte"};
  Descriptor file{::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // O_NONBLOCK: a FIFO must not hang us
  if (file.fd < 0) return {std::nullopt, reason(errno)};
  struct stat info {};
  if (::fstat(file.fd, &info) != 0) return {std::nullopt, reason(errno)};
  if (S_ISDIR(info.st_mode)) return {std::nullopt, reason(EISDIR)};
  const bool pipe = S_ISFIFO(info.st_mode) && is_handed_over(path);   // it has somebody who writes
  if (!S_ISREG(info.st_mode) && !pipe) return {std::nullopt, "is not a regular file"};
  if (pipe && ::fcntl(file.fd, F_SETFL, 0) != 0) return {std::nullopt, reason(errno)};   // no more O_NONBLOCK: wait for what comes
  if (static_cast<std::uintmax_t>(info.st_size) > kMaxFileBytes) return {std::nullopt, "is too large", true};
  std::string bytes;
  bytes.resize(pipe ? kPipeBytes : static_cast<std::size_t>(info.st_size) + 1);  // one byte more, to notice if the file grows
  std::size_t length = 0;
  while (length < bytes.size()) {
    const ssize_t got = ::read(file.fd, bytes.data() + length, bytes.size() - length);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return {std::nullopt, reason(errno)};
    if (got == 0) break;
    length += static_cast<std::size_t>(got);
    if (length == bytes.size()) bytes.resize(bytes.size() * 2);
    if (length > kMaxFileBytes) return {std::nullopt, "is too large", true};
  }
  bytes.resize(length);
  return {std::move(bytes), {}};
}

std::string RealFileSystem::canonical(std::string_view path) const {
  std::error_code error;
  const auto real = std::filesystem::weakly_canonical(std::filesystem::path(path), error);
  return error ? normal(path) : real.string();
}

void MemoryFileSystem::add(std::string path, std::string bytes) {
  files_.emplace_back(normal(path), std::move(bytes));
}

FileSystem::Result MemoryFileSystem::read(std::string_view path) const {
  const std::string name = normal(path);
  for (const auto& [known, bytes] : files_) {
    if (known != name) continue;
    if (bytes.size() > kMaxFileBytes) return {std::nullopt, "is too large", true};
    return {bytes, {}};
  }
  return {std::nullopt, reason(ENOENT)};
}

std::string MemoryFileSystem::canonical(std::string_view path) const { return normal(path); }

}  // namespace kb::source
