#include "sim/scenario/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "compiler/source/utf8.h"
#include "sim/scenario/toml_keys.h"
#include "sim/scenario/toml_mistakes.h"

namespace kb::sim {

using diagnostics::Diagnostics;
using diagnostics::Kind;

namespace {

std::string_view type_word(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string: return "a text";
    case toml::node_type::integer:
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    case toml::node_type::array: return "a list";
    case toml::node_type::table: return "a table";
    default: return "a time";
  }
}

/// The number that a node holds; nothing if it holds none. The library's own conversion fails for integers beyond 2^53.
std::optional<double> number_in(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  return std::nullopt;
}

// Stores the file's number as the "path" that the library remembers for each value. Errors are exceptions: so Debian's build of the library
// reports them.
std::optional<toml::table> parse_toml(source::FileId file, const TomlPlaces& places, Diagnostics& diagnostics) {
  const std::string_view bytes = diagnostics.sources().bytes(file);
  const auto at = static_cast<std::uint32_t>(std::min(source::find_lone_return(bytes), bytes.size()));
  if (source::is_utf16(bytes)) {
    diagnostics.report(Kind::kUtf16, source::Span{file, 0, 2});
    return std::nullopt;
  }
  if (const std::string_view other = source::other_format(bytes); !other.empty()) {
    diagnostics.report(Kind::kNotText, source::Span{file, 0, 2}, {other});
    return std::nullopt;
  }
  if (const std::size_t bad = source::find_ill_formed(bytes); bad < bytes.size()) {
    const auto point = static_cast<std::uint32_t>(bad);
    diagnostics.report(Kind::kBytesNotUtf8, source::Span{file, point, point + 1}, {fmt::format("0x{:02X}", static_cast<unsigned char>(bytes[bad]))});
    return std::nullopt;
  }
  if (at < bytes.size()) {
    diagnostics.report(Kind::kLoneReturn, source::Span{file, at, at + 1});
    return std::nullopt;
  }
  if (const std::size_t deep = find_deep_key(bytes); deep < bytes.size()) {
    const auto point = static_cast<std::uint32_t>(deep);
    diagnostics.report(Kind::kSimKeyDeep, source::Span{file, point, point + 1}, {fmt::format("{}", kMostKeyParts)});
    return std::nullopt;
  }
  try {
    return toml::parse(bytes, std::to_string(static_cast<std::uint32_t>(file)));
  } catch (const toml::parse_error& error) {
    const source::Span place = places.span(error.source());
    const std::string known = toml_mistake(bytes, place.begin, error.description());
    diagnostics.report(Kind::kSimToml, place, {known.empty() ? error.description() : std::string_view(known)});
    return std::nullopt;
  }
}

/// Whether a table was made by a key such as `event.0.press`, so that a list is meant.
bool is_list(const toml::table& table) {
  const auto is_place = [](const auto& entry) { return entry.first.str().find_first_not_of("0123456789") == std::string_view::npos; };
  return !table.empty() && std::all_of(table.begin(), table.end(), is_place);
}

/// Puts `value` at `key` of a table or a list, or behind the last of the list; a table is merged into a table or list that is there already. False
/// if the list has no such place (reported). Values are moved, since copies forget where they were written.
bool put(toml::node& into, const toml::key& key, toml::node& value, const TomlPlaces& places, Diagnostics& diagnostics) {
  toml::node* there = nullptr;
  toml::array* const list = into.as_array();
  std::size_t at = 0;
  if (list != nullptr) {
    const std::string_view digits = key.str();
    if (!source::read_number(digits, at) || at > list->size()) {
      diagnostics.report(Kind::kSimNoSuchPlace, places.span(key.source()), {digits, fmt::format("{}", list->size())});
      return false;
    }
    there = list->get(at);
  } else {
    there = into.as_table()->get(key.str());
  }
  toml::table* inner = value.as_table();
  if (list == nullptr && there == nullptr && inner != nullptr && is_list(*inner)) {
    there = &into.as_table()->insert_or_assign(key, toml::array{}).first->second;
  }
  if (inner != nullptr && there != nullptr && (there->is_table() || there->is_array())) {
    for (auto&& [name, node] : *inner) {
      if (!put(*there, name, node, places, diagnostics)) return false;
    }
    return true;
  }
  value.visit([&](auto& node) {
    if (list != nullptr && at == list->size()) list->push_back(std::move(node));
    else if (list != nullptr) list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(at), std::move(node));
    else into.as_table()->insert_or_assign(key, std::move(node));
  });
  return true;
}

}  // namespace

