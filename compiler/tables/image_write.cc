// From tables to bytes, one section after another.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <future>
#include <numeric>
#include <span>

#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"
#include "compiler/tables/timer_keys.h"

namespace kb::tables {
namespace {

using program::Program;

/// Collects little-endian bytes. Indexes have the chosen width.
class ImageBytes {
 public:
  ImageBytes(bool narrow, std::size_t bytes) : narrow_(narrow) { bytes_.reserve(bytes); }

  void word(std::uint32_t x) {
    align();
    const char four[] = {static_cast<char>(x & 0xFFu), static_cast<char>(x >> 8 & 0xFFu), static_cast<char>(x >> 16 & 0xFFu),
                         static_cast<char>(x >> 24)};
    bytes_.append(four, 4);
  }
  void real(float x) { word(std::bit_cast<std::uint32_t>(x)); }
  void byte(std::uint8_t x) { bytes_ += static_cast<char>(x); }
  void index(std::uint32_t x) {
    if (!narrow_) return word(x);
    byte(static_cast<std::uint8_t>(x & 0xFFu));
    byte(static_cast<std::uint8_t>(x >> 8));
  }
  void text(std::string_view x) { bytes_ += x; }
  /// Fills up to the next multiple of four: between sections, and before a word in a row of indexes.
  void align() {
    if (bytes_.size() % 4 != 0) bytes_.resize((bytes_.size() + 3) & ~std::size_t{3}, '\0');
  }
  std::string take() {
    align();
    return std::move(bytes_);
  }

  void row(const mts::Atom<I>& x) { index(x.readers), index(x.parents), index(x.timers); }
  void row(const mts::Readers<I>& x) { index(x.word), word(x.good[0]), word(x.good[1]), word(x.keyed); }
  void row(const mts::CellAtoms<I>& x) { index(x.high), index(x.low), index(x.zero); }
  void row(const mts::FactAtoms<I>& x) { index(x.seen), index(x.event), index(x.lost), real(x.plain), real(x.attended); }
  void row(const mts::Node<I>& x) { index(x.need); }
  void row(const mts::Timer<I>& x) { index(x.input), index(x.queue); }
  void row(const mts::Stage<I>& x) { index(x.first_timer), index(x.end_timer), index(x.first_queue), index(x.end_queue); }
  void row(const mts::Level<I>& x) { index(x.first_word), index(x.end_word), index(x.first_stage), index(x.end_stage); }
  void row(const mts::Rule<I>& x) { index(x.conditions), index(x.writes), index(x.clears); }
  void row(const mts::Write<I>& x) { index(x.cell), index(x.value); }
  void row(const mts::TimerKey& x) { word(x.high), word(x.low); }
  void row(float x) { real(x); }
  void row(std::uint8_t x) { byte(x); }

  template <class T>
  void rows(const std::vector<T>& items) {
    if (as_in_memory()) append(items, items.size());
    else for (const T& item : items) row(item);
    align();
  }
  void indexes(const std::vector<I>& items) {
    if (as_in_memory()) append(items, items.size());
    else for (const I item : items) index(item);
    align();
  }
  /// Writes the first `count` items; vectors of bits may have one word more.
  void words(const std::vector<std::uint32_t>& items, std::size_t count) {
    if (as_in_memory()) return append(items, count);
    for (std::size_t i = 0; i < count; ++i) word(items[i]);
  }

 private:
  /// Whether the compiler's tables in memory have the same bytes as in the image.
  [[nodiscard]] bool as_in_memory() const { return !narrow_ && std::endian::native == std::endian::little; }
  template <class T>
  void append(const std::vector<T>& items, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && (alignof(T) == alignof(I) || sizeof(T) == 1));
    align();
    bytes_.append(reinterpret_cast<const char*>(items.data()), count * sizeof(T));
  }

