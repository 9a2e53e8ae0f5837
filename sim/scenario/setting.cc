#include "sim/scenario/setting.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <set>

#include "compiler/source/encoding.h"
#include "sim/scenario/toml_keys.h"

namespace kb::sim {
namespace {

bool is_value(const std::string& text) {
  if (find_deep_key(text) < text.size()) return false;   // as the reader would refuse it
  try {
    return toml::parse("x = " + text).size() == 1;
  } catch (const toml::parse_error&) {
    return false;
  }
}

/// The same text for values that are the same number, `0.01` and `1e-2`; any other text as it is.
std::string plain_value(const std::string& text) {
  if (!is_value(text)) return text;
  const toml::table table = toml::parse("x = " + text);
  if (const auto* whole = table["x"].as_integer()) return fmt::format("{}", whole->get());
  const auto* number = table["x"].as_floating_point();
  return number != nullptr ? fmt::format("{}", number->get() + 0.0) : text;   // so that -0.0 is 0
}

bool is_word(char c) { return source::is_letter_or_digit(c) || c == '_' || c == '-'; }

/// Whether a text is a key: words with points between them.
bool is_key(std::string_view text) {
  bool word = false;
  for (const char c : text) {
    if (!is_word(c) && !(c == '.' && word)) return false;
    word = is_word(c);
  }
  return word;
}

}  // namespace

std::string Setting::toml() const { return is_value(value) ? fmt::format("{} = {}", key, value) : fmt::format("{} = \"{}\"", key, value); }

std::optional<Sweep> read_sweep(std::string_view text, std::string& why) {
  const auto wrong = [&](std::string_view what) {
    why = what;
    return std::nullopt;
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || !is_key(text.substr(0, equals))) return wrong("write KEY=VALUE, such as sensors.range.noise=0.1");
  Sweep sweep{std::string(text.substr(0, equals)), {}};
  std::set<std::string> seen;
  for (const std::string_view part : source::split(text.substr(equals + 1), ',')) {
    const std::string value(part);
    if (value.empty()) return wrong("a value is missing");
    if (std::any_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || std::string_view("\"'\\|#<&").find(c) != std::string_view::npos; })) {
      return wrong("a text is written bare, and without \\ | # < &");   // those would break the pictures and tables of results
    }
    if (!seen.insert(plain_value(value)).second) return wrong("a value is there twice");
    sweep.values.push_back(value);
  }
  return sweep;
}

Combinations rows_of(const std::vector<Sweep>& sweeps) {
  Combinations rows{{}};
  for (const Sweep& sweep : sweeps) {
    Combinations longer;
    for (const auto& row : rows) {
      for (const std::string& value : sweep.values) {
        longer.push_back(row);
        longer.back().push_back({sweep.key, value});
      }
    }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<source::FileId> add_settings(const std::vector<Setting>& settings, source::Sources& sources) {
  std::vector<source::FileId> texts;
  for (const Setting& setting : settings) texts.push_back(sources.add("--set", setting.toml()));
  return texts;
}

}  // namespace kb::sim
