// Files that appear whole, and together, or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kb::trace {

/// note [two phases of writing]
/// A header and a source that belong together must not be left half new when the disk is full. So each output is first
/// written beside its place and brought to disk (`stage`), which is all that a full disk can spoil; only when every
/// output is staged are they moved to their places (`commit`), which needs no room. Until then, and for ever if anything fails,
/// what stood there before stays untouched. "-" is standard output, written as it comes.
class OutputFile {
 public:
  OutputFile() = default;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Removes what was written and not committed: see `keep`.
  ~OutputFile();

  /// False if the file cannot be made; `error` says why. Follows a symbolic link, so that the link stays one; what is
  /// no regular file (a pipe, `/dev/null`) is written to directly.
  [[nodiscard]] bool open(const std::string& path);
  /// True if what is written is not seen under its name before `commit`; false of what is written to directly.
  [[nodiscard]] bool stays_beside() const { return !temporary_.empty(); }
  /// Buffered; a failure is kept and told by `stage` and `commit`.
  void write(std::string_view bytes);
  /// What was written is in the hands of the system, so that it outlives this process if `keep` was said. False if a write has failed.
  bool flush();
  /// What is not committed is left `beside` instead of removed: of what grows for hours a part is worth more than nothing.
  void keep() { keep_ = true; }
  /// Where it is written until it is committed.
  [[nodiscard]] const std::string& beside() const { return temporary_; }
  /// Everything on disk, not yet under its name. False if any write failed (a full disk); `error` says why.
  [[nodiscard]] bool stage();
  /// Everything on disk under its name; stages it first if that was not done.
  [[nodiscard]] bool commit();
  [[nodiscard]] const std::string& error() const { return error_; }
  /// True if a write has failed: whoever produces much may stop.
  [[nodiscard]] bool failed() const { return !error_.empty(); }

 private:
  bool open_beside(bool exists, unsigned mode);
  void put(std::string_view bytes);
  bool fail(int code);
  std::string target_, temporary_, error_;
  std::string buffer_;
  int file_ = -1;
  bool staged_ = false, keep_ = false;
};

/// Makes the folder and those above it. Nothing if it is there now, else why not.
[[nodiscard]] std::optional<std::string> make_folders(const std::string& path);

}  // namespace kb::trace
