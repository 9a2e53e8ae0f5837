// Reads the YAML of ROS map_server: keys whose values are scalars or lists, one key a line or all of them in braces as in JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
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
    return close == std::string_view::npos ? value : part(value, 1, close - 1);
  }
  std::size_t comment = std::min(value.text.find(" #"), value.text.find("\t#"));
  if (value.text.starts_with('#')) comment = 0;
  return comment == std::string_view::npos ? value : trim(part(value, 0, comment));
}

// Reads `[1, 2, 3]` and `{a: 1, b: [2, 3]}`, which may extend over several lines.
class Flow {
 public:
  explicit Flow(const Word& rest) : rest_(rest) {}

  // What has not been read yet.
  [[nodiscard]] const Word& rest() const { return rest_; }

  bool take(char c) {
    skip();
    if (!rest_.text.starts_with(c)) return false;
    rest_ = part(rest_, 1, rest_.text.size() - 1);
    return true;
  }

  bool read_list(Entry& entry) {
    entry.list = true;
    if (!take('[')) return false;
    while (!take(']')) {
      const Word item = scalar(",[]{}\r\n");
      if (item.text.empty()) return false;
      entry.items.push_back(item);
      if (!take(',') && !rest_.text.starts_with(']')) return false;
    }
    return true;
  }

  bool read_key(Entry& entry) {
    entry.key = scalar(",:[]{}\r\n");
    return !entry.key.text.empty() && take(':');
  }
  bool read_value(Entry& entry) {
    skip();
    if (rest_.text.starts_with('[')) return read_list(entry);
    entry.value = scalar(",[]{}\r\n");
    return true;
  }

 private:
  // Skips blanks, ends of lines and comments.
  void skip() {
    for (;;) {
      const std::size_t begin = std::min(rest_.text.find_first_not_of(" \t\r\n"), rest_.text.size());
      rest_ = part(rest_, begin, rest_.text.size() - begin);
      if (!rest_.text.starts_with('#')) return;
      const std::size_t end = std::min(rest_.text.find('\n'), rest_.text.size());
      rest_ = part(rest_, end, rest_.text.size() - end);
    }
  }
  // Reads a scalar: in quotes, or up to one of `ends`.
  Word scalar(std::string_view ends) {
    skip();
    const bool quoted = rest_.text.starts_with('"') || rest_.text.starts_with('\'');
    const std::size_t end = quoted ? rest_.text.find(rest_.text[0], 1) : std::min(rest_.text.find_first_of(ends), rest_.text.size());
    if (end == std::string_view::npos) return part(rest_, 0, 0);
    const Word word = quoted ? part(rest_, 1, end - 1) : strip(part(rest_, 0, end));
    const std::size_t next = quoted ? end + 1 : end;
    rest_ = part(rest_, next, rest_.text.size() - next);
    return word;
  }

  Word rest_;
};

class Yaml {
 public:
  Yaml(source::FileId file, Diagnostics& diagnostics) : lines_(diagnostics.sources(), file), diagnostics_(diagnostics) {}

  bool read() {
    while (lines_.more()) {
      const Word line = lines_.next();
      const Word text = strip(line);
      if (text.text.empty() || text.text == "---" || text.text == "..." || text.text.starts_with('%')) continue;
      if (!(text.text.starts_with('{') ? read_braces(text) : read_line(line, text))) return false;
    }
    return true;
  }

  const Entry* find(std::string_view key) const {
    for (const Entry& entry : entries_) {
      if (entry.key.text == key) return &entry;
    }
    return nullptr;
  }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  bool refuse(source::Span at) {
    diagnostics_.report(Kind::kYamlLine, at);
    return false;
  }

  bool read_braces(const Word& text) {
    Flow flow(lines_.from(text));
    flow.take('{');
    while (!flow.take('}')) {
      Entry entry;
      if (!flow.read_key(entry) || !flow.read_value(entry)) return refuse(text.at);
      if (!add(std::move(entry))) return false;
      if (!flow.take(',') && !flow.rest().text.starts_with('}')) return refuse(text.at);
    }
    lines_.go_on_at(flow.rest());
    return true;
  }

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
    if (!spaced || colon == 0 || line.text[0] == ' ' || line.text[0] == '\t') return refuse(text.at);
    Entry entry;
    entry.key = trim(part(line, 0, colon));
    const Word value = part(line, colon + 1, line.text.size() - colon - 1);
    entry.value = strip(value);
    if (entry.value.text.starts_with('[')) {
      Flow flow(lines_.from(entry.value));
      if (!flow.read_list(entry)) return refuse(text.at);
      lines_.go_on_at(flow.rest());
    }
    return add(std::move(entry));
  }

  bool add(Entry entry) {
    if (find(entry.key.text) != nullptr) {
      diagnostics_.report(Kind::kYamlTwice, entry.key.at, {diagnostics::visible(entry.key.text)});
      return false;
    }
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
    number("resolution", true, map_.resolution_m, 1e-6, 1e6, "a number of metres from 1e-6 to 1e6");
    number("occupied_thresh", false, map_.occupied_thresh, 0.0, 1.0, "a share from 0 to 1");
    number("free_thresh", false, map_.free_thresh, 0.0, 1.0, "a share from 0 to 1");
    negate();
    origin();
    mode();
    slips();
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
  // Other programs may have keys of their own, but a misspelt one would silently leave a default.
  void slips() {
    for (const Entry& entry : yaml_.entries()) {
      for (const std::string_view key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"}) {
        if (entry.key.text != key && diagnostics::is_slip_of(entry.key.text, key)) reject(entry.key.at, entry.key.text, fmt::format("a key of a map; `{}` is one", key));
      }
    }
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
    const std::string_view text = entry->value.text;
    map_.raw = text == "raw";
    if (!map_.raw && text != "trinary" && text != "scale") reject(entry->value.at, text, "`trinary`, `scale` or `raw`");
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
