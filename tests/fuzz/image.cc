// Any bytes as an image. What is accepted runs, and is swapped for itself. How the first byte differs from an image's says more:
//   bit 0  the checksum counts; else it is taken as right, so that the checks of the structure are reached
//   bit 1  mark, versions, size and width of the head are mended
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <waymark/runtime/swap.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

template <class I>
struct Running {
  using State = mts::DynamicState<I>;
  mts::Image<I> image;
  State state;
  std::vector<std::uint64_t> memory;
  mts::Engine<State, mts::DynamicTables<I>> engine() { return {mts::DynamicTables<I>(image.tables), state}; }
  void attach() {
    memory.assign(State::bytes(image.tables.shape) / 8 + 1, 0);
    state.attach(image.tables.shape, reinterpret_cast<std::byte*>(memory.data()));
  }
  void tick(std::uint32_t number) {
    static constexpr float kValues[] = {1.0f, -1.0f, 0.5f, 0.0f};
    for (std::uint32_t f = 0; f < image.tables.shape.facts; ++f) engine().take_fact(f, kValues[(f * 7 + number * (f + 1)) % 4]);
    engine().advance(100'000);
  }
};

template <class I>
void run(const void* bytes, std::size_t size, const mts::ImageInfo& info, mts::Checksum checksum) {
  Running<I> one, two;
  std::vector<mts::Word> scratch(info.scratch_words);
  if (mts::open_image(bytes, size, scratch.data(), scratch.size(), one.image, checksum) != mts::ImageStatus::kOk) return;
  if (info.state_bytes > 1u << 20) return;
  one.attach();
  one.engine().reset();
  for (std::uint32_t i = 0; i < 3; ++i) one.tick(i);
  two.image = one.image;
  two.attach();
  const auto report = mts::carry_over(one.image, one.state, two.image, two.state, [](const mts::SwapLoss&) {});
  if (report.told != 0) std::abort();
  for (std::uint32_t i = 3; i < 6; ++i) {
    one.tick(i);
    two.tick(i);
    if (one.state.strategy != two.state.strategy || one.state.fired != two.state.fired || one.state.status != two.state.status) std::abort();
    for (std::uint32_t c = 0; c < one.image.tables.shape.cells(); ++c) {
      if (one.state.cf[c] != two.state.cf[c]) std::abort();
    }
  }
}

void mend_head(std::vector<std::uint64_t>& memory, std::size_t size) {
  mts::ImageHead& h = *reinterpret_cast<mts::ImageHead*>(memory.data());
  std::memcpy(h.magic, mts::kImageMagic, sizeof h.magic);
  h.form = mts::kImageForm;
  h.abi = mts::kAbi;
  h.bytes = static_cast<std::uint32_t>(size);
  h.index_bytes = mts::is_narrow(h) ? 2 : 4;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto mode = static_cast<std::uint8_t>(data[0] ^ mts::kImageMagic[0]);
  std::vector<std::uint64_t> memory(size / 8 + 1);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(memory.data());
  std::copy_n(data, size, bytes);
  bytes[0] = mts::kImageMagic[0];
  if (size >= sizeof(mts::ImageHead) && (mode & 2u) != 0) mend_head(memory, size);
  const mts::Checksum checksum = (mode & 1u) != 0 ? mts::Checksum::kVerify : mts::Checksum::kTrust;
  mts::ImageInfo info;
  if (mts::peek_image(memory.data(), size, info) != mts::ImageStatus::kOk) return 0;
  if (info.index_bytes == 2) run<std::uint16_t>(memory.data(), size, info, checksum);
  else run<std::uint32_t>(memory.data(), size, info, checksum);
  return 0;
}
