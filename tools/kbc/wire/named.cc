#include "tools/kbc/wire/named.h"

#include <algorithm>
#include <charconv>

#include "tools/kbc/json/json.h"

namespace kb::wire {
namespace {

using json::Json;

/// `buttons` may be a single name, which is a mistake, and is clear enough.
void take_buttons(const Json& buttons, std::vector<std::string>& names) {
  if (buttons.kind == Json::Kind::kString) names.push_back(buttons.text);
  for (const Json& part : buttons.parts) {
    if (part.kind == Json::Kind::kString) names.push_back(part.text);
  }
}

void take_facts(const Json& facts, std::vector<std::string>& names) {
  for (std::size_t i = 0; i < facts.keys.size(); ++i) {
    const Json& value = facts.parts[i];
    const bool holds = value.kind == Json::Kind::kNumber ? value.number > 0.0 : value.kind == Json::Kind::kBool && value.text == "true";
    if (holds) names.push_back(facts.keys[i]);
  }
}

/// Walks over text that is no JSON, word by word.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  /// Moves behind the next `"key":` and the bracket after it. False if there is none.
  bool enter(std::string_view key, char bracket) {
    const std::string quoted = "\"" + std::string(key) + "\"";
    for (std::size_t at = rest_.find(quoted); at != std::string_view::npos; at = rest_.find(quoted)) {
      rest_.remove_prefix(at + quoted.size());
      if (skip(':') && skip(bracket)) return true;
    }
    return false;
  }
  bool skip(char wanted) {
    const std::size_t at = rest_.find_first_not_of(" \t\r");
    if (at == std::string_view::npos || rest_[at] != wanted) return false;
    rest_.remove_prefix(at + 1);
    return true;
  }
  /// A string without escapes, which names of facts do not have.
  bool string(std::string& text) {
    if (!skip('"')) return false;
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) return false;
    text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return true;
  }
  /// Passes over a value, with all that it has inside. Whether it is `true` or a number above 0.
  bool holds() {
    const std::size_t begin = std::min(rest_.find_first_not_of(" \t\r"), rest_.size());
    rest_.remove_prefix(begin);
    double number = rest_.starts_with("true") ? 1.0 : 0.0;
    std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    std::size_t end = 0, open = 0;
    for (bool quoted = false; end < rest_.size() && (open > 0 || quoted || (rest_[end] != ',' && rest_[end] != '}')); ++end) {
      if (rest_[end] == '"') quoted = !quoted;
      if (quoted) continue;
      if (rest_[end] == '{' || rest_[end] == '[') ++open;
      if ((rest_[end] == '}' || rest_[end] == ']') && open > 0) --open;
    }
    rest_.remove_prefix(end);
    return number > 0.0;
  }

 private:
  std::string_view rest_;
};

}  // namespace

std::vector<std::string> named_in(std::string_view text) {
  std::vector<std::string> names;
  json::Fault fault;
  if (const auto object = json::parse(text, source::FileId::kNone, fault)) {
    for (std::size_t i = 0; i < object->keys.size(); ++i) {
      if (object->keys[i] == "buttons") take_buttons(object->parts[i], names);
      if (object->keys[i] == "facts") take_facts(object->parts[i], names);
    }
    return names;
  }
  std::string name;
  for (Words words(text); words.enter("buttons", '[');) {
    while (words.string(name)) {
      names.push_back(name);
      words.skip(',');
    }
  }
  for (Words words(text); words.enter("facts", '{');) {
    while (words.string(name) && words.skip(':')) {
      if (words.holds()) names.push_back(name);
      words.skip(',');
    }
  }
  return names;
}

}  // namespace kb::wire
