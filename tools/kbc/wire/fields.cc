#include "tools/kbc/wire/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

#include "compiler/diagnostics/display.h"
#include "compiler/source/utf8.h"

namespace kb::wire {

using diagnostics::Kind;

namespace {

/// A short text for a value; a number as it is written.
std::string shown(const Json& json) {
  if (json.kind == Json::Kind::kNumber || json.kind == Json::Kind::kBool) return json.text.size() <= 40 ? json.text : json.text.substr(0, 40) + "...";
  if (json.kind == Json::Kind::kList) return fmt::format("a list of {}", json.parts.size());
  return std::string(json::kind_name(json.kind));
}

Mistake wrong_type(std::string_view field, const Json& json, std::string wanted) {
  return {Kind::kWireType, {std::string(field), shown(json), std::move(wanted)}, std::string(field), json.span};
}

}  // namespace

std::optional<Json> Reading::object(std::string_view text) {
  text_ = text;
  json::Fault fault;
  auto json = json::parse(text, source::FileId::kNone, fault);
  if (!json) wrong({Kind::kWireNotJson, {fault.what, {}, {}}, {}, fault.span});
  else if (json->kind != Json::Kind::kObject) wrong({Kind::kWireNotJson, {fmt::format("{} stands where an object `{{...}}` is wanted", json::kind_name(json->kind)), {}, {}}, {}, json->span});
  else return json;
  return std::nullopt;
}

bool Reading::in_range(std::string_view field, const Json& json, double value, Range range) {
  if (value >= range.low && value <= range.high) return true;
  wrong(wrong_type(field, json, fmt::format("a number from {:g} to {:g}", range.low, range.high)));
  return false;
}

void Reading::number(std::string_view field, const Json& json, Range range, float& value) {
  if (!is(field, json, Json::Kind::kNumber) || !in_range(field, json, json.number, range)) return;
  const auto read = std::from_chars(json.text.data(), json.text.data() + json.text.size(), value);
  if (read.ec != std::errc()) value = static_cast<float>(json.number);   // too small for a float
}

void Reading::number(std::string_view field, const Json& json, Range range, double& value) {
  if (is(field, json, Json::Kind::kNumber) && in_range(field, json, json.number, range)) value = json.number;
}

void Reading::truth(std::string_view field, const Json& json, bool& value) {
  if (is(field, json, Json::Kind::kBool)) value = json.text == "true";
}

void Reading::text(std::string_view field, const Json& json, std::string& value) {
  if (is(field, json, Json::Kind::kString)) value = json.text;
}

void Reading::word(std::string_view field, const Json& json, std::span<const std::string_view> words, std::string& value) {
  if (!is(field, json, Json::Kind::kString)) return;
  if (std::find(words.begin(), words.end(), json.text) != words.end()) {
    value = json.text;
    return;
  }
  Mistake mistake = wrong_type(field, json, fmt::format("one of {}", diagnostics::in_a_row(words)));
  mistake.arguments[1] = fmt::format("`{}`", source::printable(json.text));
  mistake.better = diagnostics::closest(json.text, words);
  wrong(std::move(mistake));
}

void Reading::texts(std::string_view field, const Json& json, std::vector<std::string>& values) {
  if (!is(field, json, Json::Kind::kList)) return;
  for (const Json& part : json.parts) {
    if (!is(fmt::format("{}[{}]", field, values.size()), part, Json::Kind::kString)) return;
    values.push_back(part.text);
  }
}

void Reading::numbers(std::string_view field, const Json& json, Range range, std::span<float> values) {
  if (!is(field, json, Json::Kind::kList)) return;
  if (json.parts.size() != values.size()) return wrong(wrong_type(field, json, fmt::format("a list of {}", values.size())));
  for (std::size_t i = 0; i < values.size() && !mistake_; ++i) {
    if (json.parts[i].kind == Json::Kind::kNull) values[i] = std::numeric_limits<float>::quiet_NaN();
    else number(fmt::format("{}[{}]", field, i), json.parts[i], range, values[i]);
  }
}

bool Reading::is(std::string_view field, const Json& json, Json::Kind kind) {
  if (json.kind == kind) return true;
  wrong(wrong_type(field, json, std::string(json::kind_name(kind))));
  return false;
}

void Reading::unwanted(std::string_view field, const Json& json, std::string wanted) { wrong(wrong_type(field, json, std::move(wanted))); }

void Reading::once(std::string_view prefix, const Json& object) {
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < object.keys.size(); ++i) {
    if (seen.insert(object.keys[i]).second) continue;
    const std::string field = std::string(prefix) + source::printable(object.keys[i]);
    return wrong({Kind::kWireTwice, {field, {}, {}}, field, key_of(object.keys[i], object.parts[i].span)});
  }
}

source::Span Reading::key_of(std::string_view key, source::Span value) const {
  const std::string quoted = fmt::format("\"{}\"", key);
  const std::size_t at = text_.rfind(quoted, value.begin);
  if (at == std::string_view::npos) return value;   // the name is written with escapes
  return {source::FileId::kNone, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + quoted.size())};
}

void Reading::missing(std::string_view field, std::string_view why, source::Span at) {
  wrong({Kind::kWireMissing, {std::string(field), std::string(why), {}}, std::string(field), at});
}

std::string_view part_at(std::string_view text, std::size_t begin) {
  std::size_t open = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    else if (c == '"') quoted = !quoted;
    else if (!quoted && (c == '{' || c == '[')) ++open;
    else if (!quoted && (c == '}' || c == ']') && --open == 0) return text.substr(begin, i + 1 - begin);
  }
  return {};
}

Mistake unknown_field(std::string_view prefix, const std::string& key, std::span<const std::string_view> known, source::Span at) {
  const std::string field = std::string(prefix) + source::printable(key);
  return {Kind::kWireUnknownField, {field, diagnostics::in_a_row(known), {}}, field, at, diagnostics::closest(key, known)};
}

}  // namespace kb::wire
