#include "tools/kbc/trace/sighting.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/kbc/trace/json_number.h"

namespace kb::trace {
namespace {

using nlohmann::ordered_json;

std::string read_text(const Sighting::Part& part) {
  if (const float* number = std::get_if<float>(&part.reading)) return fmt::format("{:.4g}{}{}", *number, part.unit.empty() ? "" : " ", part.unit);
  const auto* const text = std::get_if<std::string>(&part.reading);
  return text != nullptr ? '"' + *text + '"' : "another text";
}

std::string line(const Sighting::Part& part) {
  if (!part.compares) return fmt::format("    {:<28} {:>6.3g}\n", part.condition, part.certainty);
  if (!part.read) return fmt::format("    {:<28}      0  no reading\n", part.condition);
  return fmt::format("    {:<28} {:>6.3g}  reads {}, {:g} s old\n", part.condition, part.certainty, read_text(part), part.age_s);
}

ordered_json json_part(const Sighting::Part& part) {
  if (!part.compares) return {{"fact", part.condition}, {"certainty", json_number(part.certainty)}};
  ordered_json out{{"compares", part.condition}, {"certainty", json_number(part.certainty)}, {"reading", nullptr}};
  if (const float* number = std::get_if<float>(&part.reading)) out["reading"] = json_number(*number);
  else if (const auto* text = std::get_if<std::string>(&part.reading)) out["reading"] = *text;
  if (!part.unit.empty()) out["unit"] = part.unit;
  if (part.read) out["age_s"] = part.age_s;
  return out;
}

}  // namespace

std::string print(const Sighting& sighting) {
  if (sighting.definition.empty()) return fmt::format("  given as {}, which counts as {}\n", sighting.certainty, sighting.counts_as);
  if (sighting.asleep) return fmt::format("`{}` is lazy and nobody waits for it on this tick: it is not looked at, and is 0\n", sighting.fact);
  std::string out = fmt::format("`{}` is perceived as {:.3g}: {}\n", sighting.fact, sighting.certainty, sighting.definition);
  for (const Sighting::Part& part : sighting.parts) out += line(part);
  return out;
}

ordered_json json_sighting(const Sighting& sighting) {
  if (sighting.definition.empty()) return {{"given", json_number(sighting.certainty)}};
  ordered_json out{{"definition", sighting.definition}, {"asleep", sighting.asleep}};
  if (sighting.asleep) return out;
  out["certainty"] = json_number(sighting.certainty);
  out["parts"] = ordered_json::array();
  for (const Sighting::Part& part : sighting.parts) out["parts"].push_back(json_part(part));
  return out;
}

}  // namespace kb::trace
