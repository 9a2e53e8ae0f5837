// kbc fmt: the canonical layout.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/reason.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/folders.h"

namespace kb::cli {
namespace {

namespace fs = std::filesystem;
using diagnostics::Kind;

struct FmtOptions {
  std::vector<std::string> paths;
  bool check = false;
  bool in_place = false;
};

// Collects all .kb files in a folder and below, in order, except in hidden folders; none (reported) if a folder cannot be read.
void collect(const std::string& folder, std::vector<std::string>& files, Session& session) {
  trace::Listing found = trace::files_below(folder);
  if (found.why) return session.report(Kind::kFolderUnreadable, {found.unreadable, source::reason(found.why.value())});
  std::erase_if(found.files, [](const std::string& name) { return !name.ends_with(".kb"); });
  if (found.files.empty()) session.report(Kind::kNoSourceFiles, {folder});
  files.insert(files.end(), found.files.begin(), found.files.end());
}

std::vector<std::string> expand(const std::vector<std::string>& paths, Session& session) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (path != "-" && fs::is_directory(path, ignored))
      collect(path, files, session);
    else
      files.push_back(path);
  }
  return files;
}

std::string without_returns(std::string_view text) {
  std::string out(text);
  std::erase(out, '\r');
  return out;
}

void format_one(const std::string& path, const FmtOptions& options, Session& session) {
  if (!session.is_source(path)) return;
  source::Sources sources;
  const auto file = session.open(path, sources);
  if (!file) return;
  auto diagnostics = session.diagnostics(sources);
  static_cast<void>(syntax::parse(sources, *file, diagnostics));
  if (diagnostics.failed()) {
    diagnostics.report(Kind::kNotFormattable, {}, {path});
    return;
  }
  std::string laid_out = syntax::format(sources, *file);
  const bool same = laid_out == sources.bytes(*file);
  if (options.check) {
    const bool only_line_ends = without_returns(laid_out) == without_returns(sources.bytes(*file));
    if (!same) diagnostics.report(only_line_ends ? Kind::kMixedLineEnds : Kind::kNotFormatted, {}, {path});
  } else if (!options.in_place || path == "-") {
    session.print(laid_out);
  } else if (!same && session.write_files({{.path = path, .bytes = std::move(laid_out), .in_place = true}})) {
    session.remark("laid out " + path);
  }
}

}  // namespace

Run setup_fmt(CLI::App& app) {
  auto options = std::make_shared<FmtOptions>();
  app.add_option("FILE", options->paths, "Files and folders; - for standard input")->required();
  auto* check =
      app.add_flag("--check", options->check, "Change nothing; fail if a file is not in the canonical layout");
  app.add_flag("-i,--in-place", options->in_place, "Write the files instead of standard output")->excludes(check);
  return [options](Session& session) {
    for (const std::string& file : expand(options->paths, session)) format_one(file, *options, session);
    return session.exit_code();
  };
}

}  // namespace kb::cli
