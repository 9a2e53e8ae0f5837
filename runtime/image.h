// A knowledge base as a file (.kbt), verified and used in place. Freestanding: no heap, no exceptions, no recursion.
// `kbc compile --emit image` writes such files, docs/image.md describes them, and runtime/swap.h exchanges them while the robot drives.
//
//   #include <waymark/runtime/engine.h>                          // what runs on it
//   #include <waymark/runtime/image.h>
//
//   mts::ImageInfo info;
//   if (mts::peek_image(bytes, size, info) != mts::ImageStatus::kOk) ...
//   mts::Image<std::uint16_t> image;                             // info.index_bytes == 2
//   const auto status = mts::open_image(bytes, size, scratch, info.scratch_words, image);
//   if (status != mts::ImageStatus::kOk) return mts::text(status);
//   mts::DynamicState<std::uint16_t> state;
//   state.attach(image.tables.shape, block);                     // info.state_bytes bytes
//   mts::Engine engine(mts::DynamicTables(image.tables), state);
//   engine.reset();
//
// note [what a verified image promises]
// An image is treated as a hostile file. Every count is checked against the size, every index against its limit, every list for its order,
// and every derived table against those it is derived from. The engine over a verified image therefore accesses only its own memory,
// finishes every tick, and meets no NaN. Whether the rules make sense cannot be verified.
// Time: linear in the size of the file. The conditions of a rule (96 at most) are compared with each other, and each is looked up in the
// lists of their readers in log2(length) steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "crc32c.h"
#include "image_check_cells.h"
#include "image_check_names.h"
#include "image_check_rules.h"
#include "image_layout.h"
#include "image_status.h"
#include "state.h"

namespace mts {

/// Largest image in bytes, chosen so that sums of counts cannot overflow.
inline constexpr std::uint32_t kMaxImageBytes = 1u << 30;

/// What you need to know before you open an image.
struct ImageInfo {
  std::uint32_t index_bytes = 0;    ///< 2: open it as Image<std::uint16_t>; 4: as Image<std::uint32_t>
  std::uint32_t scratch_words = 0;  ///< working memory of `open_image`, in words; never more than `state_bytes / 4`
  std::uint64_t state_bytes = 0;    ///< of DynamicState's block
  Shape shape;
};

enum class ImageKind : std::uint8_t { kFact, kSatellite, kStrategy, kRule, kLevel };

/// A verified image. The tables point into its bytes, which must neither move nor change.
template <class Ix>
struct Image {
  Tables<Ix> tables;
  image::NameTables names;

  /// Number of the first name of a kind, and how many there are.
  struct Range { std::uint32_t first, count; };
  [[nodiscard]] constexpr Range range(ImageKind kind) const {
    const Shape& n = tables.shape;
// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
    switch (kind) {
      case ImageKind::kFact: return {0, n.facts};
      case ImageKind::kSatellite: return {n.facts, n.satellites};
      case ImageKind::kStrategy: return {n.facts + n.satellites, n.strategies};
      case ImageKind::kRule: return {n.cells(), n.rules};
      case ImageKind::kLevel: return {n.cells() + n.rules, n.levels};
    }
#pragma GCC diagnostic pop
    return {0, 0};
  }
  /// The name of thing `i` of the kind, i < range(kind).count. UTF-8, ends with a zero byte.
  [[nodiscard]] const char* name(ImageKind kind, std::uint32_t i) const { return names.bytes + names.begin[range(kind).first + i]; }
  /// The number of the thing with this name, or the `count` of the kind if there is none. Cost: log2(count) comparisons.
  [[nodiscard]] std::uint32_t find(ImageKind kind, const char* wanted) const {
    const Range all = range(kind);
    std::uint32_t low = all.first, high = all.first + all.count;
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      const int order = image::compare(names.bytes + names.begin[names.order[middle]], wanted);
      if (order == 0) return names.order[middle] - all.first;
      if (order < 0) low = middle + 1;
      else high = middle;
    }
    return all.count;
  }
};

/// Whether `open_image` computes the checksum. `kTrust` is for tests and fuzzing, which compute it in another way.
enum class Checksum : std::uint8_t { kVerify, kTrust };

/// Reads and checks the head (mark, versions, size), not the checksum. Cost: constant.
[[nodiscard]] inline ImageStatus peek_image(const void* bytes, std::size_t size, ImageInfo& info);

/// The length of the image at the beginning of a flash slot, to pass to `peek_image` and other functions that take a length. The slot may
/// be longer; what follows the image is not read. 0 if no image begins there: the slot is erased or holds something else, the machine is big-endian, or the length in
/// the head exceeds the slot or does not match its counts. The head is treated as hostile; tables and checksum are left to `open_image`.
/// `bytes` must be aligned to 4. Cost: constant.
[[nodiscard]] inline std::size_t image_length(const void* bytes, std::size_t slot_size);

