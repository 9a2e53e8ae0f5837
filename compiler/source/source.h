// Source files as values: their bytes, where a byte stands, and where files come from.
//
// Everything after this folder speaks of places as `Span`s (a file and two byte offsets); lines and columns are
// computed only when something is printed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::source {

/// Index of a file in `Sources`, in order of loading.
enum class FileId : std::uint32_t { kNone = 0xFFFFFFFFu };

/// The bytes [begin, end) of one file. `file == kNone` is a place that no file has (a generated rule, the command line).
struct Span {
  FileId file = FileId::kNone;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] bool known() const { return file != FileId::kNone; }
  friend bool operator==(const Span&, const Span&) = default;
};

/// The smallest span that holds both; both must lie in the same file (else `a` is returned).
[[nodiscard]] Span join(Span a, Span b);

/// A place for people. Lines and columns begin at 1; a column counts Unicode code points, not bytes.
struct Location {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

/// Largest file that is read; a larger one is refused by name (KB0801).
inline constexpr std::size_t kMaxFileBytes = 128u << 20;

/// All files of one compilation. Owns their bytes for as long as it lives: every `std::string_view` in a syntax tree
/// points in here. Adding a file never moves the bytes of another.
class Sources {
 public:
  /// Takes `bytes` under the name `path` (as it will be printed). A UTF-8 byte-order mark is kept; the lexer skips it.
  /// `standard` marks a file of the standard library: its own warnings are not shown unless asked for.
  /// `label` is its name in everything made from it (rule origins, emitted code). It must be the same on every machine, so it
  /// contains no local folder; the default is `path`.
  /// `imported_at` is the import that it was read for; unknown for a main file.
  FileId add(std::string path, std::string bytes, bool standard = false, std::string label = {}, Span imported_at = {});
  /// Takes some lines of a file that is not held as a whole; the first of them has that number there.
  FileId add_lines(std::string path, std::string bytes, std::uint32_t first);

  [[nodiscard]] std::size_t size() const { return files_.size(); }
  [[nodiscard]] std::string_view path(FileId file) const;
  [[nodiscard]] std::string_view label(FileId file) const;
  [[nodiscard]] std::string_view bytes(FileId file) const;
  [[nodiscard]] bool standard(FileId file) const;
  /// The user's import that brought in this file of the standard library, directly or through another; unknown for other files.
  [[nodiscard]] Span brought_in_at(FileId file) const;
  /// The bytes of a span; empty for an unknown place.
  [[nodiscard]] std::string_view text(Span span) const;
  /// Line and column of a byte; a byte-order mark takes no column. O(log lines).
  [[nodiscard]] Location locate(FileId file, std::uint32_t offset) const;
  /// The inverse: the byte at a line and column, or the end of the line or file if that is shorter. O(log lines).
  [[nodiscard]] std::uint32_t offset_of(FileId file, Location place) const;
  /// The whole line (without its line break) that holds `offset`, and where it begins.
  struct Line { std::string_view text; std::uint32_t begin = 0; };
  [[nodiscard]] Line line_of(FileId file, std::uint32_t offset) const;
  /// `file:line:column` of the beginning of `span`, or "-" for an unknown place.
  [[nodiscard]] std::string describe(Span span) const;
  /// The same with the file's label: for products, not for messages.
  [[nodiscard]] std::string origin(Span span) const;

 private:
  struct File {
    std::string path;
    std::string label;
    std::string bytes;
    std::vector<std::uint32_t> line_begins;
    std::vector<std::uint32_t> code_points_before;   // by piece; see note [columns of long lines]
    bool standard = false;
    Span imported_at;
    std::uint32_t first_line = 1;
    [[nodiscard]] std::uint32_t code_points_in(std::size_t begin, std::size_t end) const;
    [[nodiscard]] std::size_t after_code_points(std::size_t begin, std::size_t end, std::size_t count) const;
  };
  [[nodiscard]] const File& at(FileId file) const;
  std::vector<std::unique_ptr<File>> files_;
};

/// Where files come from. The compiler reads only through this, so that tests and fuzzers run in memory.
class FileSystem {
 public:
  virtual ~FileSystem() = default;
  struct Result {
    std::optional<std::string> bytes;  ///< nothing if it could not be read
    std::string error;                 ///< why not, in words ("no such file", "is a directory", "permission denied", ...)
    bool too_large = false;            ///< over kMaxFileBytes: nothing was read
  };
  [[nodiscard]] virtual Result read(std::string_view path) const = 0;
  /// One name for one file, however its path is written ("a/../b.kb" and "b.kb"): so that each file is imported once.
  [[nodiscard]] virtual std::string canonical(std::string_view path) const = 0;
};

/// The files of this machine.
class RealFileSystem final : public FileSystem {
 public:
  [[nodiscard]] Result read(std::string_view path) const override;
  [[nodiscard]] std::string canonical(std::string_view path) const override;
};

/// One file in memory that takes precedence over those of another file system. Both, and the bytes, must outlive it.
class OneFileMore final : public FileSystem {
 public:
  OneFileMore(std::string_view path, std::string_view bytes, const FileSystem& others) : path_(path), bytes_(bytes), others_(others) {}
  [[nodiscard]] Result read(std::string_view path) const override {
    return path == path_ ? Result{std::string(bytes_), {}} : others_.read(path);
  }
  [[nodiscard]] std::string canonical(std::string_view path) const override {
    return path == path_ ? std::string(path) : others_.canonical(path);
  }

 private:
  std::string_view path_, bytes_;
  const FileSystem& others_;
};

/// Files that exist only in memory, by exact (normalised) path; for tests and fuzzing.
class MemoryFileSystem final : public FileSystem {
 public:
  void add(std::string path, std::string bytes);
  [[nodiscard]] Result read(std::string_view path) const override;
  [[nodiscard]] std::string canonical(std::string_view path) const override;

 private:
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace kb::source
