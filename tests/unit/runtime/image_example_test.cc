// The example at the top of image.h, with no more headers than it names, on the image of watch.kb beside this file.
#include <waymark/runtime/engine.h>
#include <waymark/runtime/image.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

TEST(Image, IsOpenedAsItsHeaderShows) {
  std::ifstream file(WATCH_IMAGE, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::vector<std::uint64_t> aligned(text.size() / 8 + 1);
  std::memcpy(aligned.data(), text.data(), text.size());
  const void* const bytes = aligned.data();
  const std::size_t size = text.size();

  mts::ImageInfo info;
  ASSERT_EQ(mts::peek_image(bytes, size, info), mts::ImageStatus::kOk);
  ASSERT_EQ(info.index_bytes, 2u);
  std::vector<mts::Word> scratch(info.scratch_words);
  std::vector<std::uint64_t> memory(static_cast<std::size_t>(info.state_bytes) / 8 + 1);
  auto* const block = reinterpret_cast<std::byte*>(memory.data());

  mts::Image<std::uint16_t> image;
  const auto status = mts::open_image(bytes, size, scratch.data(), info.scratch_words, image);
  ASSERT_EQ(status, mts::ImageStatus::kOk) << mts::text(status);
  mts::DynamicState<std::uint16_t> state;
  state.attach(image.tables.shape, block);
  mts::Engine engine(mts::DynamicTables(image.tables), state);
  engine.reset();
  engine.advance(20'000);
  EXPECT_EQ(state.ticks, 1u);
  EXPECT_EQ(image.find(mts::ImageKind::kStrategy, "Flee"), 2u);
}

}  // namespace
