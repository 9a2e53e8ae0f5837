// Reads the main file and all files that it imports, each once and before those that import it.
#include <algorithm>
#include <filesystem>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/model/model.h"
#include "compiler/model/near_files.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

constexpr std::size_t kMaxFiles = 10'000;
constexpr std::size_t kMaxImportDepth = 64;

std::string folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

std::string joined(std::string_view folder, std::string_view path) {
  if (path.starts_with('/') || folder.empty()) return std::string(path);
  return std::string(folder) + (folder.ends_with('/') ? "" : "/") + std::string(path);
}

/// A file whose imports are being read.
struct Open {
  syntax::Tree tree;
  std::size_t next = 0;        ///< statement to look at
  std::string folder;          ///< with the slash at its end
  std::string name;            ///< canonical
  source::Span import_span;    ///< in the file that imports it; unknown for the main file
};

class Loader {
 public:
  Loader(std::string_view library, const source::FileSystem& files, source::Sources& sources,
         diagnostics::Diagnostics& diagnostics)
      : library_(library), files_(files), sources_(sources), diagnostics_(diagnostics) {}

  Forest run(std::string_view path) {
    open(std::string(path), {}, false);
    while (!stack_.empty()) {
      if (const auto next = next_import()) {
        follow(*next);
        continue;
      }
      state_[stack_.back().name] = State::kDone;
      forest_.trees.push_back(std::move(stack_.back().tree));
      stack_.pop_back();
    }
    return std::move(forest_);
  }

 private:
  enum class State : std::uint8_t { kOpen, kDone, kUnreadable };

  std::optional<syntax::Import> next_import() {
    Open& top = stack_.back();
    while (top.next < top.tree.statements.size()) {
      const auto& node = top.tree.statements[top.next++].node;
      if (const auto* import = std::get_if<syntax::Import>(&node)) return *import;
    }
    return std::nullopt;
  }

  void follow(const syntax::Import& import) {
    const std::string_view written = sources_.text(import.path_span);
    const bool whole = !import.quoted || (written.size() > 1 && written.back() == '"');
    if (!whole || (!import.quoted && import.path.empty())) {   // which has been reported
      forest_.all_imports = false;
      return;
    }
    if (import.path.empty()) {
      refuse(Kind::kImportNotFound, import.path_span, {import.path, "it names no file"});
      return;
    }
    if (import.quoted) return open(joined(stack_.back().folder, import.path), import.path_span, in_library(), import.path);
    if (!import.path.starts_with("std.")) {
      return report_unquoted(import);
    }
    std::string path(import.path);
    std::replace(path.begin(), path.end(), '.', '/');
    open(joined(library_, path + ".kb"), import.path_span, true, import.path);
  }

  void report_unquoted(const syntax::Import& import) {
    std::string path(import.path);
    if (path.ends_with(".kb")) path.resize(path.size() - 3);
    const std::string dotted = "std." + path;
    std::replace(path.begin(), path.end(), '.', '/');
    const bool standard = files_.read(joined(library_, "std/" + path + ".kb")).bytes.has_value();
    refuse(Kind::kImportUnquoted, import.path_span, {path}).suggest(standard ? std::optional(dotted) : std::nullopt);
  }

  /// Reports that a file is not read.
  diagnostics::Builder refuse(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
    forest_.all_imports = false;
    return diagnostics_.report(kind, at, arguments);
  }

  /// Whether the file imports, directly or not, the file that is being read.
  [[nodiscard]] bool is_open(const std::string& name) const {
    const auto known = state_.find(name);
    return known != state_.end() && known->second == State::kOpen;
  }
  /// Whether the file being read belongs to the library; then so do its imports.
  [[nodiscard]] bool in_library() const { return sources_.standard(stack_.back().tree.file); }

  void open(std::string path, source::Span at, bool standard, std::string_view written = {}) {
    const std::string name = files_.canonical(path);
    if (is_open(name)) return report_cycle(name, at, written);
    if (state_.contains(name)) return;
    if (state_.size() >= kMaxFiles) {
      if (!std::exchange(said_too_many_, true)) refuse(Kind::kTooManyFiles, at, {std::to_string(kMaxFiles)});
      return;
    }
    if (stack_.size() > kMaxImportDepth) {  // the main file counts as well, but is no import
      refuse(Kind::kImportsTooDeep, at, {std::to_string(kMaxImportDepth)});
      return;
    }
    source::FileSystem::Result result = files_.read(path);
    if (!result.bytes) {
      state_[name] = State::kUnreadable;
      return report_unreadable(path, at, standard, written, result);
    }
    state_[name] = State::kOpen;
    if (stack_.empty()) main_folder_ = folder_of(path);
    const source::FileId file = sources_.add(path, std::move(*result.bytes), standard, label_of(path, standard), at);
    stack_.push_back({syntax::parse(sources_, file, diagnostics_), 0, folder_of(path), name, at});
  }

