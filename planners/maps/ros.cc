// The YAML of ROS map_server: a flat list of keys.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "planners/maps/maps.h"
#include "planners/maps/words.h"

namespace kb::planners {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

struct Entry {
  Word key, value;
  std::vector<Word> items;   // of a list
  bool list = false;
};

// A value without its comment and its quotes.
Word strip(Word value) {
  value = trim(value);
  if (!value.text.empty() && (value.text[0] == '"' || value.text[0] == '\'')) {
    const std::size_t close = value.text.find(value.text[0], 1);
    if (close == std::string_view::npos) return value;
    value.text = value.text.substr(1, close - 1);
    value.at.begin += 1;
    value.at.end = value.at.begin + static_cast<std::uint32_t>(value.text.size());
    return value;
  }
  std::size_t comment = value.text.find(" #");
  if (value.text.starts_with('#')) comment = 0;
  if (comment == std::string_view::npos) return value;
  value.text = value.text.substr(0, comment);
  value.at.end = value.at.begin + static_cast<std::uint32_t>(comment);
  return trim(value);
}

// `[1, 2, 3]`
bool read_flow_list(const Word& value, Entry& entry) {
  if (value.text.size() < 2 || value.text.front() != '[' || value.text.back() != ']') return false;
  Word inner = value;
  inner.text = value.text.substr(1, value.text.size() - 2);
  inner.at.begin += 1;
  inner.at.end -= 1;
  entry.list = true;
  while (!trim(inner).text.empty()) entry.items.push_back(trim(cut_word(inner, ",")));
  return true;
}

class Yaml {
 public:
  Yaml(source::FileId file, Diagnostics& diagnostics) : lines_(diagnostics.sources(), file), diagnostics_(diagnostics) {}

  bool read() {
    while (lines_.more()) {
      const Word line = lines_.next();
      const Word text = strip(line);
      if (text.text.empty() || text.text == "---" || text.text == "...") continue;
      if (!read_line(line, text)) return false;
    }
    return true;
  }

  const Entry* find(std::string_view key) const {
    for (const Entry& entry : entries_) {
      if (entry.key.text == key) return &entry;
    }
    return nullptr;
  }

 private:
  bool read_line(const Word& line, const Word& text) {
    if (text.text.starts_with("- ") && !entries_.empty() && (entries_.back().list || entries_.back().value.text.empty())) {
      Word item = text;
      static_cast<void>(cut_word(item));
      entries_.back().list = true;
      entries_.back().items.push_back(trim(item));
      return true;
    }
    const std::size_t colon = line.text.find(':');
    const bool spaced = colon != std::string_view::npos && (colon + 1 == line.text.size() || line.text[colon + 1] == ' ' ||
                                                            line.text[colon + 1] == '\t');
    if (!spaced || colon == 0 || line.text[0] == ' ' || line.text[0] == '\t') {
      diagnostics_.report(Kind::kYamlLine, text.at);
      return false;
    }
    return add(line, colon);
  }

  bool add(const Word& line, std::size_t colon) {
    Entry entry;
    entry.key = line;
    entry.key.text = line.text.substr(0, colon);
    entry.key.at.end = line.at.begin + static_cast<std::uint32_t>(colon);
    entry.key = trim(entry.key);
    entry.value = line;
    entry.value.text = line.text.substr(colon + 1);
    entry.value.at.begin = line.at.begin + static_cast<std::uint32_t>(colon) + 1;
    entry.value = strip(entry.value);
    if (find(entry.key.text) != nullptr) {
      diagnostics_.report(Kind::kYamlTwice, entry.key.at, {diagnostics::visible(entry.key.text)});
      return false;
    }
    read_flow_list(entry.value, entry);
    entries_.push_back(std::move(entry));
    return true;
  }

  Lines lines_;
  Diagnostics& diagnostics_;
  std::vector<Entry> entries_;
};

class MapReader {
 public:
  MapReader(const Yaml& yaml, source::FileId file, Diagnostics& diagnostics)
      : yaml_(yaml), file_(file), diagnostics_(diagnostics) {}

  std::optional<RosMap> read() {
    image();
    number("resolution", true, map_.resolution_m, 1e-6, 1e6, "a positive number of metres");
    number("occupied_thresh", false, map_.occupied_thresh, 0.0, 1.0, "a share from 0 to 1");
    number("free_thresh", false, map_.free_thresh, 0.0, 1.0, "a share from 0 to 1");
    negate();
    origin();
    mode();
    if (!good_) return std::nullopt;
    return map_;
  }

 private:
  const Entry* need(std::string_view key, bool required) {
    const Entry* entry = yaml_.find(key);
    if (entry == nullptr && required) {
      diagnostics_.report(Kind::kYamlMissing, {}, {diagnostics_.sources().path(file_), key});
      good_ = false;
    }
    return entry;
  }
  void reject(source::Span at, std::string_view text, std::string_view what) {
    diagnostics_.report(Kind::kYamlValue, at, {diagnostics::visible(text.substr(0, 40)), what});
    good_ = false;
  }
  void image() {
    const Entry* entry = need("image", true);
    if (entry == nullptr) return;
    if (entry->value.text.empty() || entry->list) return reject(entry->key.at, entry->value.text, "the name of a file");
    map_.image = entry->value.text;
    map_.image_at = entry->value.at;
  }
  void number(std::string_view key, bool required, double& out, double least, double most, std::string_view what) {
    const Entry* entry = need(key, required);
    if (entry == nullptr) return;
    const auto value = parse_number(entry->value.text);
    if (!value || *value < least || *value > most) return reject(entry->value.at, entry->value.text, what);
    out = *value;
  }
  void origin() {
    const Entry* entry = need("origin", true);
    if (entry == nullptr) return;
    std::array<double, 3> values{};
    bool right = entry->list && entry->items.size() == values.size();
    for (std::size_t i = 0; right && i < values.size(); ++i) {
      const auto value = parse_number(entry->items[i].text);
      right = value && std::abs(*value) <= 1e9;
      if (right) values[i] = *value;
    }
    if (!right) return reject(entry->key.at, entry->key.text, "followed by three numbers: x, y in metres, and a turn");
    map_.origin_m = {values[0], values[1]};
    if (std::abs(values[2]) > 1e-9) {
      diagnostics_.report(Kind::kYamlTurned, entry->items[2].at, {entry->items[2].text});
      good_ = false;
    }
  }
  void negate() {
    const Entry* entry = need("negate", false);
    if (entry == nullptr) return;
    const std::string_view text = entry->value.text;
    map_.negate = text == "1" || text == "true";
    if (!map_.negate && text != "0" && text != "false") reject(entry->value.at, text, "0 or 1, `true` or `false`");
  }
  void mode() {
    const Entry* entry = need("mode", false);
    if (entry == nullptr) return;
    if (entry->value.text == "trinary") map_.mode = RosMap::Mode::kTrinary;
    else if (entry->value.text == "scale") map_.mode = RosMap::Mode::kScale;
    else if (entry->value.text == "raw") map_.mode = RosMap::Mode::kRaw;
    else reject(entry->value.at, entry->value.text, "`trinary`, `scale` or `raw`");
  }

  const Yaml& yaml_;
  source::FileId file_;
  Diagnostics& diagnostics_;
  RosMap map_;
  bool good_ = true;
};

}  // namespace

std::optional<RosMap> read_ros_yaml(source::FileId file, Diagnostics& diagnostics) {
  Yaml yaml(file, diagnostics);
  if (!yaml.read()) return std::nullopt;
  return MapReader(yaml, file, diagnostics).read();
}

}  // namespace kb::planners
