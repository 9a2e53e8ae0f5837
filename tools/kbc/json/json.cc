#include "tools/kbc/json/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>

namespace kb::json {
namespace {

// The library tells what it has read, but not where. So it reads through this iterator, which notes how far it has come.
struct Counting {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  Counting& operator++() {
    *reached = ++at;
    return *this;
  }
  Counting operator++(int) {
    const Counting before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Counting& a, const Counting& b) { return a.at == b.at; }
  friend bool operator!=(const Counting& a, const Counting& b) { return !(a == b); }
};

/// Takes the events of nlohmann's parser. At each, the value just read ends at `reached_`, or a byte before it if it is a number.
class Builder {
 public:
  Builder(std::string_view bytes, source::FileId file, Fault& fault) : bytes_(bytes), file_(file), fault_(fault), reached_(bytes.data()), last_(bytes.data()) {}

  [[nodiscard]] bool run() {
    return nlohmann::json::sax_parse(Counting{bytes_.data(), &reached_}, Counting{bytes_.data() + bytes_.size(), &reached_}, this);
  }
  [[nodiscard]] Json take() { return std::move(root_); }

  bool null() { return add(Json::Kind::kNull); }
  bool boolean(bool value) {
    const bool good = add(Json::Kind::kBool);
    added_->text = value ? "true" : "false";
    return good;
  }
  bool number_integer(std::int64_t value) { return add_number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return add_number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return add_number(value); }
  bool string(std::string& value) {
    const bool good = add(Json::Kind::kString);
    added_->text = std::move(value);
    return good;
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(Json::Kind::kObject); }
  bool start_array(std::size_t) { return open(Json::Kind::kList); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    open_.back()->keys.push_back(std::move(name));
    last_ = reached_;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 2, column 4: syntax error while parsing value - ...": we take the message, and know the place ourselves.
    const std::string_view text = error.what();
    const std::size_t column = text.find(" column "), colon = column == std::string_view::npos ? column : text.find(": ", column);
    const std::string_view what = colon == std::string_view::npos ? text.substr(text.find(']') + 2) : text.substr(colon + 2);
    const auto at = static_cast<std::uint32_t>(position == 0 ? 0 : std::min(position - 1, bytes_.size()));
    fault_ = {{file_, at, at + 1}, std::string(what.substr(0, what.find("; last read")))};
    return false;
  }

 private:
  // The place of the value just read: it begins behind the one before, after blanks, commas and colons.
  [[nodiscard]] source::Span span_of(Json::Kind kind) {
    const char* begin = last_;
    while (begin < reached_ && std::string_view(" \t\r\n,:\xEF\xBB\xBF").find(*begin) != std::string_view::npos) ++begin;
    const char* end = reached_;
    if (kind == Json::Kind::kNumber) {
      end = begin;
      while (end < bytes_.data() + bytes_.size() && std::string_view("+-.0123456789eE").find(*end) != std::string_view::npos) ++end;
    }
    last_ = end;
    const auto offset = [this](const char* p) { return static_cast<std::uint32_t>(p - bytes_.data()); };
    return {file_, offset(begin), offset(end)};
  }
  bool add(Json::Kind kind) {
    if (open_.empty()) {
      added_ = &root_;
    } else {
      open_.back()->parts.emplace_back();
      added_ = &open_.back()->parts.back();
    }
    added_->kind = kind;
    added_->span = span_of(kind);
    return true;
  }
  bool add_number(double value) {
    add(Json::Kind::kNumber);
    added_->number = value;
    added_->text = bytes_.substr(added_->span.begin, added_->span.end - added_->span.begin);
    return true;
  }
  bool open(Json::Kind kind) {
    add(kind);
    open_.push_back(added_);   // the pointer stays valid: the list that holds it does not grow until it is closed
    if (open_.size() <= kMaxNesting) return true;
    fault_ = {added_->span, fmt::format("nested deeper than {}", kMaxNesting)};
    return false;
  }
  bool close() {
    last_ = reached_;
    open_.pop_back();
    return true;
  }

  std::string_view bytes_;
  source::FileId file_;
  Fault& fault_;
  const char* reached_;
  const char* last_;   // the end of what was read before
  Json root_;
  Json* added_ = nullptr;
  std::vector<Json*> open_;
};

}  // namespace

std::optional<RepeatedKey> repeated_key(const Json& json) {
  std::unordered_set<std::string_view> keys;
  for (std::size_t i = 0; i < json.parts.size(); ++i) {
    if (!json.keys.empty() && !keys.insert(json.keys[i]).second) return RepeatedKey{json.keys[i], json.parts[i].span};
    if (auto inner = repeated_key(json.parts[i])) return inner;
  }
  return std::nullopt;
}

std::string_view kind_name(Json::Kind kind) {
  static constexpr std::string_view kNames[] = {"null", "a truth value", "a number", "a string", "a list", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

const Json* Json::find(std::string_view key) const {
  for (std::size_t i = keys.size(); i-- > 0;) {
    if (keys[i] == key) return parts[i].kind == Kind::kNull ? nullptr : &parts[i];
  }
  return nullptr;
}

std::optional<Json> parse(std::string_view bytes, source::FileId file, Fault& fault) {
  Builder builder(bytes, file, fault);
  if (!builder.run()) return std::nullopt;
  if (const std::size_t zero = bytes.find('\0'); zero != std::string_view::npos) {   // the library takes it for the end of the text
    const auto at = static_cast<std::uint32_t>(zero);
    fault = {{file, at, at + 1}, "a byte 0 stands in it"};
    return std::nullopt;
  }
  return builder.take();
}

}  // namespace kb::json
