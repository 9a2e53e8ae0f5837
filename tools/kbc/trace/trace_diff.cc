#include "tools/kbc/trace/trace_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "compiler/diagnostics/display.h"

namespace kb::trace {
namespace {

using nlohmann::json;

// A tick nests two levels deep. Deeper values were not written by kbc and are not followed.
constexpr int kMaxDepth = 8;

template <class Json = json>
Json parse(std::string_view line) {
  return Json::parse(
      line, [](int depth, typename Json::parse_event_t, Json&) { return depth <= kMaxDepth; }, false);
}

/// `go`, 0.5; of a conflict "of `left`, `right` over `Turn`".
std::string shown(const json& value) {
  if (value.is_object() && value.contains("cell") && value.contains("rules") && value["rules"].is_array()) {
    std::string rules;
    for (const json& rule : value["rules"]) rules += (rules.empty() ? "" : ", ") + shown(rule);
    return "of " + rules + " over " + shown(value["cell"]);
  }
  if (value.is_string()) return "`" + value.get<std::string>() + "`";
  return value.is_null() ? "nothing" : value.dump(-1, ' ', false, json::error_handler_t::replace);
}

using Sentences = std::vector<std::string>;

// Compares lists of names: what is missing, what is surplus, otherwise whether the order differs. `missing` and `surplus` contain `{}`.
void compare_lists(const json& expected, const json& actual, std::string_view key, std::string_view missing,
                   std::string_view surplus, Sentences& out) {
  const auto tell = [&](const json& these, const json& others, std::string_view words) {
    for (const json& item : these) {
      if (std::find(others.begin(), others.end(), item) == others.end())
        out.push_back(fmt::format(fmt::runtime(words), shown(item)));
    }
  };
  const std::size_t before = out.size();
  tell(expected, actual, missing);
  tell(actual, expected, surplus);
  if (out.size() == before)
    out.push_back(fmt::format("{} in another order: {}, expected {}", key, shown(actual), shown(expected)));
}

void compare_sets(const json& expected, const json& actual, Sentences& out) {
  for (const auto& [cell, value] : expected.items()) {
    const auto now = actual.find(cell);
    if (now == actual.end()) {
      out.push_back(fmt::format("`{}` was not set, expected {}", cell, shown(value)));
    } else if (*now != value) {
      out.push_back(fmt::format("`{}` was set to {}, expected {}", cell, shown(*now), shown(value)));
    }
  }
  for (const auto& [cell, value] : actual.items()) {
    if (!expected.contains(cell))
      out.push_back(fmt::format("`{}` was set to {}, which was not expected", cell, shown(value)));
  }
}

struct ListWords {
  const char *key, *missing, *surplus;
};
constexpr std::array kLists{
    ListWords{"events", "no event of {}, which was expected", "an event of {}, which was not expected"},
    ListWords{"lost", "{} was not lost, which was expected", "{} was lost, which was not expected"},
    ListWords{"fired", "{} did not fire, which was expected", "{} fired, which was not expected"},
    ListWords{"conflicts", "no conflict {}, which was expected", "a conflict {}, which was not expected"},
};

void compare_key(const std::string& key, const json& expected, const json& actual, Sentences& out) {
  if (expected == actual) return;
  const auto list =
      std::find_if(kLists.begin(), kLists.end(), [&](const ListWords& words) { return key == words.key; });
  if (list != kLists.end() && expected.is_array() && actual.is_array()) {
    compare_lists(expected, actual, key, list->missing, list->surplus, out);
  } else if (key == "set" && expected.is_object() && actual.is_object()) {
    compare_sets(expected, actual, out);
  } else if (key == "strategy") {
    out.push_back(fmt::format("runs {}, expected {}", shown(actual), shown(expected)));
  } else {
    out.push_back(fmt::format("{} is {}, expected {}", key, shown(actual), shown(expected)));
  }
}

std::string number_of(std::string_view line) {
  const json tick = parse(line);
  const auto number = tick.is_object() ? tick.find("tick") : tick.end();
  return tick.is_object() && number != tick.end() ? shown(*number) : "?";
}

std::string joined(const json& names) {
  std::string out;
  for (const json& name : names) out += (out.empty() ? "" : ", ") + shown(name);
  return out;
}

/// A line of a trace in a few words: "fired `arrive[...]`; set `Gate` 1; runs `Move.mark`; ok".
std::string summarise_tick(std::string_view line) {
  const json tick = parse(line);
  if (!tick.is_object()) return std::string(line.substr(0, 80));
  std::vector<std::string> parts;
  static constexpr std::array<std::array<const char*, 2>, 4> groups{
      {{"events", "event "}, {"lost", "lost "}, {"fired", "fired "}, {"conflicts", "conflict "}}};
  for (const auto& [key, words] : groups) {
    if (const auto list = tick.find(key); list != tick.end() && list->is_array() && !list->empty())
      parts.push_back(words + joined(*list));
  }
  if (const auto set = tick.find("set"); set != tick.end() && set->is_object() && !set->empty()) {
    std::string cells;
    for (const auto& [cell, value] : set->items())
      cells += fmt::format("{}`{}` {}", cells.empty() ? "" : ", ", cell, shown(value));
    parts.push_back("set " + cells);
  }
  if (const auto strategy = tick.find("strategy"); strategy != tick.end()) parts.push_back("runs " + shown(*strategy));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::vector<std::string> compare_ticks(std::string_view expected_line, std::string_view actual_line) {
  Sentences out;
  if (expected_line == actual_line) return out;
  const json expected = parse(expected_line), actual = parse(actual_line);
  if (!expected.is_object() || !actual.is_object()) return {"one of the lines is not a tick"};
  std::vector<std::string> order{"tick", "t"};
  order.insert(order.end(), kTraceKeys.begin(), kTraceKeys.end());
  const json none;
  const auto at = [&](const json& tick, const std::string& key) -> const json& {
    const auto found = tick.find(key);
    return found == tick.end() ? none : *found;
  };
  for (const std::string& key : order) compare_key(key, at(expected, key), at(actual, key), out);
  const auto others = [&](const json& tick, bool both) {
    for (const auto& [key, value] : tick.items()) {
      if (std::find(order.begin(), order.end(), key) == order.end() && (both || !expected.contains(key)))
        compare_key(key, at(expected, key), at(actual, key), out);
    }
  };
  others(expected, true);
  others(actual, false);
  return out;
}

std::string with_keys(std::string_view line, const std::vector<std::string_view>& keys) {
  if (keys.empty()) return std::string(line);
  const auto tick = parse<nlohmann::ordered_json>(line);
  if (!tick.is_object()) return std::string(line);
  nlohmann::ordered_json kept;
  for (const auto& [key, value] : tick.items()) {
    if (key == "tick" || key == "t" || std::find(keys.begin(), keys.end(), key) != keys.end()) kept[key] = value;
  }
  return kept.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string tick_fault(std::string_view line) {
  const json tick = parse(line);
  if (tick.is_discarded()) return "it is not JSON";
  if (!tick.is_object()) return "it is not a JSON object";
  return tick.contains("tick") ? "" : "it has no `tick`";
}

void TraceDiffer::compare(std::optional<std::string_view> expected, std::optional<std::string_view> actual) {
  ++ticks_;
  if (!expected || !actual) {
    ++differing_;
    ++(expected ? missing_ : surplus_);
    return;
  }
  const Sentences differences = compare_ticks(*expected, *actual);
  if (differences.empty()) {
    before_.emplace_back(*actual);
    if (before_.size() > kContext) before_.pop_front();
    return;
  }
  if (++differing_ > kShown) return;
  if (differing_ == 1) {
    for (const std::string& line : before_)
      text_ += fmt::format("  tick {}, as expected: {}\n", number_of(line), summarise_tick(line));
  }
  text_ += fmt::format("  tick {} differs:\n", number_of(*actual));
  for (const std::string& difference : differences) text_ += "    - " + difference + "\n";
  text_ += fmt::format("    expected: {}\n    happened: {}\n", summarise_tick(*expected), summarise_tick(*actual));
}

std::string TraceDiffer::report() const {
  if (same()) return {};
  std::string out = text_;
  const std::uint64_t in_both = ticks_ - missing_ - surplus_, wrong = differing_ - missing_ - surplus_;
  if (wrong > kShown) out += fmt::format("  and {} more ticks differ\n", wrong - kShown);
  if (missing_ > 0) out += fmt::format("  the run ended after {}; {} more expected\n", diagnostics::counted(in_both, "tick"), missing_);
  if (surplus_ > 0) out += fmt::format("  {} expected; the run went on for {} more\n", diagnostics::counted(in_both, "tick"), surplus_);
  return out;
}

}  // namespace kb::trace