/// Verifies an image and makes `out` a view of it. `scratch` may be the block of the state that will run on the image; its contents
/// afterwards are meaningless. Any result but kOk leaves `out` as it was.
template <class Ix>
[[nodiscard]] ImageStatus open_image(const void* bytes, std::size_t size, Word* scratch, std::size_t scratch_words, Image<Ix>& out,
                                     Checksum checksum = Checksum::kVerify);

namespace image {

/// Whether no count is larger than the file can hold, so that no sum of counts overflows.
[[nodiscard]] constexpr bool counts_fit(const ImageHead& h) {
  const std::uint32_t most = h.bytes / 2;
  const Shape& n = h.shape;
  for (const std::uint32_t count : {n.facts, n.satellites, n.strategies, n.atoms, n.rules, n.words, n.nodes, n.timers, n.queues,
                                    n.levels, n.groups, n.group_members, h.readers, h.parents, h.attends, h.stages,
                                    h.conditions, h.writes, h.clears, h.values, h.children}) {
    if (count > most) return false;
  }
  if (n.contested > h.bytes || h.name_bytes > h.bytes || (h.broad != 0 && h.broad != n.atoms)) return false;
  if (!h.has_conflicts() && h.children != 0) return false;
  if (n.groups > n.group_members || n.group_members > n.satellites) return false;
  return n.atoms >= 2 && std::uint64_t{n.nodes} + n.timers + 2 <= n.atoms;
}

[[nodiscard]] inline ImageStatus head_fits(const ImageHead& h, std::size_t size) {
  for (int i = 0; i < 4; ++i) {
    if (h.magic[i] != kImageMagic[i]) return ImageStatus::kNotAnImage;
  }
  if constexpr (std::endian::native != std::endian::little) return ImageStatus::kByteOrder;
  if (h.form != kImageForm) return ImageStatus::kOtherForm;
  if (h.abi != kAbi) return ImageStatus::kOtherAbi;
  if (h.bytes != size || h.bytes > kMaxImageBytes || !counts_fit(h)) return ImageStatus::kWrongSize;
  if (h.index_bytes != (is_narrow(h) ? 2u : 4u)) return ImageStatus::kOtherWidth;
  return image_bytes(h) == size ? ImageStatus::kOk : ImageStatus::kWrongSize;
}

[[nodiscard]] inline std::uint32_t checksum_of(const void* bytes, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(bytes);
  constexpr std::size_t kPlace = offsetof(ImageHead, checksum), kBehind = kPlace + sizeof(std::uint32_t);
  Crc32c crc;
  crc.take(at, kPlace);
  crc.take_zeros(sizeof(std::uint32_t));
  crc.take(at + kBehind, size - kBehind);
  return crc.value();
}

[[nodiscard]] constexpr std::uint32_t scratch_words(const Shape& n) {
  std::uint32_t most = n.satellites;
  for (const std::uint32_t count : {n.nodes, n.strategies, n.groups}) most = count > most ? count : most;
  return most;
}

/// Points the tables into the bytes. False if bytes between two sections are not zero.
template <class Ix>
[[nodiscard]] bool attach(const ImageHead& h, const std::uint8_t* at, Image<Ix>& out) {
  const Shape& n = h.shape;
  Tables<Ix>& tables = out.tables;
  std::uint8_t slack = 0;
  const auto section = [&]<class T>(T*& member, std::uint64_t length) {
    member = length == 0 ? nullptr : static_cast<T*>(static_cast<const void*>(at));
    const std::uint64_t bytes = length * sizeof(T);
    at += bytes;
    for (std::uint64_t i = bytes; i % 4 != 0; ++i) slack |= *at++;
  };
#define KB_ARRAY(name, type, length) section(tables.name, length);
  MTS_IMAGE_TABLES(KB_ARRAY)
#undef KB_ARRAY
#define KB_ARRAY(name, type, length) section(out.names.name, length);
  MTS_IMAGE_NAMES(KB_ARRAY)
#undef KB_ARRAY
  return slack == 0;
}

/// Bytes within rows that no member covers.
template <class Ix>
[[nodiscard]] bool rows_are_tight(const Subject<Ix>& s) {
  if constexpr (sizeof(Ix) == sizeof(Word)) return true;
  const auto byte_pair_is_zero = [](const void* row, std::size_t at) {
    const auto* bytes = static_cast<const std::uint8_t*>(row) + at;
    return bytes[0] == 0 && bytes[1] == 0;
  };
  for (std::uint32_t i = 0; i < s.h.readers; ++i) if (!byte_pair_is_zero(s.t.readers + i, 2)) return false;
  for (std::uint32_t i = 0; i < s.n().facts; ++i) if (!byte_pair_is_zero(s.t.fact_atoms + i, 6)) return false;
  return true;
}

[[nodiscard]] inline bool settings_fit(const ImageHead& h) {
  if (!(h.firing > 0.0f && h.firing <= 1.0f) || h.idle > static_cast<std::uint32_t>(Idle::kStrategy)) return false;
  const bool named = h.idle == static_cast<std::uint32_t>(Idle::kStrategy);
  return named ? h.idle_strategy < h.shape.strategies : h.idle_strategy == 0;
}

/// Checks all tables, each after those that are needed to read it.
template <class Ix>
[[nodiscard]] ImageStatus tables_fit(const Subject<Ix>& s, const NameTables& names) {
  using S = ImageStatus;
  const Shape& n = s.n();
  if (!settings_fit(s.h)) return S::kSettings;
  if (!rows_are_tight(s)) return S::kPadding;
  if (!levels_fit(s)) return S::kLevels;
  if (!rules_fit(s)) return S::kRules;
  if (!atom_lists_fit(s) || !broad_fits(s)) return S::kReaders;
  if (const S status = readers_fit(s); status != S::kOk) return status;
  if (!writes_fit(s)) return S::kWrites;
  if (!contested_fits(s)) return S::kContested;
  if (!atoms_fit(s)) return S::kAtoms;
  if (!facts_fit(s)) return S::kFacts;
  if (!lists_fit(s.t.attends_begin, n.satellites, s.t.attends, s.h.attends, n.facts)) return S::kAttention;
  if (!timers_fit(s) || !timer_inputs_fit(s)) return S::kTimers;
  if (!initial_fits(s)) return S::kInitial;
  if (const S status = nodes_fit(s); status != S::kOk) return status;
  if (!walks_fit(s)) return S::kNodes;
  if (!timers_are_ordered(s)) return S::kTimers;
  if (!groups_fit(s)) return S::kGroups;
  if (!priority_fits(s)) return S::kPriority;
  if (s.h.has_conflicts() && !(atom_terms_fit(s) && children_fit(s))) return S::kStrengths;
  return names_fit(s.h, names) ? S::kOk : S::kNames;
}

}  // namespace image

