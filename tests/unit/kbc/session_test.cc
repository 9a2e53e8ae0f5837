#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/unit/scratch_folder.h"
#include "tools/kbc/library_folder.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

namespace fs = std::filesystem;
using diagnostics::Kind;

class InSession : public ::testing::Test {
 protected:
  void SetUp() override { ::unsetenv("WAYMARK_LIBRARY"); }

  std::string make(const std::string& name, std::string_view bytes) const {
    const std::string path = folder_ + "/" + name;
    fs::create_directories(fs::path(path).parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  // What a session says, and its exit code.
  template <class Work>
  std::string said(SharedOptions options, Work work) {
    ::testing::internal::CaptureStderr();
    Session session(std::move(options));
    EXPECT_TRUE(session.take_warning_options());
    work(session);
    code_ = session.finish(kClean);
    return ::testing::internal::GetCapturedStderr();
  }
  ScratchFolder scratch_;
  std::string folder_ = scratch_.path();
  int code_ = -1;
};

TEST_F(InSession, no_output_takes_the_place_of_an_input) {
  const std::string input = make("a.kb", "fact A\n"), noted = make("a.csv", "A\n"), other = make("b.kb", "");
  fs::create_symlink(input, folder_ + "/link");
  const std::string text = said({.format = "json"}, [&](Session& session) {
    source::Sources sources;
    EXPECT_TRUE(session.open(input, sources));
    session.note_input(noted);
    EXPECT_EQ(session.files_read(), std::vector<std::string>{input});
    EXPECT_FALSE(session.may_write(folder_ + "/new/../link"));
    EXPECT_FALSE(session.write_files({{other, "new"}, {noted, "new"}}));
    EXPECT_TRUE(session.may_write(other));
    EXPECT_TRUE(session.may_write(folder_ + "/none.kb"));
    EXPECT_TRUE(session.may_write("-"));
    EXPECT_TRUE(session.write_files({{.path = input, .bytes = "fact B\n", .in_place = true}}));
  });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_EQ(fs::file_size(other), 0u);
}

TEST_F(InSession, a_message_about_a_shared_file_is_said_once) {
  make("shared.kb", "fact A\nfact A\n");
  const std::string a = make("a.kb", "import \"shared.kb\"\n"), b = make("b.kb", "import \"shared.kb\"\n");
  const std::string text = said({}, [&](Session& session) {
    for (const std::string& file : {a, b}) EXPECT_FALSE(session.compile(file, driver::Stage::kModel)->ok());
  });
  const auto first = text.find("shared.kb:2:6: error");
  EXPECT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find("shared.kb:2:6: error", first + 1), std::string::npos) << text;
  EXPECT_EQ(code_, kErrors);
}

TEST_F(InSession, the_last_line_counts_unless_quiet) {
  const auto fail = [](Session& session) { session.report(Kind::kCannotRead, {"a.kb", "why"}); };
  EXPECT_EQ(said({}, fail), "kbc: error: cannot read `a.kb`: why [KB0901]\n1 error\n");
  EXPECT_EQ(said({.quiet = true}, fail), "kbc: error: cannot read `a.kb`: why [KB0901]\n");
}

TEST_F(InSession, json_and_sarif_are_nothing_but_json) {
  const auto fail = [](Session& session) {
    session.report(Kind::kCannotRead, {"a.kb", "why"});
    session.report(Kind::kCannotRead, {"b.kb", "why"});
  };
  const std::string lines = said({.format = "json"}, fail);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
  EXPECT_TRUE(nlohmann::json::accept(lines.substr(0, lines.find('\n'))));
  const std::string document = said({.format = "sarif"}, fail);
  ASSERT_TRUE(nlohmann::json::accept(document)) << document;
  EXPECT_EQ(nlohmann::json::parse(document)["runs"][0]["results"].size(), 2u);
  EXPECT_TRUE(nlohmann::json::accept(said({.format = "sarif"}, [](Session&) {})));
}

TEST_F(InSession, a_library_that_is_none_is_told_once_and_plainly) {
  const std::string file = make("a.kb", "import std.navigation\n");
  const std::string text = said({.library = folder_}, [&](Session& session) {
    EXPECT_FALSE(session.compile(file, driver::Stage::kModel)->ok());
  });
  EXPECT_NE(text.find("KB0905"), std::string::npos) << text;
  EXPECT_NE(text.find("\n1 error\n"), std::string::npos) << text;
}

TEST_F(InSession, the_library_is_the_one_asked_for_then_the_one_of_the_environment) {
  ::setenv("WAYMARK_LIBRARY", "/from/environment", 1);
  EXPECT_EQ(find_library("/asked/for"), "/asked/for");
  EXPECT_EQ(find_library(""), "/from/environment");
  ::unsetenv("WAYMARK_LIBRARY");
  EXPECT_NE(find_library("").find("share/waymark/stdlib_rules"), std::string::npos);
}

TEST_F(InSession, of_two_files_none_is_written_if_one_cannot_be) {
  const std::string header = make("a.h", "old header");
  const std::string text = said({}, [&](Session& session) {
    EXPECT_FALSE(session.write_files({{header, "new header"}, {folder_ + "/no/a.cc", "new source"}}));
  });
  EXPECT_NE(text.find("KB0904"), std::string::npos) << text;
  std::string now;
  std::getline(std::ifstream(header), now);
  EXPECT_EQ(now, "old header");
}

// A small file is verified before it is written, a large one meanwhile.
TEST_F(InSession, a_file_that_is_refused_leaves_the_old_one_and_no_other) {
  const auto refuse = [](std::string_view) { throw std::logic_error("refused"); };
  const std::string file = make("a.kbt", "old image");
  for (const std::size_t size : {std::size_t{10}, std::size_t{3} << 20}) {
    static_cast<void>(said({}, [&](Session& session) {
      EXPECT_THROW(session.write_files({{file, std::string(size, 'x'), refuse}}), std::logic_error);
    }));
    std::string now;
    std::getline(std::ifstream(file), now);
    EXPECT_EQ(now, "old image") << size;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << size;
  }
}

TEST_F(InSession, a_file_that_is_verified_is_written_whole) {
  const std::string file = make("a.kbt", "old image"), bytes(std::size_t{3} << 20, 'x');
  const auto pass = [](std::string_view seen) { EXPECT_EQ(seen.size(), std::size_t{3} << 20); };
  static_cast<void>(said({}, [&](Session& session) { EXPECT_TRUE(session.write_files({{file, bytes, pass}})); }));
  std::string now;
  std::getline(std::ifstream(file), now);
  EXPECT_TRUE(now == bytes);
}

TEST_F(InSession, what_asks_it_to_end_while_it_writes_ends_it_when_all_is_written) {
  const auto interrupted = [&](void (*verify)(std::string_view)) {
    Session session({});
    static_cast<void>(session.write_files({{.path = folder_ + "/whole", .bytes = "whole", .verify = verify}}));
  };
  EXPECT_EXIT(interrupted([](std::string_view) { std::raise(SIGTERM); }), ::testing::KilledBySignal(SIGTERM), "");
  EXPECT_EXIT(interrupted([](std::string_view) { std::raise(SIGINT); }), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EQ(fs::file_size(folder_ + "/whole"), 5u);
}

TEST_F(InSession, what_is_refused_is_not_written_to_a_pipe_either) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const auto refuse = [](std::string_view) { throw std::logic_error("refused"); };
  const std::string pipe = "/dev/fd/" + std::to_string(ends[1]);
  static_cast<void>(said({}, [&](Session& session) {
    EXPECT_THROW(session.write_files({{pipe, std::string(std::size_t{3} << 20, 'x'), refuse}}), std::logic_error);
  }));
  ::close(ends[1]);
  char first = 0;
  EXPECT_EQ(::read(ends[0], &first, 1), 0);
  ::close(ends[0]);
}

TEST_F(InSession, what_was_read_is_known_for_the_dependencies) {
  make("part.kb", "levels a > b\n");
  const std::string main = make("main.kb", "import \"part.kb\"\nimport \"part.kb\"\n");
  static_cast<void>(said({}, [&](Session& session) {
    static_cast<void>(session.compile(main, driver::Stage::kTrees));
    ASSERT_EQ(session.files_read().size(), 2u);
    EXPECT_EQ(session.files_read()[0], main);
    EXPECT_EQ(session.files_read()[1], folder_ + "/part.kb");
  }));
}

TEST(Namespace, must_be_a_name_that_cpp_can_take) {
  for (const char* name : {"route1", "a::b", "robot::robot", "a::remove", "removed"}) EXPECT_TRUE(is_namespace(name)) << name;
  for (const char* name : {"", "1st", "class", "a b", "a-b", "std", "mts", "kb", "a::", "::a", "a:b", "a:::b", "a::std", "a::b::class", "remove", "size_t", "uint8_t", "FILE", "stdin::a"}) EXPECT_FALSE(is_namespace(name)) << name;
}

}  // namespace
}  // namespace kb::cli
