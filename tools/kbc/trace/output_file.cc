#include "tools/kbc/trace/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "compiler/source/reason.h"

namespace kb::trace {

using source::reason;

constexpr std::size_t kOutputBytes = std::size_t{64} * 1024;

OutputFile::~OutputFile() {
  if (file_ > STDERR_FILENO) ::close(file_);
  if (!temporary_.empty() && !keep_) ::unlink(temporary_.c_str());
  if (!old_.empty()) ::unlink(old_.c_str());
}

bool OutputFile::fail(int code) {
  if (error_.empty()) error_ = reason(code);
  return false;
}

std::string led_to(std::filesystem::path path) {
  std::error_code failed;
  if (auto real = std::filesystem::canonical(path, failed); !failed) return real.string();
  if (std::filesystem::exists(path, failed)) return path.string();   // /dev/stdout leads to a pipe, which has no path
  constexpr int kMostLinks = 40;   // as Linux
  for (int links = 0; links < kMostLinks; ++links) {
    const auto next = std::filesystem::read_symlink(path, failed);
    if (failed) return path.string();
    path = path.parent_path() / next;
  }
  return {};
}

bool OutputFile::open(const std::string& path) {
  if (path == "-") {
    file_ = STDOUT_FILENO;
    return true;
  }
  target_ = led_to(path);
  if (target_.empty()) return fail(ELOOP);
  struct ::stat about {};
  const bool exists = ::stat(target_.c_str(), &about) == 0;
  if (exists && S_ISDIR(about.st_mode)) return fail(EISDIR);
  if (exists && ::access(target_.c_str(), W_OK) != 0) return fail(errno);
  if (!exists || S_ISREG(about.st_mode)) return open_beside(exists, about.st_mode);
  file_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  return file_ >= 0 || fail(errno);
}

/// The umask: rights that new files must not have. It can be read only by changing it, which other threads must not see.
static ::mode_t forbidden() {
  static const ::mode_t mask = [] {
    const ::mode_t before = ::umask(0);
    ::umask(before);
    return before;
  }();
  return mask;
}

constexpr std::string_view kRandom = "XXXXXX";   // in temporary names, behind a point; mkostemp replaces it

bool is_left_of(std::string_view file, std::string_view name) {
  if (name.size() != file.size() + 1 + kRandom.size() || !name.starts_with(file) || name[file.size()] != '.') return false;
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  const std::string_view random = name.substr(file.size() + 1);
  return !std::ranges::all_of(random, small) && std::ranges::all_of(random, [&](char c) { return small(c) || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

// Opens a file beside the target, so that it can be moved there, with the rights of the old file, or those of any new file (mkostemp
// makes it private).
bool OutputFile::open_beside(bool exists, unsigned mode) {
  is_new_ = !exists;
  temporary_ = target_ + "." + std::string(kRandom);
  file_ = ::mkostemp(temporary_.data(), O_CLOEXEC | O_APPEND);   // a file that is cut while it grows, as logs are rotated, goes on at its new end
  if (file_ < 0) {
    temporary_.clear();
    if (errno != ENOENT) return fail(errno);
    error_ = "there is no such folder";
    return false;
  }
  // FAT and other file systems have no rights and refuse this; the file can be written all the same.
  static_cast<void>(::fchmod(file_, exists ? (mode & 07777u) : (0666u & ~forbidden())));
  return true;
}

void OutputFile::write(std::string_view bytes) {
  if (failed()) return;
  if (buffer_.size() + bytes.size() >= kOutputBytes) {
    flush();
    if (bytes.size() >= kOutputBytes) return put(bytes);
  }
  buffer_.append(bytes);
}

void OutputFile::put(std::string_view bytes) {
  while (!bytes.empty() && !failed()) {
    const ::ssize_t done = ::write(file_, bytes.data(), bytes.size());
    if (done >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(done));
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

bool OutputFile::flush() {
  put(buffer_);
  buffer_.clear();
  return !failed();
}

bool OutputFile::reopen(std::string& refused) {
  const bool beside = !temporary_.empty();
  if (!(beside || moved_) || !flush()) return false;
  const bool moves = beside && ::rename(temporary_.c_str(), target_.c_str()) == 0;
  if (beside && !moves && errno != ENOENT) return refused = source::reason(errno), false;   // else somebody has moved it by that name
  if (!moves && !open_again(beside)) return refused = source::reason(errno), false;
  temporary_.clear();
  moved_ = true;
  struct ::stat about {};
  return !moves && ::fstat(file_, &about) == 0 && about.st_size == 0;
}

// With the rights of the file that was moved away. False (errno) if that cannot be; a pipe in its place would wait for a reader.
bool OutputFile::open_again(bool cut) {
  struct ::stat old {}, about {};
  const unsigned mode = ::fstat(file_, &old) == 0 ? old.st_mode & 07777u : 0666u;
  const int file = ::open(target_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | (cut ? O_TRUNC : 0), mode);
  if (file < 0) return false;
  if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
    ::close(file);
    errno = EINVAL;
    return false;
  }
  if (about.st_size == 0) static_cast<void>(::fchmod(file, mode));
  ::close(std::exchange(file_, file));
  return true;
}

bool OutputFile::stage() {
  if (staged_ || file_ < 0) return staged_ && !failed();
  staged_ = true;
  flush();
  if ((!temporary_.empty() || moved_) && !failed() && ::fsync(file_) != 0) fail(errno);
  const int file = std::exchange(file_, -1);
  if (file > STDERR_FILENO && ::close(file) != 0) fail(errno);
  return !failed();
}

bool OutputFile::commit() {
  if (!stage()) return false;
  if (temporary_.empty()) return true;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return fail(errno);
  temporary_.clear();
  moved_ = true;
  return true;
}

// Not by moving it away: then there would be no file for a moment.
void OutputFile::keep_old() {
  if (is_new_ || temporary_.empty()) return;
  std::string name = target_ + "." + std::string(kRandom);
  const int free = ::mkostemp(name.data(), O_CLOEXEC);
  if (free < 0) return;
  ::close(free);
  ::unlink(name.c_str());
  if (::link(target_.c_str(), name.c_str()) == 0) old_ = std::move(name);
}

void OutputFile::bring_back_old() {
  if (!moved_) return;
  if (is_new_) ::unlink(target_.c_str());
  else if (!old_.empty()) static_cast<void>(::rename(old_.c_str(), target_.c_str()));
  old_.clear();   // if that is refused, too, the old contents stay under their other name
}

std::optional<std::size_t> OutputFile::commit_all(std::span<OutputFile> files) {
  const auto is_open = [](const OutputFile& file) { return file.staged_ || file.file_ >= 0; };
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!is_open(files[i])) continue;
    if (files.size() > 1) files[i].keep_old();
    if (files[i].commit()) continue;
    for (OutputFile& before : files.first(i)) before.bring_back_old();
    return i;
  }
  return std::nullopt;
}

std::optional<std::string> make_folders(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return reason(error.value());
  if (!std::filesystem::is_directory(path, error)) return "is not a directory";
  return std::nullopt;
}

}  // namespace kb::trace
