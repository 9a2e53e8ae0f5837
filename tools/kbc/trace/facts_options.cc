#include "tools/kbc/trace/facts_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/encoding.h"
#include "tools/kbc/trace/trace_diff.h"

namespace kb::trace {
namespace {

bool is_given(std::string_view key, const FactsOptions& options) {
  if (key == "compare") return !options.compare.empty();
  return key == "kb" ? !options.program.empty() : key == "empty" ? options.steady.has_value() : key == "dt" ? options.dt_us.has_value() : options.every_us.has_value();
}

/// The keys that are named, with blanks or commas between them. Empty if one of them is none.
std::vector<std::string_view> trace_keys(std::string_view text) {
  std::vector<std::string_view> keys;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" ,"), text.size());
    const auto key = std::find(kTraceKeys.begin(), kTraceKeys.end(), text.substr(0, end));
    if (key == kTraceKeys.end()) return {};
    keys.push_back(*key);
    text.remove_prefix(std::min(text.find_first_not_of(" ,", end), text.size()));
  }
  return keys;
}

void take(std::string_view key, std::string_view value, FactsOptions& options, OptionItem& item) {
  if (is_given(key, options)) {
    item.wanted = "the first value of this option";
  } else if (key == "kb") {
    options.program = value;
    item.names_program = true;
    item.wanted = "a file";
    item.good = !value.empty();
  } else if (key == "empty") {
    options.again = value == "measured again";
    options.steady = options.again || value == "as before";
    item.wanted = "`as before`, `measured again` or `no data`";
    item.good = *options.steady || value == "no data";
  } else if (key == "compare") {
    options.compare = trace_keys(value);
    static const std::string kWanted = fmt::format("made of `{}`", fmt::join(kTraceKeys, " "));
    item.wanted = kWanted;
    item.good = !options.compare.empty();
  } else {
    std::optional<std::uint32_t>& time = key == "dt" ? options.dt_us : options.every_us;
    time = parse_duration(value);
    item.wanted = "a length of time from 1 us to 71 min, such as `10 ms`";
    item.good = time.has_value();
  }
}

/// The key that a misspelt key was meant to be. Ignored like any other comment, it would change the meaning of the whole file.
std::string_view slip_in(std::string_view key) {
  if (diagnostics::is_slip_of(key, "empty")) return "`empty`";
  if (diagnostics::is_slip_of(key, "compare")) return "`compare`";
  return diagnostics::is_slip_of(key, "every") ? "`every`" : "";
}

/// Where the option at `at` ends: at a comma. The name of a knowledge base may have commas, and ends in `.kb`; the keys to compare may be parted by
/// commas, and end before the next option.
std::size_t end_of_option(std::string_view line, std::size_t at) {
  const std::size_t comma = std::min(line.find(',', at), line.size());
  const std::string_view text = line.substr(at);
  const std::string_view name = source::trimmed(text.substr(0, text.find(':')));
  if (name == "compare") {
    const std::size_t next = line.find(':', at + text.find(':') + 1);
    const std::size_t before = next == line.npos ? line.npos : line.rfind(',', next);
    return before == line.npos || before < at ? line.size() : before;
  }
  if (name != "kb") return comma;
  for (std::size_t end = comma;; end = std::min(line.find(',', end + 1), line.size())) {
    if (source::trimmed(line.substr(at, end - at)).ends_with(".kb")) return end;
    if (end == line.size()) return comma;
  }
}

}  // namespace

std::optional<std::uint32_t> parse_duration(std::string_view text) {
  text = source::trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  const std::string_view unit = source::trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  const double scale = unit == "us" ? 1.0 : unit == "ms" ? 1e3 : unit == "s" ? 1e6 : unit == "min" ? 60e6 : unit == "h" ? 3600e6 : 0.0;
  const double us = number * scale;
  if (!(us >= 0.999 && us <= static_cast<double>(kMaxStepUs))) return std::nullopt;   // 1e-6 s need not be all of 1 us
  return static_cast<std::uint32_t>(std::round(us));
}

std::vector<OptionItem> read_option_comment(std::string_view line, FactsOptions& options) {
  std::vector<OptionItem> items;
  for (std::size_t at = line.find('#') + 1; at < line.size();) {
    const std::size_t end = end_of_option(line, at);
    const std::string_view text = line.substr(at, end - at);
    const std::size_t colon = text.find(':');
    const std::string_view key = colon == std::string_view::npos ? std::string_view{} : source::trimmed(text.substr(0, colon));
    if (const std::string_view meant = slip_in(key); !meant.empty()) {
      const auto first = static_cast<std::uint32_t>(key.data() - line.data());
      items.push_back({first, first + static_cast<std::uint32_t>(key.size()), false, meant, false});
      return items;
    }
    if (key != "dt" && key != "kb" && key != "empty" && key != "every" && key != "compare") return items;
    const std::string_view value = source::trimmed(text.substr(colon + 1));
    const auto begin = static_cast<std::uint32_t>(value.data() - line.data());
    OptionItem item;
    item.begin = begin;
    item.end = begin + static_cast<std::uint32_t>(value.size());
    take(key, value, options, item);
    items.push_back(item);
    at = end + 1;
  }
  return items;
}

FactsOptions peek_options(ByteStream& bytes, const std::function<void(const LineReader::Line&, const OptionItem&)>& each) {
  FactsOptions options;
  LineReader lines(bytes);
  while (const auto line = lines.next()) {
    const std::size_t first = line->text.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    if (line->text[first] != '#' || line->too_long) break;
    for (const OptionItem& item : read_option_comment(line->text, options))
      if (each) each(*line, item);
  }
  return options;
}

}  // namespace kb::trace
