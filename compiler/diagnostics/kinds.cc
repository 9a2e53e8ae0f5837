#include <fmt/format.h>

#include <array>
#include <utility>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/numbers.h"

namespace kb::diagnostics {
namespace {

// The length is written because clang deduces none above 256.
constexpr std::array<KindInfo, static_cast<std::size_t>(Kind::kCount_)> kKinds = {{
#define KB_ERROR(name, code, text) KindInfo{#name, code, Severity::kError, "", text},
#define KB_WARNING(name, code, flag, text) KindInfo{#name, code, Severity::kWarning, flag, text},
#define KB_NOTE(name, text) KindInfo{#name, 0, Severity::kNote, "", text},
#include "compiler/diagnostics/kinds.def"
#undef KB_ERROR
#undef KB_WARNING
#undef KB_NOTE
}};

constexpr bool codes_are_unique() {
  std::array<bool, 10'000> seen{};
  std::array<std::string_view, kKinds.size()> flags{};
  std::size_t count = 0;
  for (const KindInfo& kind : kKinds) {
    if (kind.code != 0 && std::exchange(seen[kind.code], true)) return false;
    if (kind.flag.empty()) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (flags[i] == kind.flag) return false;
    }
    flags[count++] = kind.flag;
  }
  return true;
}
static_assert(codes_are_unique(), "two messages share a code or a flag; the unit test of this folder names them");

}  // namespace

const KindInfo& info(Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::optional<Kind> find_code(std::string_view code) {
  const bool prefixed = code.size() > 2 && (code[0] == 'K' || code[0] == 'k') && (code[1] == 'B' || code[1] == 'b');
  if (prefixed) code.remove_prefix(2);
  unsigned number = 0;
  if (!source::read_number(code, number) || number == 0) return std::nullopt;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].code == number) return static_cast<Kind>(i);
  }
  return std::nullopt;
}

std::optional<Kind> find_flag(std::string_view flag) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (!flag.empty() && kKinds[i].flag == flag) return static_cast<Kind>(i);
  }
  return std::nullopt;
}

std::vector<std::string_view> flags() {
  std::vector<std::string_view> all;
  for (const KindInfo& kind : kKinds) {
    if (!kind.flag.empty()) all.push_back(kind.flag);
  }
  return all;
}

std::string code_text(Kind kind) { return fmt::format("KB{:04}", info(kind).code); }

}  // namespace kb::diagnostics
