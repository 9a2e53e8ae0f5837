#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "compiler/source/source.h"
#include "tests/unit/scratch_folder.h"

namespace kb::source {
namespace {

namespace fs = std::filesystem;

class RealFiles : public ::testing::Test {
 protected:
  std::string make(const std::string& name, std::string_view bytes) const {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  ScratchFolder scratch_;
  std::string folder_ = scratch_.path();
  RealFileSystem files_;
};

TEST_F(RealFiles, come_back_byte_by_byte) {
  const std::string bytes("a\0b\r\n\xFF", 6);
  const auto result = files_.read(make("a.kb", bytes));
  ASSERT_TRUE(result.bytes);
  EXPECT_EQ(*result.bytes, bytes);
  EXPECT_TRUE(result.error.empty());
}

TEST_F(RealFiles, may_be_empty) {
  const auto result = files_.read(make("a.kb", ""));
  ASSERT_TRUE(result.bytes);
  EXPECT_TRUE(result.bytes->empty());
}

TEST_F(RealFiles, say_why_they_cannot_be_read) {
  EXPECT_EQ(files_.read(folder_ + "/nothing.kb").error, "no such file");
  EXPECT_EQ(files_.read(folder_).error, "is a directory");
  EXPECT_EQ(files_.read(make("a.kb", "x") + "/b.kb").error, "a part of the path is not a directory");
  EXPECT_EQ(files_.read(std::string(5000, 'x')).error, "the name is too long");
  EXPECT_EQ(files_.read(std::string_view("a\0b", 3)).error, "the name holds a NUL byte");
  EXPECT_EQ(files_.read("").error, "no such file");
}

TEST_F(RealFiles, say_that_they_may_not_be_read) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  const std::string path = make("a.kb", "x");
  ::chmod(path.c_str(), 0);
  EXPECT_EQ(files_.read(path).error, "permission denied");
}

TEST_F(RealFiles, that_are_no_files_are_refused_without_waiting) {
  EXPECT_EQ(files_.read("/dev/zero").error, "is not a regular file");
  const std::string pipe = folder_ + "/pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(files_.read(pipe).error, "is not a regular file");
}

TEST_F(RealFiles, that_are_pipes_of_whoever_started_this_are_read_to_their_end) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  std::thread writer([&] {
    for (int i = 0; i < 100; ++i) EXPECT_EQ(::write(ends[1], std::string(1000, 'x').data(), 1000), 1000);
    ::close(ends[1]);
  });
  const auto result = files_.read(path);
  writer.join();
  ::close(ends[0]);
  ASSERT_TRUE(result.bytes) << result.error;
  EXPECT_EQ(result.bytes->size(), 100'000u);
}

TEST_F(RealFiles, that_are_too_large_are_refused_before_they_are_read) {
  const std::string path = make("a.kb", "");
  ASSERT_EQ(::truncate(path.c_str(), static_cast<off_t>(kMaxFileBytes) + 1), 0);
  const auto result = files_.read(path);
  EXPECT_FALSE(result.bytes);
  EXPECT_TRUE(result.too_large);
  ASSERT_EQ(::truncate(path.c_str(), static_cast<off_t>(kMaxFileBytes)), 0);
  EXPECT_TRUE(files_.read(path).bytes) << "the limit itself is allowed";
}

TEST_F(RealFiles, whose_size_is_not_known_beforehand_are_read_whole) {
  const auto result = files_.read("/proc/self/status");   // says that it has 0 bytes
  ASSERT_TRUE(result.bytes);
  EXPECT_GT(result.bytes->size(), 100u);
}

TEST_F(RealFiles, have_one_name_however_they_are_written) {
  const std::string path = make("a.kb", "x");
  fs::create_directory(folder_ + "/sub");
  fs::create_symlink(path, folder_ + "/link.kb");
  EXPECT_EQ(files_.canonical(folder_ + "/sub/../a.kb"), files_.canonical(path));
  EXPECT_EQ(files_.canonical(folder_ + "/link.kb"), files_.canonical(path));
  EXPECT_EQ(files_.canonical(folder_ + "/no/../b.kb"), files_.canonical(folder_ + "/b.kb")) << "also those that are not there";
}

TEST(MemoryFiles, are_found_by_their_normal_path) {
  MemoryFileSystem files;
  files.add("maps/a.kb", "fact A");
  EXPECT_EQ(files.read("maps/../maps/./a.kb").bytes, "fact A");
  EXPECT_EQ(files.canonical("maps/x/../a.kb"), "maps/a.kb");
  EXPECT_EQ(files.read("a.kb").error, "no such file");
}

TEST(MemoryFiles, have_the_same_limit) {
  MemoryFileSystem files;
  files.add("a.kb", std::string(kMaxFileBytes + 1, ' '));
  EXPECT_TRUE(files.read("a.kb").too_large);
}

}  // namespace
}  // namespace kb::source