  bool narrow_;
  std::string bytes_;
};

/// Eight characters of a name as a number that sorts like them, with zeros after the end; no name contains a zero.
std::uint64_t eight_characters(std::string_view name, std::size_t from) {
  std::uint64_t key = 0;
  if (from + 8 <= name.size()) {
    for (std::size_t i = from; i < from + 8; ++i) key = key << 8 | static_cast<unsigned char>(name[i]);
    return key;
  }
  for (std::size_t i = from; i < from + 8; ++i) key = key << 8 | (i < name.size() ? static_cast<unsigned char>(name[i]) : 0u);
  return key;
}

struct Keyed { std::uint64_t key; std::uint32_t number; };

/// Sorts by key and keeps the order of equal keys: radix sort, the last byte first, without bytes that all keys share.
void sort_by_key(std::vector<Keyed>& items, std::vector<Keyed>& other) {
  constexpr std::size_t kFew = 256;
  if (items.size() < kFew) {
    return std::stable_sort(items.begin(), items.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  }
  std::uint64_t different = 0;
  for (const Keyed& item : items) different |= item.key ^ items.front().key;
  other.resize(items.size());
  for (unsigned shift = 0; shift < 64; shift += 8) {
    if ((different >> shift & 0xFFu) == 0) continue;
    std::array<std::size_t, 257> next{};
    for (const Keyed& item : items) ++next[(item.key >> shift & 0xFFu) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Keyed& item : items) other[next[item.key >> shift & 0xFFu]++] = item;
    items.swap(other);
  }
}

/// Sorts by name, and equal names by number, eight characters at a time. So names with long common beginnings (a million instances of one
/// rule) are compared as numbers, and each name is read once for each eight of its characters. `order` must be ascending.
void sort_by_name(const std::vector<std::string_view>& names, std::span<std::uint32_t> order) {
  struct Part { std::size_t begin, end, depth; };
  std::vector<Keyed> keyed, other;
  std::vector<Part> todo{{0, order.size(), 0}};
  while (!todo.empty()) {
    const auto [begin, end, depth] = todo.back();
    todo.pop_back();
    keyed.clear();
    keyed.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) keyed.push_back({eight_characters(names[order[i]], depth), order[i]});
    sort_by_key(keyed, other);
    for (std::size_t i = 0, next = 0; i < keyed.size(); i = next) {
      for (next = i; next < keyed.size() && keyed[next].key == keyed[i].key; ++next) order[begin + next] = keyed[next].number;
      if (next > i + 1 && (keyed[i].key & 0xFFu) != 0) todo.push_back({begin + i, begin + next, depth + 8});
    }
  }
}

std::vector<std::string_view> all_names(const Program& p) {
  std::vector<std::string_view> all;
  all.reserve(p.cells.size() + p.rules.size() + p.levels.size());
  for (const program::Cell& cell : p.cells) all.push_back(cell.name);
  for (const program::Rule& rule : p.rules) all.push_back(rule.name);
  for (const std::string& level : p.levels) all.push_back(level);
  return all;
}

/// Where each name begins, and where the last one ends. Each name is followed by a NUL.
std::vector<std::uint32_t> begins_of(const std::vector<std::string_view>& names) {
  std::vector<std::uint32_t> begin{0};
  begin.reserve(names.size() + 1);
  for (const std::string_view name : names) begin.push_back(begin.back() + static_cast<std::uint32_t>(name.size()) + 1);
  return begin;
}

/// The numbers of the names, sorted by name within each kind.
std::vector<std::uint32_t> order_of(const std::vector<std::string_view>& names, const Program& p) {
  std::vector<std::uint32_t> order(names.size());
  std::iota(order.begin(), order.end(), 0u);
  std::size_t at = 0;
  for (const std::size_t count : {std::size_t{p.facts}, std::size_t{p.satellites}, std::size_t{p.strategies}, p.rules.size(), p.levels.size()}) {
    sort_by_name(names, std::span(order).subspan(at, count));
    at += count;
  }
  return order;
}

/// The values in ascending order, which can be verified, and the writes that refer to them.
struct ImageValues {
  std::vector<float> values;
  std::vector<mts::Write<I>> writes;
};
ImageValues image_values(const Tables& t) {
  ImageValues out{t.values, t.writes};
  std::sort(out.values.begin(), out.values.end());
  std::vector<I> place;
  place.reserve(t.values.size());
  for (const float v : t.values) {
    place.push_back(static_cast<I>(std::lower_bound(out.values.begin(), out.values.end(), v) - out.values.begin()));
  }
  for (auto& write : out.writes) write.value = place[write.value];
  return out;
}

/// The children in ascending order. Minimum and maximum do not depend on the order.
std::vector<I> image_children(const Tables& t) {
  std::vector<I> children = t.children;
  for (std::size_t n = 0; n + 1 < t.child_begin.size(); ++n) {
    std::sort(children.begin() + static_cast<std::ptrdiff_t>(t.child_begin[n]),
              children.begin() + static_cast<std::ptrdiff_t>(t.child_begin[n + 1]));
  }
  return children;
}

void write_head(ImageBytes& out, const mts::ImageHead& h) {
  static_assert(std::is_trivially_copyable_v<mts::ImageHead>);
  std::uint32_t words[sizeof h / 4];
  std::memcpy(words, &h, sizeof h);
  for (const std::uint8_t byte : h.magic) out.byte(byte);
  for (std::size_t i = 1; i < std::size(words); ++i) out.word(words[i]);
}

std::vector<std::uint32_t> timer_order(const std::vector<mts::TimerKey>& keys) {
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a].before(keys[b]); });
  return order;
}

