// The images of all examples: verified, damaged, run beside the tables, swapped on the mission of Table 1.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"
#include "tests/unit/image/running.h"
#include "tests/unit/stride.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::tables {
namespace {

using mts::ImageStatus;

const std::string kRoot = KB_PROJECT_ROOT;

std::unique_ptr<driver::Compilation> compile_example(const std::string& path) {
  return driver::compile(path, source::RealFileSystem(), {.library = kRoot + "/stdlib_rules", .warnings = {}, .analyse = false},
                         diagnostics::CountingConsumer::make, nullptr);
}

/// Every knowledge base of the examples; a map alone is none.
std::vector<std::string> examples() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot + "/examples")) {
    const bool map = entry.path().stem() == "labyrinth" || entry.path().stem() == "house";
    if (entry.path().extension() == ".kb" && !map) out.push_back(entry.path().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Given { std::vector<float> facts; std::uint32_t dt_us; };

/// The rows of a recording; empty if it is not one for this program.
std::vector<Given> recorded(const std::string& path, const program::Program& program) {
  std::string error;
  const auto bytes = trace::open_stream(path, error);
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  trace::FactsReader reader(path, *bytes, program, sources, messages);
  std::vector<Given> rows;
  if (!reader.open()) return rows;
  while (const trace::FactsRow* row = reader.next()) rows.push_back({{row->facts.begin(), row->facts.end()}, row->dt_us});
  return rows;
}

/// Facts that come and go, the same for the same program.
std::vector<Given> made_up(const program::Program& program, std::size_t ticks) {
  std::uint32_t state = 12345;
  std::vector<Given> rows;
  std::vector<float> facts(program.facts, 0.0f);
  for (std::size_t i = 0; i < ticks; ++i) {
    for (float& fact : facts) {
      state = state * 1664525u + 1013904223u;
      if (state >> 29 == 0) fact = static_cast<float>(static_cast<int>(state >> 20 & 0xFFu) - 128) / 127.0f;
    }
    rows.push_back({facts, 50'000});
  }
  return rows;
}

class ExampleImage : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    compiled_ = compile_example(GetParam());
    ASSERT_TRUE(compiled_->ok());
    bytes_ = write_image(compiled_->tables, compiled_->program);
  }
  std::unique_ptr<driver::Compilation> compiled_;
  std::string bytes_;
};

TEST_P(ExampleImage, RunsAsTheTablesDo) {
  const LoadedImage image(bytes_);
  ASSERT_EQ(image.status(), ImageStatus::kOk) << mts::text(image.status());
  Tables recalled = recall_tables(image);
  const program::Program rules = recall_program(image, recalled);
  EXPECT_TRUE(write_image(recalled, rules) == bytes_);
  std::vector<std::vector<Given>> days{made_up(compiled_->program, 300)};
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GetParam()).parent_path())) {
    if (entry.path().string().ends_with(".facts.csv")) days.push_back(recorded(entry.path().string(), compiled_->program));
  }
  for (const auto& day : days) {
    Machine tables(compiled_->program, compiled_->tables), mapped(rules, image);
    for (const Given& given : day) {
      ASSERT_EQ(print_json(rules, mapped.tick(given.facts, given.dt_us)),
                print_json(compiled_->program, tables.tick(given.facts, given.dt_us)));
    }
  }
}

TEST_P(ExampleImage, IsRefusedWhereverItIsCutOff) {
  std::vector<std::uint64_t> memory((bytes_.size() + 7) / 8);
  std::memcpy(memory.data(), bytes_.data(), bytes_.size());
  std::vector<mts::Word> scratch(bytes_.size());
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    mts::Image<std::uint16_t> narrow;
    mts::Image<std::uint32_t> wide;
    ASSERT_NE(mts::open_image(memory.data(), size, scratch.data(), scratch.size(), narrow), ImageStatus::kOk) << size;
    ASSERT_NE(mts::open_image(memory.data(), size, scratch.data(), scratch.size(), wide), ImageStatus::kOk) << size;
  }
}

