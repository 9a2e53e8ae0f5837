#include "tools/kbc/trace/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/unit/scratch_folder.h"
#include "tests/unit/whole_file.h"

namespace kb::trace {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string make(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  ScratchFolder scratch_;
  std::string folder_ = scratch_.path();
};

bool staged(OutputFile& file, const std::string& path, std::string_view bytes) {
  if (!file.open(path)) return false;
  file.write(bytes);
  return file.stage();
}

TEST_F(OutputFileTest, appears_when_it_is_committed_and_not_before) {
  OutputFile file;
  ASSERT_TRUE(staged(file, path("a.h"), "new"));
  EXPECT_FALSE(fs::exists(path("a.h")));
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(whole_file(path("a.h")), "new");
  EXPECT_EQ(files(), 1u);
}

// A folder that has come in between refuses the move, as a file does over which another is mounted.
TEST_F(OutputFileTest, of_several_all_are_moved_or_none) {
  make("a.h", "old"), make("a.cc", "old");
  for (const bool refused : {true, false}) {
    std::vector<OutputFile> outputs(4);   // the second one is not opened, as one that goes to standard output
    ASSERT_TRUE(staged(outputs[0], path("new.h"), "new") && staged(outputs[2], path("a.h"), "new") && staged(outputs[3], path("a.cc"), "new"));
    if (refused) fs::remove(path("a.cc")), fs::create_directory(path("a.cc"));
    EXPECT_EQ(OutputFile::commit_all(outputs), refused ? std::optional<std::size_t>(3) : std::nullopt);
    EXPECT_EQ(outputs[3].error(), refused ? "is a directory" : "");
    EXPECT_EQ(whole_file(path("a.h")), refused ? "old" : "new");
    EXPECT_EQ(fs::exists(path("new.h")), !refused);
    if (refused) fs::remove(path("a.cc")), make("a.cc", "old");
  }
  EXPECT_EQ(whole_file(path("a.cc")), "new");
  EXPECT_EQ(files(), 3u) << "another name of an old file was left";
}

TEST_F(OutputFileTest, grows_on_under_its_name_wherever_it_was_moved) {
  for (const bool by_its_temporary_name : {false, true}) {
    std::string refused;
    make("log", "old");
    OutputFile file;
    ASSERT_TRUE(file.open(path("log")));
    file.write("a");
    if (by_its_temporary_name) fs::rename(file.beside(), path("log.1"));
    bool is_new = file.reopen(refused);
    EXPECT_EQ(is_new, by_its_temporary_name);
    if (!is_new) fs::rename(path("log"), path("log.1")), is_new = file.reopen(refused);
    EXPECT_TRUE(is_new);
    file.write("b");
    EXPECT_FALSE(file.reopen(refused)) << "nobody has moved it away";
    file.write("c");
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(whole_file(path("log.1")) + ", " + whole_file(path("log")), "a, bc");
  }
  EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFileTest, goes_on_growing_where_it_was_if_its_name_cannot_be_opened) {
  fs::permissions(make("log", "old"), fs::perms::owner_read | fs::perms::owner_write);
  OutputFile file;
  ASSERT_TRUE(file.open(path("log")));
  std::string refused;
  const auto is_refused = [&] { return !file.reopen(refused) && !std::exchange(refused, "").empty(); };
  const auto stands_in_the_way = [&] { return fs::remove(path("log")), fs::create_directory(path("log")); };
  ASSERT_TRUE(stands_in_the_way());
  file.write("a");
  EXPECT_TRUE(is_refused());
  file.write("b");
  fs::remove(path("log"));
  EXPECT_FALSE(file.reopen(refused));   // the move
  fs::rename(path("log"), path("log.1"));
  ASSERT_EQ(::mkfifo(path("log").c_str(), 0600), 0);
  EXPECT_TRUE(is_refused()) << "a pipe without a reader would be waited for";
  file.write("c");
  ASSERT_TRUE(stands_in_the_way());
  EXPECT_TRUE(is_refused());
  file.write("d");
  fs::remove(path("log"));
  EXPECT_TRUE(file.reopen(refused));
  file.write("e");
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(whole_file(path("log.1")) + ", " + whole_file(path("log")), "abcd, e");
  EXPECT_EQ(fs::status(path("log")).permissions(), fs::status(path("log.1")).permissions());
}

TEST_F(OutputFileTest, that_is_given_up_leaves_no_trace) {
  make("a.h", "old");
  {
    OutputFile file;
    ASSERT_TRUE(staged(file, path("a.h"), "new"));
  }
  EXPECT_EQ(whole_file(path("a.h")), "old");
  EXPECT_EQ(files(), 1u);
}

// A limit on the size of files is met in the middle of writing, as the end of a disk is.
TEST_F(OutputFileTest, that_does_not_fit_leaves_the_old_one_untouched) {
  make("a.cc", "old");
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  ::rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  {
    OutputFile file;
    EXPECT_FALSE(staged(file, path("a.cc"), std::string(100'000, 'x')));
    EXPECT_EQ(file.error(), "it is too large for the disk");
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(whole_file(path("a.cc")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, keeps_the_rights_of_the_old_one_and_new_ones_get_the_usual) {
  make("a.h", "old");
  ::chmod(path("a.h").c_str(), 0640);
  const ::mode_t mask = ::umask(022);
  for (const char* name : {"a.h", "b.h"}) {
    OutputFile file;
    ASSERT_TRUE(staged(file, path(name), "new") && file.commit());
  }
  ::umask(mask);
  EXPECT_EQ(fs::status(path("a.h")).permissions(), fs::perms(0640));
  EXPECT_EQ(fs::status(path("b.h")).permissions(), fs::perms(0644));
}

TEST_F(OutputFileTest, behind_a_link_is_replaced_and_the_link_stays) {
  make("real.h", "old");
  fs::create_symlink(path("real.h"), path("link.h"));
  OutputFile file;
  ASSERT_TRUE(staged(file, path("link.h"), "new") && file.commit());
  EXPECT_TRUE(fs::is_symlink(path("link.h")));
  EXPECT_EQ(whole_file(path("real.h")), "new");
}

TEST_F(OutputFileTest, says_why_it_cannot_be_written) {
  const auto why = [](const std::string& at) {
    OutputFile file;
    EXPECT_FALSE(staged(file, at, "x"));
    return file.error();
  };
  EXPECT_EQ(why(folder_), "is a directory");
  EXPECT_EQ(why(path("no/such/a.h")), "there is no such folder");
  EXPECT_EQ(why(make("file", "x") + "/a.h"), "a part of the path is not a directory");
  EXPECT_EQ(why("/dev/full"), "no space left on the disk");
}

// Written before it is staged: what is wrong with one of many writes is kept.
TEST_F(OutputFileTest, says_at_the_end_when_the_disk_is_full) {
  OutputFile file;
  ASSERT_TRUE(file.open("/dev/full"));
  file.write("x");
  EXPECT_FALSE(file.failed());
  EXPECT_FALSE(file.commit());
  EXPECT_EQ(file.error(), "no space left on the disk");
}

TEST_F(OutputFileTest, devices_are_written_to_as_they_are) {
  OutputFile file;
  EXPECT_TRUE(staged(file, "/dev/null", "x") && file.commit());
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST_F(OutputFileTest, folders_are_made_or_refused_with_a_reason) {
  EXPECT_EQ(make_folders(path("a/b/c")), std::nullopt);
  EXPECT_TRUE(fs::is_directory(path("a/b/c")));
  EXPECT_EQ(make_folders(path("a/b/c")), std::nullopt);
  EXPECT_TRUE(make_folders(make("file", "x") + "/a").has_value());
  EXPECT_TRUE(make_folders(path("file")).has_value());
}

}  // namespace
}  // namespace kb::trace
