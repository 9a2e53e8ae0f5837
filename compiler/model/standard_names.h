// Finds the file of the standard library that declares an unknown name.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "compiler/syntax/tree.h"

namespace kb::model {

/// The library's files that declare something, as they are imported: `std.road`. A `FileSystem` cannot list files, so the list is kept here.
[[nodiscard]] std::span<const std::string_view> standard_files();

/// Reads the library's files when first asked, so that only a program with a mistake pays for it.
class StandardNames {
 public:
  static constexpr std::string_view kLevels = "levels";   ///< the levels are found like members of a set of this name, which is a keyword

  /// `library` is the folder that holds `std/`; `files` must outlive this.
  StandardNames(std::string_view library, const source::FileSystem& files) : library_(library), files_(files) {}

  /// `std.road`, which declares `name`; nothing if no file does.
  [[nodiscard]] std::optional<std::string_view> file_with(std::string_view name);
  /// `std.hall`, which adds `member` to the set or group `set`.
  [[nodiscard]] std::optional<std::string_view> file_with_member(std::string_view set, std::string_view member);

  /// Whether `import std.navigation` brings this file of the library.
  [[nodiscard]] bool navigation_brings(std::string_view file);
  /// `"map.kb"`, if a file of this name lies beside the file `path` and has a map or a landmark `name`.
  [[nodiscard]] std::optional<std::string> map_beside(std::string_view path, std::string_view name);

 private:
  static constexpr std::string_view kMapFile = "map.kb";   // what `kbc new` calls it

  void read();
  void add_imports(std::string_view file);
  [[nodiscard]] std::string path_of(std::string_view file) const;
  void take(const syntax::Statement& statement, std::string_view file);
  std::string library_;
  const source::FileSystem& files_;
  bool read_ = false;
  std::map<std::string, std::string_view, std::less<>> file_of_;   // by name, and by `Set.member`
  std::set<std::string, std::less<>> navigation_;                  // std.navigation, and what it imports; read when first asked for
  std::map<std::string, std::set<std::string, std::less<>>> beside_;   // by folder: the names of the map there
};

struct Draft;
struct FiniteSet;

/// Reports an unknown name with the import that brings it, else with the nearest name.
void report_unknown(Draft& draft, diagnostics::Kind kind, const syntax::Name& name, std::optional<std::string> nearest);
/// The set that lacks a member, or a group whose members are those of a set. `declared` may be unknown.
struct MembersOf { std::string_view name; source::Span declared; const FiniteSet& set; };
/// The variables that may have been meant in place of a member.
struct Variables {
  std::vector<std::string_view> names;
  std::string_view unused;   ///< one that ranges over the set and that nothing has used so far; empty if there is none
  std::string_view rule;     ///< the rule that could declare one; empty if no rule could
};
/// The same for an unknown member. The nearest name may be another member or a variable.
void report_unknown_member(Draft& draft, diagnostics::Kind kind, const syntax::Name& name, const MembersOf& of, const Variables& variables = {});

}  // namespace kb::model
