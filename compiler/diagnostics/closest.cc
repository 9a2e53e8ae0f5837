#include <algorithm>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/diagnostics/look_alike.h"
#include "compiler/source/encoding.h"

namespace kb::diagnostics {
namespace {

using source::lower;

/// The longest word that is compared letter by letter. Longer names are not mistyped as one another.
constexpr std::size_t kMaxCompared = 128;

/// Optimal string alignment distance, ASCII case ignored; anything above `limit` is `limit + 1`.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (a.size() > b.size() + limit || b.size() > a.size() + limit) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
      least = std::min(least, now[j]);
    }
    if (least > limit) return limit + 1;
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

/// The shortest candidate that begins with the word (`strategy` for `strat`), or has it as its member (`Wall.front` for `front`).
std::optional<std::string> abbreviated(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr std::size_t kFewest = 3;
  std::optional<std::string> found;
  for (const std::string_view candidate : candidates) {
    if (word.size() < kFewest || candidate.size() <= word.size()) continue;
    const std::string_view rest = candidate.substr(0, candidate.size() - word.size());
    const bool member = candidate.ends_with(word) && rest.ends_with('.');
    if (!member && !candidate.starts_with(word)) continue;
    if (!found || candidate.size() < found->size()) found = std::string(candidate);
  }
  return found;
}

}  // namespace

std::optional<std::string> closest(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > kMaxCompared) return std::nullopt;
  const std::string seen = appearance(word);
  for (const std::string_view candidate : candidates) {
    if (!candidate.empty() && candidate != word && appearance(candidate) == seen) return std::string(candidate);
  }
  std::size_t best = 2 + word.size() / 4;   // one more than the largest distance that counts
  std::optional<std::string> found;
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate == word) continue;
    const std::size_t d = distance(word, candidate, best - 1);
    // Half of the letters must agree; otherwise it is a different word: `Gate` is not a slip of `Safe`.
    if (d >= best || 2 * d >= std::max(word.size(), candidate.size())) continue;
    best = d;
    found = std::string(candidate);
    if (best == 0) break;
  }
  return found ? found : abbreviated(word, candidates);
}

bool is_slip_of(std::string_view written, std::string_view meant) {
  if (written == meant) return false;
  if (look_alike(written, meant)) return true;
  if (meant.size() < 4) return false;
  const std::string_view shorter = written.size() < meant.size() ? written : meant, longer = written.size() < meant.size() ? meant : written;
  if (longer.size() - shorter.size() > 1) return false;
  std::size_t at = 0;
  while (at < shorter.size() && shorter[at] == longer[at]) ++at;
  if (source::is_digit(longer[at]) && (longer.size() > shorter.size() || source::is_digit(shorter[at]))) return false;
  if (longer.size() > shorter.size()) return shorter.substr(at) == longer.substr(at + 1);
  const bool swapped = at + 1 < longer.size() && shorter[at] == longer[at + 1] && shorter[at + 1] == longer[at] && shorter.substr(at + 2) == longer.substr(at + 2);
  return swapped || shorter.substr(at + 1) == longer.substr(at + 1);
}

}  // namespace kb::diagnostics
