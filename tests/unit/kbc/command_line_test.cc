#include "tools/kbc/command_line.h"

#include <gtest/gtest.h>

#include <new>
#include <set>
#include <stdexcept>

#include "tools/kbc/run_kbc.h"

namespace kb::cli {
namespace {

TEST(Commands, have_names_of_their_own_and_help_in_one_manner) {
  std::set<std::string_view> names;
  for (const Command& command : commands()) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    ASSERT_FALSE(command.help.empty()) << command.name;
    EXPECT_TRUE(command.help.front() >= 'A' && command.help.front() <= 'Z') << command.help;
    EXPECT_NE(command.help.back(), '.') << command.help;
  }
  for (const std::string_view name : {"compile", "check", "run", "test", "why", "explain", "expand", "dump", "budget", "graph", "fmt", "new"}) {
    EXPECT_TRUE(names.count(name)) << name;
  }
}

TEST(Commands, teach_with_examples_of_themselves) {
  for (const Command& command : commands()) {
    ASSERT_FALSE(command.examples.empty()) << command.name;
    EXPECT_TRUE(command.examples.starts_with("kbc " + std::string(command.name) + " ")) << command.examples;
    EXPECT_EQ(command.examples.back(), '\n') << command.name;
  }
}

// The words of an example up to its remark, as a shell would give them.
std::vector<std::string> words_of(const std::string& example) {
  std::vector<std::string> words;
  for (const std::string& word : CLI::detail::split_up(example.substr(0, example.find(" #")))) {
    if (word == "|" || word == ">" || word == "<" || word == "&&") break;
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

TEST(Commands, teach_with_examples_that_are_understood) {
  for (const Command& command : commands()) {
    for (const std::string& example : CLI::detail::split(std::string(command.examples.substr(0, command.examples.size() - 1)), '\n')) {
      std::vector<std::string> words = words_of(example);
      if (words.front() == "mpirun") words.erase(words.begin(), words.begin() + 3);
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      CommandLine line;
      EXPECT_NO_THROW(line.app.parse(static_cast<int>(argv.size()), argv.data())) << example;
    }
  }
}

TEST(Commands, describe_each_option_with_a_capital_and_without_a_full_stop) {
  const CommandLine line;
  for (const CommandLine::Entry& entry : line.entries) {
    for (const CLI::Option* option : entry.app->get_options()) {
      const std::string& help = option->get_description();
      const std::string where = entry.app->get_name() + " " + option_names(*option);
      ASSERT_FALSE(help.empty()) << where;
      EXPECT_NE(help.back(), '.') << where;
    }
  }
}

TEST(Commands, give_no_option_two_meanings) {
  const CommandLine line;
  for (const CommandLine::Entry& entry : line.entries) {
    std::set<std::string> seen;
    for (const CLI::Option* option : entry.app->get_options()) {
      for (const std::string& name : CLI::detail::split(option_names(*option), ',')) {
        EXPECT_TRUE(seen.insert(name).second) << entry.app->get_name() << " " << name;
      }
    }
  }
}

TEST(Commands, that_run_out_of_memory_are_no_bug_of_kbc) {
  const auto code_after = [](auto thrown) { return guarded([&]() -> int { throw thrown; }); };
  EXPECT_EQ(code_after(std::bad_alloc()), kOutOfMemory);
  EXPECT_EQ(code_after(std::logic_error("there is no such case")), kBug);
  EXPECT_EQ(guarded([] { return static_cast<int>(kErrors); }), kErrors);
}

std::vector<std::string> warnings_of(std::vector<std::string> words) {
  CommandLine line;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  line.app.parse(static_cast<int>(argv.size()), argv.data());
  return line.shared.warnings;
}

TEST(CommandLine, takes_warnings_in_the_manner_of_compilers) {
  const std::vector<std::string> expected{"error", "no-never-read", "error=dead"};
  EXPECT_EQ(warnings_of({"kbc", "check", "-Werror", "-Wno-never-read", "a.kb", "-Werror=dead", "b.kb"}), expected);
}

TEST(CommandLine, knows_the_choices_and_values_of_options) {
  const CommandLine line;
  for (const CommandLine::Entry& entry : line.entries) {
    if (entry.app->get_name() != "compile") continue;
    EXPECT_EQ(usage_line(*entry.app), "kbc compile [OPTIONS] FILE");
    EXPECT_EQ(option_choices(*entry.app->get_option("--emit")), (std::vector<std::string>{"cpp", "json", "image"}));
    EXPECT_EQ(option_value(*entry.app->get_option("--emit")), "{cpp|json|image}");
    EXPECT_EQ(option_value(*entry.app->get_option("--out")), "DIR");
    EXPECT_EQ(option_value(*entry.app->get_option("--quiet")), "");
  }
}

TEST(CommandLine, ends_with_2_if_it_cannot_be_understood) {
  const auto run = [](std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const int code = run_kbc(static_cast<int>(argv.size()), argv.data());
    ::testing::internal::GetCapturedStdout();
    ::testing::internal::GetCapturedStderr();
    return code;
  };
  EXPECT_EQ(run({"kbc"}), kUsage);
  EXPECT_EQ(run({"kbc", "--version"}), kClean);
  EXPECT_EQ(run({"kbc", "check", "--help"}), kClean);
  EXPECT_EQ(run({"kbc", "chek"}), kUsage);
  EXPECT_EQ(run({"kbc", "check"}), kUsage);
  EXPECT_EQ(run({"kbc", "check", "--nonsense", "a.kb"}), kUsage);
  EXPECT_EQ(run({"kbc", "check", "-Wno-nonsense", "a.kb"}), kUsage);
  EXPECT_EQ(run({"kbc", "dump", "nonsense", "a.kb"}), kUsage);
  EXPECT_EQ(run({"kbc", "check", "/no/such/file.kb"}), kErrors);
}

}  // namespace
}  // namespace kb::cli
