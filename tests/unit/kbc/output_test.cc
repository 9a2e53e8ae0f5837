#include "tools/kbc/output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kb::cli {
namespace {

namespace fs = std::filesystem;

class Staged : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "kb_output.XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string make(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  static std::string read(const std::string& path) {
    std::stringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return out.str();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  std::string folder_;
};

TEST_F(Staged, file_appears_when_it_is_committed_and_not_before) {
  StagedFile file(path("a.h"));
  ASSERT_TRUE(file.stage("new"));
  EXPECT_FALSE(fs::exists(path("a.h")));
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(read(path("a.h")), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Staged, file_that_is_given_up_leaves_no_trace) {
  make("a.h", "old");
  {
    StagedFile file(path("a.h"));
    ASSERT_TRUE(file.stage("new"));
  }
  EXPECT_EQ(read(path("a.h")), "old");
  EXPECT_EQ(files(), 1u);
}

// A limit on the size of files is met in the middle of writing, as the end of a disk is.
TEST_F(Staged, file_that_does_not_fit_leaves_the_old_one_untouched) {
  make("a.cc", "old");
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  ::rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  {
    StagedFile file(path("a.cc"));
    EXPECT_FALSE(file.stage(std::string(100'000, 'x')));
    EXPECT_EQ(file.error(), "is too large for the disk");
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read(path("a.cc")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Staged, file_keeps_the_rights_of_the_old_one_and_new_ones_get_the_usual) {
  make("a.h", "old");
  ::chmod(path("a.h").c_str(), 0640);
  const ::mode_t mask = ::umask(022);
  for (const char* name : {"a.h", "b.h"}) {
    StagedFile file(path(name));
    ASSERT_TRUE(file.stage("new") && file.commit());
  }
  ::umask(mask);
  EXPECT_EQ(fs::status(path("a.h")).permissions(), fs::perms(0640));
  EXPECT_EQ(fs::status(path("b.h")).permissions(), fs::perms(0644));
}

TEST_F(Staged, file_behind_a_link_is_replaced_and_the_link_stays) {
  make("real.h", "old");
  fs::create_symlink(path("real.h"), path("link.h"));
  StagedFile file(path("link.h"));
  ASSERT_TRUE(file.stage("new") && file.commit());
  EXPECT_TRUE(fs::is_symlink(path("link.h")));
  EXPECT_EQ(read(path("real.h")), "new");
}

TEST_F(Staged, file_says_why_it_cannot_be_written) {
  const auto why = [](const std::string& at) {
    StagedFile file(at);
    EXPECT_FALSE(file.stage("x"));
    return file.error();
  };
  EXPECT_EQ(why(folder_), "is a directory");
  EXPECT_EQ(why(path("no/such/a.h")), "no such file or folder");
  EXPECT_EQ(why(make("file", "x") + "/a.h"), "a part of the path is not a directory");
  EXPECT_EQ(why("/dev/full"), "no space left on the disk");
}

TEST_F(Staged, devices_are_written_to_as_they_are) {
  StagedFile file("/dev/null");
  EXPECT_TRUE(file.stage("x") && file.commit());
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST_F(Staged, folders_are_made_or_refused_with_a_reason) {
  EXPECT_EQ(make_folders(path("a/b/c")), std::nullopt);
  EXPECT_TRUE(fs::is_directory(path("a/b/c")));
  EXPECT_EQ(make_folders(path("a/b/c")), std::nullopt);
  EXPECT_TRUE(make_folders(make("file", "x") + "/a").has_value());
  EXPECT_TRUE(make_folders(path("file")).has_value());
}

}  // namespace
}  // namespace kb::cli
