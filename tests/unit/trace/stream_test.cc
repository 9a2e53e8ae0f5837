#include "tools/kbc/trace/stream.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace kb::trace {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class OutputFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  fs::path folder_;
};

TEST_F(OutputFileTest, appears_only_when_it_is_committed) {
  const fs::path path = folder_ / "out";
  OutputFile file;
  ASSERT_TRUE(file.open(path.string()));
  file.write("new");
  EXPECT_FALSE(fs::exists(path));
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, leaves_the_old_file_alone_if_it_is_not_committed) {
  const fs::path path = folder_ / "out";
  std::ofstream(path) << "old";
  {
    OutputFile file;
    ASSERT_TRUE(file.open(path.string()));
    file.write(std::string(1 << 20, 'x'));
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(files(), 1u) << "nothing is left behind";
}

TEST_F(OutputFileTest, keeps_the_rights_of_the_old_file_and_the_link_that_leads_there) {
  const fs::path path = folder_ / "out", link = folder_ / "link";
  std::ofstream(path) << "old";
  ::chmod(path.c_str(), 0640);
  fs::create_symlink(path, link);
  OutputFile file;
  ASSERT_TRUE(file.open(link.string()));
  file.write("new");
  ASSERT_TRUE(file.commit());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(OutputFileTest, says_why_it_cannot_be_made) {
  OutputFile in_nowhere, folder;
  EXPECT_FALSE(in_nowhere.open((folder_ / "no" / "out").string()));
  EXPECT_EQ(in_nowhere.error(), "no such file");
  EXPECT_FALSE(folder.open(folder_.string()));
  EXPECT_EQ(folder.error(), "is a folder");
}

TEST_F(OutputFileTest, says_when_the_disk_is_full) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  OutputFile file;
  ASSERT_TRUE(file.open("/dev/full"));
  file.write("x");
  EXPECT_FALSE(file.commit());
  EXPECT_EQ(file.error(), "no space left on the disk");
}

TEST(OpenStream, says_why_it_cannot) {
  std::string error;
  EXPECT_EQ(open_stream("/", error), nullptr);
  EXPECT_EQ(error, "is a folder");
  EXPECT_EQ(open_stream("/nowhere/at/all", error), nullptr);
  EXPECT_EQ(error, "no such file");
}

TEST(LineReader, cuts_lines_however_the_bytes_arrive) {
  const std::string bytes =
      "\xEF\xBB\xBF"
      "a\r\n\nbc\r\rd\n\r\nlast";
  for (const std::size_t chunk : {1u, 2u, 5u, 100u}) {
    MemoryStream stream(bytes, chunk);
    LineReader lines(stream);
    std::vector<std::string> got;
    while (const auto line = lines.next()) got.emplace_back(line->text);
    EXPECT_EQ(got, (std::vector<std::string>{"a", "", "bc\r\rd", "", "last"}));
  }
}

TEST(LineReader, ends_at_a_line_that_is_too_long) {
  const std::string bytes = "a\n" + std::string(3 * LineReader::kMaxLineBytes, 'x') + "\nb\n";
  MemoryStream stream(bytes, 10000);
  LineReader lines(stream);
  EXPECT_EQ(lines.next()->text, "a");
  const auto line = lines.next();
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->too_long);
  EXPECT_EQ(line->number, 2u);
  EXPECT_FALSE(lines.next());
}

}  // namespace
}  // namespace kb::trace