/// note [every single bit]
/// Computing the checksum anew for each of eight flips a byte would be quadratic. But it is linear: what a flip changes in it
/// depends on how many bytes follow, and not on which. So going backwards, the change for each bit is a step from that of the
/// byte behind. Some hundreds of flips, as many of a large image as of a small one, are also tried as they are.
TEST_P(ExampleImage, IsRefusedWithAnySingleBitFlipped) {
  std::vector<std::uint64_t> memory((bytes_.size() + 7) / 8);
  std::memcpy(memory.data(), bytes_.data(), bytes_.size());
  auto* at = reinterpret_cast<std::uint8_t*>(memory.data());
  const std::uint32_t right = mts::image::checksum_of(at, bytes_.size());
  ASSERT_EQ(right, reinterpret_cast<const mts::ImageHead*>(at)->checksum);
  std::uint32_t change[8];
  for (int b = 0; b < 8; ++b) change[b] = mts::Crc32c::step(0, static_cast<std::uint8_t>(1u << b));
  std::vector<mts::Word> scratch(bytes_.size());
  const std::size_t every = ((96 + 8 * bytes_.size() / 200) * kb::testing::stride()) | 1;   // odd: it comes to all bits of a byte
  std::size_t tried = 0;
  for (std::size_t i = bytes_.size(); i-- > 0;) {
    const bool stored = i >= offsetof(mts::ImageHead, checksum) && i < offsetof(mts::ImageHead, checksum) + 4;
    for (std::uint32_t b = 0; b < 8; ++b) {
      // A flip in the stored checksum changes that and not the computed one.
      if (!stored) { ASSERT_NE(right ^ change[b], right) << "byte " << i << ", bit " << b; }
      if ((8 * i + b) % every == 0 || (i < sizeof(mts::ImageHead) && (8 * i + b) % kb::testing::stride() == 0)) {
        at[i] ^= static_cast<std::uint8_t>(1u << b);
        ASSERT_EQ(mts::image::checksum_of(at, bytes_.size()), stored ? right : right ^ change[b]);
        mts::Image<std::uint16_t> narrow;
        mts::Image<std::uint32_t> wide;
        ASSERT_NE(mts::open_image(at, bytes_.size(), scratch.data(), scratch.size(), narrow), ImageStatus::kOk);
        ASSERT_NE(mts::open_image(at, bytes_.size(), scratch.data(), scratch.size(), wide), ImageStatus::kOk);
        at[i] ^= static_cast<std::uint8_t>(1u << b);
        ++tried;
      }
      change[b] = mts::Crc32c::step(change[b], 0);
    }
  }
  EXPECT_GE(tried, 8 * bytes_.size() / every);
}

INSTANTIATE_TEST_SUITE_P(Examples, ExampleImage, ::testing::ValuesIn(examples()), [](const auto& example) {
  std::string name = example.param.substr(kRoot.size() + std::strlen("/examples/"));
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

TEST(SwapOfTable1, AtAnyOneTickOrAtEveryTickChangesNothing) {
  const auto compiled = compile_example(kRoot + "/examples/01_route1/paper.kb");
  ASSERT_TRUE(compiled->ok());
  const auto day = recorded(kRoot + "/examples/01_route1/mission.facts.csv", compiled->program);
  ASSERT_GT(day.size(), 100u);
  const LoadedImage image(write_image(compiled->tables, compiled->program));
  ASSERT_EQ(image.status(), ImageStatus::kOk);
  image.visit([&]<class I>(const mts::Image<I>& view) {
    std::vector<std::string> calm;
    testing::Running<I> running(view);
    running.engine().reset();
    for (const Given& given : day) {
      running.tick(given.facts, given.dt_us);
      calm.push_back(running.trace());
    }
    const std::size_t step = kb::testing::stride();
    for (std::size_t at = day.size() % step; at <= day.size(); at += step) {  // the last round swaps at every tick
      auto swapping = std::make_unique<testing::Running<I>>(view);
      swapping->engine().reset();
      for (std::size_t tick = 0; tick < day.size(); ++tick) {
        if (tick == at || at == day.size()) {
          mts::SwapReport report;
          swapping = testing::swapped(*swapping, view, report);
          ASSERT_EQ(report.told, 0u);
        }
        swapping->tick(day[tick].facts, day[tick].dt_us);
        ASSERT_EQ(swapping->trace(), calm[tick]) << "swapped at " << at << ", tick " << tick;
      }
    }
  });
}

}  // namespace
}  // namespace kb::tables
