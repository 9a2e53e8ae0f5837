#include "tools/kbc/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace kb::cli {

std::string reason(int error) {
  switch (error) {
    case ENOENT: return "no such file or folder";
    case EACCES:
    case EPERM: return "permission denied";
    case EEXIST: return "is there already";
    case EISDIR: return "is a directory";
    case ENOTDIR: return "a part of the path is not a directory";
    case ENOSPC: return "no space left on the disk";
    case EDQUOT: return "the quota of the disk is used up";
    case EFBIG: return "is too large for the disk";
    case EROFS: return "the file system is read-only";
    case EIO: return "input/output error";
    case ELOOP: return "too many symbolic links";
    case ENAMETOOLONG: return "the name is too long";
    case EPIPE: return "nobody reads it any more";
    case EMFILE:
    case ENFILE: return "too many open files";
    default: return "error " + std::to_string(error) + " of the operating system";
  }
}

std::optional<std::string> make_folders(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return reason(error.value());
  if (!std::filesystem::is_directory(path, error)) return "is not a directory";
  return std::nullopt;
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      error_(std::move(other.error_)),
      file_(std::exchange(other.file_, -1)) {}

StagedFile::~StagedFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool StagedFile::fail(int code) {
  error_ = reason(code);
  return false;
}

bool StagedFile::write_to(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return true;
}

// Beside the target, so that it can be moved there; with the rights of the old file, or those that any new one gets.
bool StagedFile::open_temporary(bool exists, unsigned mode) {
  temporary_ = target_ + ".XXXXXX";
  file_ = ::mkostemp(temporary_.data(), O_CLOEXEC);
  if (file_ < 0) {
    temporary_.clear();
    return fail(errno);
  }
  const ::mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(file_, exists ? (mode & 07777u) : (0666u & ~mask)) != 0) return fail(errno);
  return true;
}

bool StagedFile::stage(std::string_view bytes) {
  target_ = path_;
  std::error_code ignored;
  if (const auto real = std::filesystem::canonical(path_, ignored); !ignored) target_ = real.string();
  struct stat about {};
  const bool exists = ::stat(target_.c_str(), &about) == 0;
  if (exists && S_ISDIR(about.st_mode)) return fail(EISDIR);
  if (exists && ::access(target_.c_str(), W_OK) != 0) return fail(errno);
  const bool direct = exists && !S_ISREG(about.st_mode);
  if (direct) {
    file_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) return fail(errno);
  } else if (!open_temporary(exists, about.st_mode)) {
    return false;
  }
  if (!write_to(file_, bytes)) return false;
  if (!direct && ::fsync(file_) != 0) return fail(errno);
  return ::close(std::exchange(file_, -1)) == 0 || fail(errno);
}

bool StagedFile::commit() {
  if (temporary_.empty()) return true;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return fail(errno);
  temporary_.clear();
  return true;
}

}  // namespace kb::cli
