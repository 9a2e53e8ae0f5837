#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "compiler/source/reason.h"
#include "compiler/source/source.h"

namespace kb::source {
namespace {

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

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
  if (!S_ISREG(info.st_mode)) return {std::nullopt, "is not a regular file"};
  if (static_cast<std::uintmax_t>(info.st_size) > kMaxFileBytes) return {std::nullopt, "is too large", true};
  std::string bytes;
  bytes.resize(static_cast<std::size_t>(info.st_size) + 1);  // one byte more, to notice if the file grows
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
