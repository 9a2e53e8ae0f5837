#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

std::vector<std::string> loaded(const Known& known) {
  std::vector<std::string> out;
  for (const syntax::Tree& tree : known.forest().trees) out.emplace_back(known.sources().path(tree.file));
  return out;
}

TEST(Load, ImportsStandBeforeImportersAndOnce) {
  const Known known("import \"a.kb\"\nimport \"b.kb\"\n", {{"a.kb", "import \"sub/c.kb\"\n"}, {"b.kb", "import \"sub/../sub/c.kb\"\n"}, {"sub/c.kb", "fact C\n"}});
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(loaded(known), (std::vector<std::string>{"sub/c.kb", "a.kb", "b.kb", "main.kb"}));
}

TEST(Load, FilesAreFoundBesideTheFileThatImportsThem) {
  const Known known("import \"sub/c.kb\"\n", {{"sub/c.kb", "import \"d.kb\"\n"}, {"sub/d.kb", "fact D\n"}});
  EXPECT_EQ(known.said(), "");
  EXPECT_NE(known.cell("D"), nullptr);
}

TEST(Load, FilesOfTheLibraryAreMarkedAsStandard) {
  const Known known("import std.basics\n");
  EXPECT_TRUE(known.sources().standard(known.forest().trees.front().file));
}

TEST(Load, ACycleIsShownFromFileToFile) {
  const Known known("import \"a.kb\"\n", {{"a.kb", "import \"b.kb\"\n"}, {"b.kb", "fact B import \"a.kb\"\n"}});
  EXPECT_EQ(known.said(), "b.kb:1:15: KB0903 `a.kb` imports itself\n  a.kb:1:8: imported here\n");
  EXPECT_NE(known.cell("B"), nullptr);
}

TEST(Load, AMissingPackageIsSuggested) {
  const Known known("import std.navigatoin\n");
  EXPECT_EQ(known.said(), "main.kb:1:8: KB0902 cannot import `std.navigatoin`: no such file -> std.navigation\n  -: looked for `library/std/navigatoin.kb`\n");
}

TEST(Load, AMissingFileIsSuggestedAsItWasWritten) {
  const Known known("import \"sub/mapp.kb\"\nimport \"sub/map\"\n", {{"sub/map.kb", ""}});
  EXPECT_NE(known.said().find("-> sub/map.kb\n  -: looked for `sub/mapp.kb`"), std::string::npos) << known.said();
  EXPECT_NE(known.said().find("-> sub/map.kb\n  -: looked for `sub/map`"), std::string::npos) << known.said();
}

TEST(Load, AFileThatIsMissingIsReportedOnce) {
  const Known known("import \"x.kb\"\nimport \"x.kb\"\n");
  EXPECT_EQ(std::count(known.said().begin(), known.said().end(), '\n'), 2);
}

/// Knows the main file only, and counts how often it is asked.
class Counting final : public source::FileSystem {
 public:
  explicit Counting(int missing) {
    for (int i = 0; i < missing; ++i) main_ += "import \"missing" + std::to_string(i) + ".kb\"\n";
  }
  [[nodiscard]] Result read(std::string_view path) const override {
    ++reads;
    return path == "main.kb" ? Result{main_, {}} : Result{std::nullopt, "no such file"};
  }
  [[nodiscard]] std::string canonical(std::string_view path) const override { return std::string(path); }
  mutable std::size_t reads = 0;

 private:
  std::string main_;
};

std::size_t reads_for(int missing) {
  const Counting files(missing);
  source::Sources sources;
  Listener listener(sources);
  diagnostics::Diagnostics diagnostics(sources, listener);
  (void)load("main.kb", "library", files, sources, diagnostics);
  return files.reads;
}

TEST(Load, NoNameIsSoughtForAnErrorThatIsNotShown) { EXPECT_EQ(reads_for(400), reads_for(300) + 100); }

TEST(Load, ImportsMayNotNestWithoutEnd) {
  std::vector<std::pair<std::string, std::string>> files;
  for (int i = 0; i < 70; ++i) files.emplace_back("f" + std::to_string(i) + ".kb", "import \"f" + std::to_string(i + 1) + ".kb\"\n");
  const Known known("import \"f0.kb\"\n", files);
  EXPECT_TRUE(known.said_only(Kind::kImportsTooDeep)) << known.said();
}

TEST(Load, OnlyTheLibraryIsImportedByName) {
  const Known known("import mine.rules\n");
  EXPECT_EQ(known.said(), "main.kb:1:8: KB0912 only the standard library is imported by name, as in `import std.navigation`; a file of your own is "
                          "`import \"mine/rules.kb\"`\n");
}

}  // namespace
}  // namespace kb::model::testing