source::Span TomlPlaces::span(const toml::source_region& region) const {
  source::FileId file = file_;
  if (region.path) file = source::FileId{static_cast<std::uint32_t>(std::stoul(*region.path))};   // see parse_toml
  if (!region.begin) return {file, 0, 0};
  const std::uint32_t begin = sources_.offset_of(file, {region.begin.line, region.begin.column});
  const bool one_line = region.end && region.end.line == region.begin.line;
  return {file, begin, one_line ? std::max(sources_.offset_of(file, {region.end.line, region.end.column}), begin) : begin};
}

std::optional<toml::table> parse_scenario(source::FileId file, Settings settings, const TomlPlaces& places, Diagnostics& diagnostics) {
  auto scenario = parse_toml(file, places, diagnostics);
  for (const source::FileId text : settings) {
    auto setting = scenario ? parse_toml(text, places, diagnostics) : std::nullopt;
    if (!setting) return std::nullopt;
    for (auto&& [key, value] : *setting) {
      if (!put(*scenario, key, value, places, diagnostics)) return std::nullopt;
    }
  }
  return scenario;
}

bool TomlTable::is_asked(std::string_view key) const { return std::find(asked_.begin(), asked_.end(), key) != asked_.end(); }

const toml::node* TomlTable::get(std::string_view key) {
  if (!is_asked(key)) asked_.emplace_back(key);
  return table_->get(key);
}

bool TomlTable::has(std::string_view key) { return get(key) != nullptr; }

bool TomlTable::is_set(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && places_->is_set(node->source());
}

source::Span TomlTable::span(std::string_view key) const {
  const toml::node* node = key.empty() ? nullptr : table_->get(key);
  return places_->span(node != nullptr ? node->source() : table_->source());
}

diagnostics::Builder TomlTable::wrong_type(std::string_view key, const toml::node& node, std::string_view wanted) {
  return diagnostics_->report(Kind::kSimType, places_->span(node.source()), {key, type_word(node), wanted});
}

bool TomlTable::in_range(std::string_view key, const toml::node& node, double value, Range range) {
  if (value >= range.low && value <= range.high) return true;
  diagnostics_->report(Kind::kSimRange, places_->span(node.source()),
                       {key, fmt::format("{:g}", value), fmt::format("a number from {:g} to {:g}{}{}", range.low, range.high, range.of.empty() ? "" : ", ", range.of)});
  return false;
}

std::optional<double> TomlTable::number(std::string_view key, Range range) {
  const toml::node* node = get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = number_in(*node);
  if (!value) {
    const auto* text = node->as_string();
    const std::string meant = text != nullptr ? number_at(text->get()) : std::string();
    auto message = wrong_type(key, *node, meant.empty() ? "a number" : fmt::format("a number without quotation marks and unit, `{}`,", meant));
    if (!meant.empty() && !text->get().ends_with(meant)) message.note(Kind::kSimUnits, {});
    return std::nullopt;
  }
  return in_range(key, *node, *value, range) ? value : std::nullopt;
}

std::optional<std::uint64_t> TomlTable::whole(std::string_view key, double last) {
  const toml::node* node = get(key);
  if (node != nullptr && !node->is_integer()) {
    wrong_type(key, *node, "a whole number");
    return std::nullopt;
  }
  const auto value = number(key, {0.0, last});
  return value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = get(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) return value->get();
  wrong_type(key, *node, "a text");
  return std::nullopt;
}

bool TomlTable::flag(std::string_view key) {
  const toml::node* node = get(key);
  if (node == nullptr) return false;
  if (const auto* value = node->as_boolean()) return value->get();
  wrong_type(key, *node, "`true` or `false`");
  return false;
}

std::vector<std::string> TomlTable::texts(std::string_view key) {
  std::vector<std::string> texts;
  const toml::node* node = get(key);
  if (node == nullptr) return texts;
  const toml::array* list = node->as_array();
  if (list == nullptr) wrong_type(key, *node, "a list of texts");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    if (const auto* value = (*list)[i].as_string()) texts.push_back(value->get());
    else wrong_type(key, (*list)[i], "a text");
  }
  return texts;
}

