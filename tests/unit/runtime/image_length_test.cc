// How long the image is that a slot of flash begins with: that of watch.kb beside this file.
#include <waymark/runtime/image.h>

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using mts::ImageStatus;

const std::string& image_bytes() {
  static const std::string bytes = [] {
    std::ifstream file(WATCH_IMAGE, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return bytes;
}

/// The image where flash would hold it, in a slot that is longer.
class Slot {
 public:
  Slot() : words_(image_bytes().size() / 8 + 100, 0xFFFF'FFFF'FFFF'FFFFu) { std::memcpy(words_.data(), image_bytes().data(), image_bytes().size()); }
  [[nodiscard]] std::uint8_t* data() { return reinterpret_cast<std::uint8_t*>(words_.data()); }
  [[nodiscard]] std::size_t size() const { return words_.size() * 8; }

 private:
  std::vector<std::uint64_t> words_;
};

TEST(ImageLength, IsThatOfTheImageWhichASlotBeginsWith) {
  Slot slot;
  const std::size_t size = image_bytes().size();
  EXPECT_EQ(mts::image_length(slot.data(), slot.size()), size);
  EXPECT_EQ(mts::image_length(slot.data(), size), size) << "a slot that it fills";
  mts::ImageInfo info;
  EXPECT_NE(mts::peek_image(slot.data(), slot.size(), info), ImageStatus::kOk) << "what it is there for";
}

TEST(ImageLength, IsNoneWhereNoImageBegins) {
  Slot slot;
  for (std::size_t length = 0; length < image_bytes().size(); ++length) {
    ASSERT_EQ(mts::image_length(slot.data(), length), 0u) << "a slot that is too short, by all its lengths";
  }
  EXPECT_EQ(mts::image_length(slot.data() + 2, slot.size() - 2), 0u) << "not aligned";
  std::memset(slot.data(), 0xFF, slot.size());
  EXPECT_EQ(mts::image_length(slot.data(), slot.size()), 0u) << "erased";
  std::memset(slot.data(), 0, slot.size());
  EXPECT_EQ(mts::image_length(slot.data(), slot.size()), 0u);
}

TEST(ImageLength, IsNeverMoreThanTheSlotWhateverTheHeadSays) {
  for (std::size_t byte = 0; byte < sizeof(mts::ImageHead); ++byte) {
    for (unsigned value = 0; value < 256; ++value) {
      Slot slot;
      slot.data()[byte] = static_cast<std::uint8_t>(value);
      const std::size_t length = mts::image_length(slot.data(), slot.size());
      ASSERT_LE(length, slot.size());
      ASSERT_TRUE(length == 0 || length == image_bytes().size() || byte >= 24) << "byte " << byte << " = " << value;
    }
  }
}

/// As docs/image.md lays an image in flash.
alignas(8) constexpr unsigned char kInFlash[] = {0x8A, 0x4B, 0x42, 0x54, 0, 0, 0, 0};

TEST(ImageLength, IsAskedOfAnArrayThatIsAligned) {
  EXPECT_EQ(mts::image_length(kInFlash, sizeof kInFlash), 0u) << "cut off";
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kInFlash) % alignof(mts::ImageHead), 0u);
}

}  // namespace
