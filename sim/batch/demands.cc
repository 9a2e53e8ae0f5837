#include "sim/batch/demands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "sim/batch/batch.h"

namespace kb::sim::batch {
namespace {

struct Written { std::string_view text; Demand::Sign sign; };
constexpr std::array kSigns{Written{">=", Demand::Sign::kAtLeast}, Written{"<=", Demand::Sign::kAtMost}, Written{">", Demand::Sign::kAbove},
                            Written{"<", Demand::Sign::kBelow}, Written{"=", Demand::Sign::kExactly}};

// A percentage of so many decimal places, multiplied by kMostRuns, still fits in 64 bits.
constexpr std::size_t kMostPlaces = 9;
static_assert(kMostRuns * 100u <= UINT64_MAX / 1'000'000'000u);

/// Reads `64.4` as 644 and 10: no double is that number.
bool read_decimal(std::string_view text, std::uint64_t& number, std::uint64_t& scale) {
  const std::size_t point = text.find('.');
  std::string_view places = point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  while (places.ends_with('0')) places.remove_suffix(1);
  if (places.size() > kMostPlaces) return false;
  for (std::size_t i = 0; i < places.size(); ++i) scale *= 10;
  return source::read_number(fmt::format("{}{}", text.substr(0, point), places), number);
}

std::optional<Demand> read_demand(std::string_view text, std::span<const std::string_view> names, std::string& why) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos) {
    why = fmt::format("`{}` has no number behind `>=`, `<=`, `>`, `<` or `=`", text);
    return std::nullopt;
  }
  const Written& sign = *std::find_if(kSigns.begin(), kSigns.end(), [&](const Written& one) { return text.substr(at).starts_with(one.text); });
  const std::string_view name = source::trimmed(text.substr(0, at));
  std::string_view number = source::trimmed(text.substr(at + sign.text.size()));
  Demand demand{sign.sign, std::string(text), 0, 0, 1, number.ends_with('%')};
  if (demand.share) number = source::trimmed(number.substr(0, number.size() - 1));
  const auto kind = std::find(names.begin(), names.end(), name);
  const bool good = read_decimal(number, demand.number, demand.scale) && (demand.share ? demand.number <= 100 * demand.scale : demand.scale == 1);
  if (kind == names.end()) why = fmt::format("nothing is counted that is called `{}`, but `{}`", name, fmt::join(names, "`, `"));
  else if (!good) why = fmt::format("`{}` wants a whole number of runs, or percent up to 100% with at most {} decimal places", text, kMostPlaces);
  if (kind == names.end() || !good) return std::nullopt;
  demand.kind = static_cast<std::size_t>(kind - names.begin());
  return demand;
}

}  // namespace

std::optional<std::vector<Demand>> read_demands(std::string_view text, std::span<const std::string_view> names, std::string& why) {
  std::vector<Demand> demands;
  for (const std::string_view part : source::split(text, ',')) {
    auto demand = read_demand(source::trimmed(part), names, why);
    if (!demand) return std::nullopt;
    demands.push_back(std::move(*demand));
  }
  return demands;
}

bool holds(const Demand& demand, std::size_t count, std::size_t runs) {
  // Both sides are multiplied by the number of runs, so that they are whole numbers: a share such as 1/3 has no exact decimals.
  const std::uint64_t found = count * (demand.share ? 100 * demand.scale : 1);
  const std::uint64_t wanted = demand.number * (demand.share ? runs : 1);
  switch (demand.sign) {
    case Demand::Sign::kAtLeast: return found >= wanted;
    case Demand::Sign::kAtMost: return found <= wanted;
    case Demand::Sign::kAbove: return found > wanted;
    case Demand::Sign::kBelow: return found < wanted;
    case Demand::Sign::kExactly: return found == wanted;
  }
  return false;
}

Unmet unmet_by(const Demand& demand, std::size_t row, std::size_t count, std::size_t runs) {
  return {row, demand.text, fmt::format("{} of {} runs ({})", count, runs, percent(count, runs))};
}

}  // namespace kb::sim::batch