std::optional<TomlTable> TomlTable::table(std::string_view key, std::string_view wanted) {
  const toml::node* node = get(key);
  if (node == nullptr) return std::nullopt;
  if (const toml::table* value = node->as_table()) return TomlTable(*value, fmt::format("`{}`", key), *places_, *diagnostics_);
  wrong_type(key, *node, wanted);
  return std::nullopt;
}

TomlTable TomlTable::table_or_none(std::string_view key) {
  static const toml::table kNone;
  auto there = table(key);
  return there ? *std::move(there) : TomlTable(kNone, {}, *places_, *diagnostics_);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> tables;
  const toml::node* node = get(key);
  if (node == nullptr) return tables;
  const toml::array* list = node->as_array();
  if (list == nullptr) {
    const std::string within = what_.starts_with('`') ? what_.substr(1, what_.size() - 2) + "." : "";
    wrong_type(key, *node, fmt::format("a list of tables, `[[{}{}]]`,", within, key));
  }
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    if (const toml::table* value = (*list)[i].as_table()) tables.emplace_back(*value, fmt::format("`{}`", key), *places_, *diagnostics_);
    else wrong_type(key, (*list)[i], "a table");
  }
  return tables;
}

std::optional<TomlTable::Pair> TomlTable::pair(std::string_view key, Range x, Range y) {
  const toml::node* node = get(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  const bool two = list != nullptr && list->size() == 2;
  const auto first = two ? number_in((*list)[0]) : std::nullopt, second = two ? number_in((*list)[1]) : std::nullopt;
  if (!first || !second) {
    wrong_type(key, *node, "a place, `[x, y]`,");
    return std::nullopt;
  }
  const bool good = in_range(key, (*list)[0], *first, x) && in_range(key, (*list)[1], *second, y);
  return good ? std::optional(Pair{*first, *second}) : std::nullopt;
}

// If one of the keys not asked for looks like a misspelt `key`, that is reported instead, at its place.
void TomlTable::missing(std::string_view key) {
  for (const auto& [written, node] : *table_) {
    if (is_asked(written) || !diagnostics::closest(written.str(), std::array{key})) continue;
    diagnostics_->report(Kind::kSimUnknownKey, places_->span(written.source()), {written.str(), fmt::format("{} wants `{}`", what_, key)}).suggest(std::string(key));
    return;
  }
  diagnostics_->report(Kind::kSimMissing, span(), {what_, key});
}

void TomlTable::unknown_name(std::string_view key, std::string_view kind, std::string_view name, std::span<const std::string_view> candidates) {
  constexpr std::size_t kMostListed = 12;
  const auto near = diagnostics::closest(name, candidates);
  auto message = diagnostics_->report(Kind::kSimUnknownName, span(key), {kind, name});
  message.suggest(near);
  if (near || candidates.empty() || candidates.size() > kMostListed) return;
  message.note(Kind::kSimThereAre, {}, {diagnostics::in_a_row(candidates)});
}

void TomlTable::missing_among(std::string_view key) {
  const std::size_t before = reported_.size();
  done();
  if (reported_.size() == before) missing(key);
}

void TomlTable::done(std::string_view inner, std::span<const std::string> of_inner) {
  for (const auto& [key, node] : *table_) {
    if (is_asked(key) || std::ranges::find(reported_, key.str()) != reported_.end()) continue;
    reported_.emplace_back(key.str());
    std::vector<std::string_view> candidates(asked_.begin(), asked_.end());
    const bool deeper = std::ranges::find(of_inner, key.str()) != of_inner.end();
    const auto called = std::ranges::find(called_, key.str(), &std::pair<std::string_view, std::string_view>::first);
    const auto better = called != called_.end() ? std::optional(std::string(called->second)) : diagnostics::closest(key.str(), candidates);
    diagnostics_->report(Kind::kSimUnknownKey, places_->span(key.source()), {key.str(), fmt::format("{} takes {}", what_, diagnostics::in_a_row(candidates))})
        .suggest(deeper ? fmt::format("{}.{}", inner, key.str()) : better);
  }
}

}  // namespace kb::sim
