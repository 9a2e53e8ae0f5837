// The golden traces are what the closed loops give. KB_UPDATE=1 records them anew.
#include "tests/world/golden_traces.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace kb::world {

/// GoogleTest prints parameters of failed tests: the folder says all.
void PrintTo(const GoldenTrace& golden, std::ostream* out) { *out << golden.folder; }

namespace {

constexpr std::string_view kFolder = "tests/golden/traces/";
constexpr std::size_t kMostBytes = 200'000;

class Golden : public testing::TestWithParam<GoldenTrace> {};

void expect_file(const std::string& path, const std::string& want) {
  if (std::getenv("KB_UPDATE")) {
    std::filesystem::create_directories(std::filesystem::path(project_path(path)).parent_path());
    std::ofstream(project_path(path), std::ios::binary) << want;
  }
  EXPECT_LE(want.size(), kMostBytes) << path << " is too large for a person to read";
  const std::string have = project_file(path);
  const auto differs = std::mismatch(have.begin(), have.end(), want.begin(), want.end()).first - have.begin();
  EXPECT_TRUE(have == want) << path << " differs from the closed loop in line "
                            << 1 + std::count(have.begin(), have.begin() + differs, '\n')
                            << "; KB_UPDATE=1 records it anew";
}

TEST_P(Golden, TraceIsWhatTheClosedLoopGives) {
  const GoldenTrace& golden = GetParam();
  const GoldenFiles files = record(golden, mind_from_environment());
  const std::string folder = std::string(kFolder) + golden.folder + "/";
  expect_file(folder + "mission.kb", files.mission_kb);
  expect_file(folder + "mission.facts.csv", files.facts_csv);
  expect_file(folder + "mission.trace.jsonl", files.trace_jsonl);
  expect_file(folder + "README.md", files.readme);
}

INSTANTIATE_TEST_SUITE_P(Traces, Golden, testing::ValuesIn(golden_traces()),
                         [](const auto& golden) { return "T" + golden.param.folder; });

}  // namespace
}  // namespace kb::world
