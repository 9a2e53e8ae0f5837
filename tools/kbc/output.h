// Files that appear whole, and together, or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kb::cli {

/// note [two phases of writing]
/// A header and a source that belong together must not be left half new when the disk is full. So each output is first
/// written beside its place and brought to disk (`stage`), which is all that a full disk can spoil; only when every
/// output is staged are they moved to their places (`commit`), which needs no room.
class StagedFile {
 public:
  explicit StagedFile(std::string path) : path_(std::move(path)) {}
  StagedFile(StagedFile&& other) noexcept;
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  StagedFile& operator=(StagedFile&&) = delete;
  /// Removes what was staged and not committed.
  ~StagedFile();

  /// False if it cannot be written; `error` says why. A symbolic link stays one; what is no regular file (a pipe,
  /// `/dev/null`) is written to directly.
  [[nodiscard]] bool stage(std::string_view bytes);
  [[nodiscard]] bool commit();
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  bool fail(int code);
  bool write_to(int file, std::string_view bytes);
  bool open_temporary(bool exists, unsigned mode);
  std::string path_, target_, temporary_, error_;
  int file_ = -1;
};

/// Why the operating system refused, in words that do not change with the locale.
[[nodiscard]] std::string reason(int error);

/// Makes the folder and those above it. Nothing if it is there now, else why not.
[[nodiscard]] std::optional<std::string> make_folders(const std::string& path);

}  // namespace kb::cli
