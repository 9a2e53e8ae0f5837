// Output files that appear whole and together, or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kb::trace {

/// Where a path leads over symbolic links, also if there is no file yet. Empty if it leads nowhere.
[[nodiscard]] std::string led_to(std::filesystem::path path);

/// note [two phases of writing]
/// A header and a source that belong together must not be left half new when the disk is full. So each output is first
/// written under a temporary name beside its place and brought to disk (`stage`); only this can fail for want of room. When every output
/// is staged, they are moved to their places (`commit_all`), which needs no room. Until then, and for good if anything fails, the old files
/// stay untouched. A move can still be refused, where something is mounted over the old file: then the files before it get back what they
/// were. Only a process that is killed between two moves leaves new files beside old ones. "-" is standard output, written directly.
class OutputFile {
 public:
  OutputFile() = default;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Removes what was written and not committed: see `keep`.
  ~OutputFile();

  /// False if the file cannot be made; `error` says why. Follows a symbolic link, so that the link stays one.
  /// Anything but a regular file (a pipe, `/dev/null`) is written to directly.
  [[nodiscard]] bool open(const std::string& path);
  /// Whether the contents stay hidden from the file's name until `commit`; false if it is written to directly.
  [[nodiscard]] bool stays_beside() const { return !temporary_.empty(); }
  /// Writes with a buffer; a failure is remembered and reported by `stage` and `commit`.
  void write(std::string_view bytes);
  /// Hands what was written to the system, so that it outlives this process after `keep`. False if a write has failed.
  bool flush();
  /// Leaves what is not committed `beside` instead of removing it: part of a file that grew for hours is worth keeping.
  void keep() { keep_ = true; }
  /// For a file that others move away while it grows: from now on it grows under its own name, which is opened anew. Until the first call that
  /// is a move of what was written. Does nothing to a pipe. If that name cannot be opened, `refused` says why, and the file goes on growing where
  /// it was. True if another file was opened that is empty.
  bool reopen(std::string& refused);
  /// The temporary name, until it is committed.
  [[nodiscard]] const std::string& beside() const { return temporary_; }
  /// Brings everything to disk, not yet under its name. False if any write failed (a full disk); `error` says why.
  [[nodiscard]] bool stage();
  /// Moves it to its name; stages it first if that was not done.
  [[nodiscard]] bool commit();
  /// The same for files that belong together, without those that were not opened: all are moved or none. Nothing if they are, else the
  /// place of the one that could not be. On a file system without hard links (FAT), the files moved before it stay new.
  [[nodiscard]] static std::optional<std::size_t> commit_all(std::span<OutputFile> files);
  [[nodiscard]] const std::string& error() const { return error_; }
  /// Whether a write has failed; a producer of much output may then stop.
  [[nodiscard]] bool failed() const { return !error_.empty(); }

 private:
  bool open_beside(bool exists, unsigned mode);
  bool open_again(bool cut);
  void put(std::string_view bytes);
  bool fail(int code);
  void keep_old();
  void bring_back_old();
  std::string target_, temporary_, error_;
  std::string old_;   // another name of the file that was at the target; empty if there was none, or it cannot have another
  std::string buffer_;
  int file_ = -1;
  bool staged_ = false, keep_ = false, moved_ = false, is_new_ = false;
};

/// Whether `name` is a temporary name of `file` (both without folders), as a process leaves it that is killed while it writes. One in 200 of
/// those names has small letters only; it is not taken for one, as somebody may have made a copy, `0001.csv.backup`.
[[nodiscard]] bool is_left_of(std::string_view file, std::string_view name);

/// Makes the folder and those above it. Nothing if it exists now, else why not.
[[nodiscard]] std::optional<std::string> make_folders(const std::string& path);

}  // namespace kb::trace
