#include "tools/kbc/trace/test_cases.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/trace/sample.h"
#include "tests/unit/whole_file.h"

namespace kb::trace {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;
using Outcome = CaseResult::Outcome;

class Cases : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(::testing::TempDir()) / "kbc_cases" / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, std::string_view text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const { return whole_file(folder_ / name); }
  [[nodiscard]] std::vector<TestCase> find() { return find_cases({folder_.string()}, {}, diagnostics_); }
  // Names and programs of the cases, relative to the folder.
  [[nodiscard]] Lines found() {
    Lines out;
    for (const TestCase& test : find())
      out.push_back(fs::relative(test.name, folder_).string() + " " + fs::relative(test.program, folder_).string());
    return out;
  }
  [[nodiscard]] CaseResult run(bool update = false) {
    const auto cases = find();
    return run_case(cases.at(0), program_, tables_, {.engine = EngineKind::kInterpreter, .update = update}, sources_,
                    diagnostics_);
  }
  // What was reported, codes only.
  [[nodiscard]] Lines codes() const {
    Lines out;
    for (const std::string& line : said_.all) out.push_back(line.substr(0, 6));
    return out;
  }

  fs::path folder_;
  program::Program program_ = testing::sample_program();
  tables::Tables tables_;
  source::Sources sources_;
  testing::Said said_{sources_};
  diagnostics::Diagnostics diagnostics_{sources_, said_};
};

TEST_F(Cases, are_found_in_all_folders_with_the_knowledge_base_beside_them) {
  write("a/m.kb", "");
  write("a/two.facts.csv", "Line\n");
  write("a/one.facts.csv", "Line\n");
  write("b/c/n.kb", "");
  write("b/c/x.facts.csv", "Line\n");
  write("b/.hidden/y.facts.csv", "Line\n");
  EXPECT_EQ(found(), (Lines{"a/one a/m.kb", "a/two a/m.kb", "b/c/x b/c/n.kb"}));
  EXPECT_EQ(codes(), Lines{});
}

TEST_F(Cases, name_their_knowledge_base_where_there_are_several) {
  write("a.kb", "");
  write("b.kb", "");
  write("a.facts.csv", "Line\n");
  write("c.facts.csv", "# what happens at night\n# kb: b.kb, dt: 10 ms\nLine\n");
  write("d/e.facts.csv", "# kb: ../a.kb\nLine\n");
  EXPECT_EQ(found(), (Lines{"a a.kb", "d/e a.kb", "c b.kb"}));
  write("f.facts.csv", "Line\n");
  EXPECT_EQ(found().size(), 3u);
  EXPECT_EQ(codes(), Lines{"KB0946"});
}

TEST_F(Cases, of_one_name_would_have_one_trace) {
  write("m.kb", "");
  write("a.facts.csv", "Line\n");
  write("a.readings.csv", "line\n");
  EXPECT_EQ(found(), Lines{"a m.kb"});
  EXPECT_EQ(codes(), Lines{"KB0949"});
}

TEST_F(Cases, that_are_named_twice_are_run_once) {
  write("m.kb", "");
  write("a.facts.csv", "Line\n");
  EXPECT_EQ(find_cases({folder_.string(), (folder_ / "a.facts.csv").string(), (folder_ / "a").string()}, {}, diagnostics_).size(), 1u);
  EXPECT_EQ(codes(), Lines{});
}

TEST_F(Cases, are_missed_where_there_are_none) {
  EXPECT_EQ(found(), Lines{});
  EXPECT_EQ(codes(), Lines{"KB0945"});
}

TEST_F(Cases, are_missed_where_there_is_only_a_trace) {
  write("lost.trace.jsonl", "");
  EXPECT_EQ(found(), Lines{});
  EXPECT_EQ(codes(), (Lines{"KB0948", "KB0945"}));
}

TEST_F(Cases, pass_after_they_were_updated_and_fail_when_something_changed) {
  write("m.kb", "");
  write("x.facts.csv", "Start\n0\n1\n0\n");
  EXPECT_EQ(run().outcome, Outcome::kBroken);
  EXPECT_EQ(codes(), Lines{"KB0947"}) << "there is no expected trace yet";
  EXPECT_EQ(run(true).outcome, Outcome::kUpdated);
  EXPECT_EQ(run().outcome, Outcome::kPassed);
  EXPECT_EQ(run(true).outcome, Outcome::kPassed);
  write("x.facts.csv", "Start\n0\n0\n0\n");
  const CaseResult result = run();
  EXPECT_EQ(result.outcome, Outcome::kFailed);
  EXPECT_NE(result.report.find("`obey` did not fire, which was expected"), std::string::npos) << result.report;
}

TEST_F(Cases, leave_the_expected_trace_alone_when_the_facts_are_wrong) {
  write("m.kb", "");
  write("x.facts.csv", "Start\n0\n1\n");
  ASSERT_EQ(run(true).outcome, Outcome::kUpdated);
  const std::string before = read("x.trace.jsonl");
  write("x.facts.csv", "Start\n1\nx\n");
  EXPECT_EQ(run(true).outcome, Outcome::kBroken);
  EXPECT_EQ(read("x.trace.jsonl"), before);
  EXPECT_EQ(codes(), Lines{"KB0932"});
}

TEST_F(Cases, are_broken_by_a_line_that_is_no_tick) {
  write("m.kb", "");
  write("x.facts.csv", "Start\n0\n");
  write("x.trace.jsonl", "{\"tick\":1\n");
  EXPECT_EQ(run().outcome, Outcome::kBroken);
  EXPECT_EQ(codes(), Lines{"KB0942"});
  EXPECT_EQ(run(true).outcome, Outcome::kUpdated) << "an update overwrites anything";
}

TEST(JUnit, counts_and_escapes) {
  const std::vector<TestCase> cases{{"d/a", "", "", ""}, {"d/b<", "", "", ""}};
  std::vector<CaseResult> results(2);
  results[0].outcome = Outcome::kPassed;
  results[1].outcome = Outcome::kFailed;
  results[1].report = "1 < 2 & \"x\"";
  EXPECT_EQ(print_junit(cases, results),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites tests=\"2\" failures=\"1\" errors=\"0\">\n"
            "  <testsuite name=\"kbc test\" tests=\"2\" failures=\"1\" errors=\"0\">\n"
            "    <testcase classname=\"d\" name=\"a\"/>\n"
            "    <testcase classname=\"d\" name=\"b&lt;\">\n"
            "      <failure message=\"the trace differs\">1 &lt; 2 &amp; &quot;x&quot;</failure>\n"
            "    </testcase>\n"
            "  </testsuite>\n"
            "</testsuites>\n");
}

}  // namespace
}  // namespace kb::trace
