// `kbc dump image`: the head, the sections, the names.
#include <fmt/format.h>

#include <iterator>

#include "compiler/tables/image.h"

namespace kb::tables {
namespace {

using ImageOut = std::back_insert_iterator<std::string>;

template <class Ix>
void print_sections(ImageOut out, const mts::ImageHead& h) {
  const mts::Shape& n = h.shape;
  std::uint64_t at = sizeof h;
  const auto section = [&](std::string_view name, std::uint64_t count, std::size_t row) {
    fmt::format_to(out, "section {} at={} rows={} bytes={}\n", name, at, count, count * row);
    at += (count * row + 3) & ~std::uint64_t{3};
  };
#define X(name, type, length) section(#name, length, sizeof(type));
  MTS_IMAGE_TABLES(X)
#undef X
#define X(name, type, length) section("names." #name, length, sizeof(type));
  MTS_IMAGE_NAMES(X)
#undef X
}

template <class View>
void print_names(ImageOut out, const View& view) {
  const auto all = [&](std::string_view what, mts::ImageKind kind) {
    for (std::uint32_t i = 0; i < view.range(kind).count; ++i) fmt::format_to(out, "{} {} {}\n", what, i, view.name(kind, i));
  };
  all("fact", mts::ImageKind::kFact);
  all("satellite", mts::ImageKind::kSatellite);
  all("strategy", mts::ImageKind::kStrategy);
  all("level", mts::ImageKind::kLevel);
  all("rule", mts::ImageKind::kRule);
  for (std::uint32_t i = 0; i < view.tables.shape.timers; ++i) {
    fmt::format_to(out, "timer {} {:08x}{:08x}\n", i, view.names.timer_key[i].high, view.names.timer_key[i].low);
  }
}

}  // namespace

std::string print_image(const LoadedImage& image) {
  const mts::ImageHead& h = image.head();
  std::string text;
  const ImageOut out(text);
  const mts::Shape& n = h.shape;
  fmt::format_to(out, "image form={} abi={} checksum={:08x} bytes={} index={}\n", h.form, h.abi, h.checksum, h.bytes, 8 * h.index_bytes);
  fmt::format_to(out, "image facts={} satellites={} strategies={} atoms={} rules={} words={} nodes={} timers={} queues={} levels={} groups={} "
                 "group_members={} contested={}\n", n.facts, n.satellites, n.strategies, n.atoms, n.rules, n.words, n.nodes, n.timers,
                 n.queues, n.levels, n.groups, n.group_members, n.contested);
  fmt::format_to(out, "image firing={} idle={} idle_strategy={} hold_limit_us={}\n", h.firing, h.idle, h.idle_strategy, h.hold_limit_us);
  const std::size_t state = h.index_bytes == 2 ? mts::DynamicState<std::uint16_t>::bytes(n) : mts::DynamicState<std::uint32_t>::bytes(n);
  fmt::format_to(out, "image state_bytes={} scratch_words={}\n", state, mts::image::scratch_words(n));
  if (h.index_bytes == 2) print_sections<std::uint16_t>(out, h);
  else print_sections<std::uint32_t>(out, h);
  image.visit([&](const auto& view) { print_names(out, view); });
  return text;
}

}  // namespace kb::tables