/// Writes the tables in the order of MTS_IMAGE_TABLES.
void write_tables(ImageBytes& out, const Tables& t) {
  const ImageValues values = image_values(t);
  out.rows(t.atoms);
  out.rows(t.readers);
  out.indexes(t.parents);
  out.indexes(t.timer_inputs);
  out.rows(t.broad);
  out.rows(t.cell_atoms);
  out.rows(t.fact_atoms);
  out.indexes(t.attends_begin);
  out.indexes(t.attends);
  out.rows(t.nodes);
  out.rows(t.timers);
  out.words(t.queue_us, t.queue_us.size());
  out.rows(t.stages);
  out.rows(t.levels);
  out.rows(t.rules);
  out.indexes(t.word_rule);
  out.words(t.while_rules, t.shape.words);
  out.words(t.reset_rules, t.shape.words);
  out.indexes(t.conditions);
  out.rows(values.writes);
  out.indexes(t.clears);
  out.rows(values.values);
  out.indexes(t.group_of);
  out.indexes(t.group_slot);
  out.indexes(t.group_begin);
  out.indexes(t.priority);
  out.rows(t.initial);
  out.words(t.keep, mts::Shape::words_for(t.shape.satellites));
  out.words(t.initial_truth, mts::Shape::words_for(t.shape.atoms));
  out.indexes(t.initial_count);
  out.indexes(t.child_begin);
  out.indexes(image_children(t));
  out.rows(t.is_and);
  out.indexes(t.atom_cell);
  out.rows(t.atom_term);
}

}  // namespace

mts::ImageHead image_head(const Tables& t, std::uint32_t name_bytes) {
  mts::ImageHead h{};
  std::copy(std::begin(mts::kImageMagic), std::end(mts::kImageMagic), h.magic);
  h.form = mts::kImageForm;
  h.abi = mts::kAbi;
  h.shape = t.shape;
  h.firing = t.firing;
  h.idle = static_cast<std::uint32_t>(t.idle);
  h.idle_strategy = t.idle_strategy;
  h.hold_limit_us = t.hold_limit_us;
  const auto length = [](const auto& items) { return static_cast<std::uint32_t>(items.size()); };
  h.readers = length(t.readers);
  h.parents = length(t.parents);
  h.broad = length(t.broad);
  h.attends = length(t.attends);
  h.stages = length(t.stages);
  h.conditions = length(t.conditions);
  h.writes = length(t.writes);
  h.clears = length(t.clears);
  h.values = length(t.values);
  h.children = length(t.children);
  h.name_bytes = name_bytes;
  h.index_bytes = mts::is_narrow(h) ? 2 : 4;
  return h;
}

std::string write_image(const Tables& t, const Program& p) {
  const std::vector<std::string_view> names = all_names(p);
  std::future<std::vector<std::uint32_t>> name_order = std::async(
      p.rules.size() >= kWorthAThread ? std::launch::async : std::launch::deferred, [&] { return order_of(names, p); });
  const std::vector<std::uint32_t> name_begins = begins_of(names);
  mts::ImageHead head = image_head(t, name_begins.back());
  const std::uint64_t bytes = mts::image_bytes(head);
  if (bytes > mts::kMaxImageBytes) return {};
  head.bytes = static_cast<std::uint32_t>(bytes);
  ImageBytes out(head.index_bytes == 2, bytes);
  write_head(out, head);
  write_tables(out, t);
  const std::vector<mts::TimerKey> keys = timer_keys(t, p);
  out.words(name_begins, name_begins.size());
  out.words(name_order.get(), names.size());
  out.rows(keys);
  const auto order = timer_order(keys);
  out.words(order, order.size());
  for (const std::string_view name : names) out.text(name), out.byte(0);
  std::string image = out.take();
  const std::uint32_t checksum = mts::image::checksum_of(image.data(), image.size());
  for (std::size_t i = 0; i < 4; ++i) image[offsetof(mts::ImageHead, checksum) + i] = static_cast<char>(checksum >> (8 * i) & 0xFFu);
  return image;
}

}  // namespace kb::tables
