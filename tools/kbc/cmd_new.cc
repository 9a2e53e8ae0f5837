// kbc new: a project that builds. Its files are those in tools/kbc/template.
#include <CLI/CLI.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/encoding.h"
#include "tools/kbc/support.h"
#include "tools/kbc/template.h"
#include "tools/kbc/trace/output_file.h"

namespace kb::cli {
namespace {

namespace fs = std::filesystem;
using diagnostics::Kind;

constexpr std::string_view kPlaceholder = "@NAME@";

std::string fill_in(std::string_view text, const std::string& name) { return boost::replace_all_copy(std::string(text), kPlaceholder, name); }

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// What `cmake --build` makes besides what a project says.
bool is_target_of_cmake(std::string_view lower) {
  constexpr std::string_view kTargets[] = {"all", "all_build", "clean", "edit_cache", "help", "install", "package", "package_source",
                                           "preinstall", "rebuild_cache", "run_tests", "test", "zero_check"};
  return std::find(std::begin(kTargets), std::end(kTargets), lower) != std::end(kTargets);
}

// Why a project cannot have this name, in which `_` stands for `-`; empty if it can. Some systems do not distinguish MAP.kb from map.kb.
std::string_view fault_of(const std::string& name) {
  const auto plain = [](char c) { return source::is_letter_or_digit(c) || c == '_'; };
  if (name.empty() || !is_letter(name[0])) return "it does not begin with a letter from `a` to `z`";
  if (!std::all_of(name.begin(), name.end(), plain)) return "it has other characters than letters from `a` to `z`, digits, `_` and `-`";
  if (name.back() == '_' || name.find("__") != std::string::npos) return "it ends in `_` or `-`, or has two of them side by side";
  const std::string lower = source::lower(name);
  if (lower == "map") return "the file `map.kb` of the project is its map";
  if (name == "sense" || name == "can_drive") return "`main.cc` of the project has this name for something else";
  if (is_target_of_cmake(lower)) return "CMake has a target of this name";
  return is_namespace(name) ? "" : "it is a word of C++, a name of its C library, or one of the namespaces `std`, `mts` and `kb`";
}

// Also of `.`.
std::string folder_name(const std::string& folder) {
  std::error_code ignored;
  return fs::weakly_canonical(folder, ignored).filename().string();
}

// The name of the project, its main file and its namespace is that of the folder.
std::string project_name(const std::string& folder) { return boost::replace_all_copy(folder_name(folder), "-", "_"); }

bool is_free(const std::string& folder) {
  std::error_code error;
  return !fs::exists(folder, error) || (fs::is_directory(folder, error) && fs::is_empty(folder, error));
}

// `path` as a word of a shell command.
std::string shell_word(const std::string& path) {
  const bool plain = std::all_of(path.begin(), path.end(), [](char c) { return source::is_letter_or_digit(c) || std::string_view("/._-+").find(c) != std::string_view::npos; });
  if (plain) return path;
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The commands to type next.
std::string next_steps(const std::string& folder, const std::string& name) {
  const std::string build = shell_word(folder + "/build");
  return "made " + folder + "; now:\n  cmake -S " + shell_word(folder) + " -B " + build + " && cmake --build " + build + "\n  kbc test " +
         shell_word(folder + "/tests") + "\n  kbc sim " + shell_word(folder + "/" + name + ".kb");
}

// Makes the folders, each after the one that contains it, and the files. If that fails (reported), no folder is left that would be refused
// next time.
bool make_files(const std::set<std::string>& folders, const std::vector<Session::OutputFile>& files, Session& session) {
  std::error_code ignored;
  const bool was_there = fs::exists(*folders.begin(), ignored);
  const bool made = std::all_of(folders.begin(), folders.end(), [&](const std::string& one) {
    const auto refused = trace::make_folders(one);
    if (refused) session.report(Kind::kCannotMakeFolder, {one, *refused});
    return !refused;
  });
  if (made && session.write_files(files)) return true;
  for (auto one = folders.rbegin(); one != folders.rend(); ++one) {
    if (!was_there || *one != *folders.begin()) fs::remove(*one, ignored);
  }
  return false;
}

int make_project(std::string folder, Session& session) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  const std::string name = project_name(folder);
  std::error_code ignored;
  if (const std::string_view fault = fault_of(name); !fault.empty())
    session.report(Kind::kBadProjectName, {folder_name(folder), fault});
  else if (!is_free(folder))
    session.report(Kind::kFolderNotEmpty, {folder, fs::is_directory(folder, ignored) ? "not empty" : "no folder"});
  if (session.exit_code() != kClean) return kErrors;

  std::vector<Session::OutputFile> files;
  std::set<std::string> folders;
  for (const TemplateFile& file : template_files()) {
    const fs::path path = fs::path(folder) / fill_in(file.path, name);
    folders.insert(path.parent_path().string());
    files.push_back({path.string(), fill_in(file.text, name)});
  }
  if (!make_files(folders, files, session)) return kErrors;
  session.remark(next_steps(folder, name));
  return session.exit_code();
}

}  // namespace

Run setup_new(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  app.add_option("DIR", *folder, "The folder to make; its name is that of the project")->required();
  return [folder](Session& session) { return make_project(*folder, session); };
}

}  // namespace kb::cli