  /// `std/road.kb`, or the path from the main file's folder, so that outputs name no folders of this machine. Outputs have it within a
  /// line, also in comments of C++, so it has no line breaks.
  [[nodiscard]] std::string label_of(const std::string& path, bool standard) const {
    const std::string& base = standard ? library_ : main_folder_;
    return diagnostics::visible(std::filesystem::path(path).lexically_relative(base.empty() ? "." : base).generic_string());
  }

  void report_unreadable(const std::string& path, source::Span at, bool standard, std::string_view written,
                         const source::FileSystem::Result& result) {
    if (result.too_large) {
      refuse(Kind::kFileTooLarge, at, {path, std::to_string(source::kMaxFileBytes >> 20)});
      return;
    }
    if (!at.known()) {
      refuse(Kind::kCannotRead, at, {path, result.error}).suggest(near_file(path, files_));
      return;
    }
    auto message = refuse(Kind::kImportNotFound, at, {written, result.error});
    const auto better = meant(path, written);
    const bool no_library = standard && !better && files_.read(joined(library_, "std")).error == result.error;   // folder and file are missing
    if (no_library) message.note(Kind::kNameLibrary, {}, {library_});
    else message.note(Kind::kLookedIn, {}, {path}).suggest(better);
  }

  /// A file that exists and that the user may have meant by `path`, as the user would write it. Tries up to a thousand names.
  [[nodiscard]] std::optional<std::string> meant(const std::string& path, std::string_view written) const {
    if (diagnostics_.full()) return std::nullopt;
    if (written.find('\\') != written.npos) return meant_by_slashes(written);
    const auto better = near_file(path, files_);
    if (better && !is_open(files_.canonical(*better))) return as_written(*better, path, written);   // a file cannot import itself
    if (path.ends_with("/kb.kb") && files_.read(path.substr(0, path.size() - 6) + ".kb").bytes) {
      return std::string(written.substr(0, written.size() - 3));
    }
    return without_quotes(written);
  }

  /// The same for a path as on Windows.
  [[nodiscard]] std::optional<std::string> meant_by_slashes(std::string_view written) const {
    std::string slashed(written);
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const std::string path = joined(stack_.back().folder, slashed);
    if (!files_.read(path).bytes) return meant(path, slashed);
    return is_open(files_.canonical(path)) ? std::nullopt : std::optional(slashed);
  }

  /// How a file of the standard library is imported, for users who write `"std.road"` or `"std/road.kb"`.
  [[nodiscard]] std::optional<std::string> without_quotes(std::string_view written) const {
    std::string path(written.ends_with(".kb") ? written.substr(0, written.size() - 3) : written);
    std::replace(path.begin(), path.end(), '.', '/');
    if (!path.starts_with("std/") || !files_.read(joined(library_, path + ".kb")).bytes) return std::nullopt;
    std::replace(path.begin(), path.end(), '/', '.');
    return "import " + path;
  }

  /// What the user wrote, with the last part replaced: `better` differs from `path` only there.
  static std::string as_written(const std::string& better, const std::string& path, std::string_view written) {
    const std::size_t kept = folder_of(path).size();
    const bool dotted = written.starts_with("std.") && !written.ends_with(".kb");
    const std::size_t cut = dotted ? written.rfind('.') + 1 : folder_of(written).size();
    std::string last = better.substr(kept);
    if (dotted && last.ends_with(".kb")) last.resize(last.size() - 3);
    return std::string(written.substr(0, cut)) + last;
  }

  void report_cycle(const std::string& name, source::Span at, std::string_view written) {
    auto builder = diagnostics_.report(Kind::kImportCycle, at, {written});
    bool inside = false;
    for (const Open& file : stack_) {
      if (inside) builder.note(Kind::kImportedHere, file.import_span);
      inside = inside || file.name == name;
    }
  }

  std::string library_, main_folder_;
  const source::FileSystem& files_;
  source::Sources& sources_;
  diagnostics::Diagnostics& diagnostics_;
  Forest forest_;
  std::vector<Open> stack_;
  std::unordered_map<std::string, State> state_;  // by canonical name; looked up, never iterated
  bool said_too_many_ = false;
};

}  // namespace

Forest load(std::string_view path, std::string_view library, const source::FileSystem& files, source::Sources& sources,
            diagnostics::Diagnostics& diagnostics) {
  return Loader(library, files, sources, diagnostics).run(path);
}

}  // namespace kb::model