inline ImageStatus peek_image(const void* bytes, std::size_t size, ImageInfo& info) {
  if (bytes == nullptr || size < sizeof(ImageHead)) return ImageStatus::kTooShort;
  if (reinterpret_cast<std::uintptr_t>(bytes) % alignof(ImageHead) != 0) return ImageStatus::kMisaligned;
  const ImageHead& h = *static_cast<const ImageHead*>(bytes);
  const ImageStatus status = image::head_fits(h, size);
  if (status != ImageStatus::kOk) return status;
  info.index_bytes = h.index_bytes;
  info.shape = h.shape;
  info.scratch_words = image::scratch_words(h.shape);
  info.state_bytes = h.index_bytes == 2 ? DynamicState<std::uint16_t>::bytes(h.shape) : DynamicState<std::uint32_t>::bytes(h.shape);
  return ImageStatus::kOk;
}

inline std::size_t image_length(const void* bytes, std::size_t slot_size) {
  if (bytes == nullptr || slot_size < sizeof(ImageHead) || reinterpret_cast<std::uintptr_t>(bytes) % alignof(ImageHead) != 0) return 0;
  const std::uint32_t length = static_cast<const ImageHead*>(bytes)->bytes;
  ImageInfo info;
  return length <= slot_size && peek_image(bytes, length, info) == ImageStatus::kOk ? length : 0;
}

template <class Ix>
ImageStatus open_image(const void* bytes, std::size_t size, Word* scratch, std::size_t scratch_words, Image<Ix>& out,
                       Checksum checksum) {
  ImageInfo info;
  if (const ImageStatus status = peek_image(bytes, size, info); status != ImageStatus::kOk) return status;
  const ImageHead& h = *static_cast<const ImageHead*>(bytes);
  if (info.index_bytes != sizeof(Ix)) return ImageStatus::kOtherWidth;
  if (checksum == Checksum::kVerify && image::checksum_of(bytes, size) != h.checksum) return ImageStatus::kWrongChecksum;
  if (scratch == nullptr) scratch_words = 0;
  if (scratch_words < info.scratch_words) return ImageStatus::kNoScratch;
  for (std::uint32_t i = 0; i < info.scratch_words; ++i) scratch[i] = 0;
  Image<Ix> made;
  if (!image::attach(h, static_cast<const std::uint8_t*>(bytes) + sizeof(ImageHead), made)) return ImageStatus::kPadding;
  made.tables.abi = h.abi;
  made.tables.shape = h.shape;
  made.tables.firing = h.firing;
  made.tables.idle = static_cast<Idle>(h.idle);
  made.tables.idle_strategy = static_cast<Ix>(h.idle_strategy);
  made.tables.hold_limit_us = h.hold_limit_us;
  const ImageStatus status = image::tables_fit(image::Subject<Ix>{h, made.tables, scratch}, made.names);
  if (status == ImageStatus::kOk) out = made;
  return status;
}

}  // namespace mts
