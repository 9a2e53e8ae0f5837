// Uses everything that images offer to a program, so that all of it is compiled without a standard library.
#include <waymark/runtime/image_mind.h>

namespace {

alignas(8) std::byte memory[2][1024];
mts::ImageMind every;
mts::SmallImageMind narrow;

template <class Mind>
int probe(Mind& mind, const void* bytes, unsigned size, float value) {
  mts::SwapReport report;
  int sum = 0;
  const auto lost = [&sum](const mts::SwapLoss& loss) { sum += mts::text(loss.what)[0] + loss.name[0]; };
  std::byte* block = mind.block() == memory[0] ? memory[1] : memory[0];
  const mts::ImageStatus status = mind.take(bytes, size, block, sizeof memory[0], report, lost);
  if (!mind.has_image()) return mts::text(status)[0];
  mind.set_fact(mind.find(mts::ImageKind::kFact, "Line"), value);
  mind.tick(mts::milliseconds(20));
  for (const std::uint32_t rule : mind.fired()) sum += static_cast<int>(rule);
  for (const std::uint32_t fact : mind.events()) sum += static_cast<int>(fact);
  for (const auto change : mind.changed()) sum += change.value > 0.0f ? 1 : 0;
  for (const auto conflict : mind.conflicts()) sum += static_cast<int>(conflict.cell);
  sum += static_cast<int>(mind.lost().size() + mind.active().size() + mind.bad_facts()) + static_cast<int>(mind.time_us());
  if (mind.high(0) || mind.ran(0) || mind.attended(0) || mind.holding() || mind.hold_expired()) mind.reset();
  sum += mind.drives() ? mind.strategy_name()[0] : 0;
  return sum + static_cast<int>(mind.count(mts::ImageKind::kRule) + report.told) + static_cast<int>(mind.status());
}

}  // namespace

template class mts::Transplant<std::uint16_t, std::uint32_t>;
template class mts::Transplant<std::uint32_t, std::uint16_t>;

extern "C" int freestanding_probe_image(const void* bytes, unsigned size, float value) {
  size = static_cast<unsigned>(mts::image_length(bytes, size));
  return probe(every, bytes, size, value) + probe(narrow, bytes, size, value);
}
