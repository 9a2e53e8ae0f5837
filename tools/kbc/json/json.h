// JSON whose values know their place in the file, so that messages can point to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::json {

inline constexpr std::size_t kMaxNesting = 64;

struct Json {
  enum class Kind : std::uint8_t { kNull, kBool, kNumber, kString, kList, kObject };
  Kind kind = Kind::kNull;
  source::Span span;               ///< of lists and objects: the first bracket
  std::string text;                ///< a string; a number or a truth value as written
  double number = 0.0;
  std::vector<Json> parts;         ///< of lists and objects
  std::vector<std::string> keys;   ///< of objects: one for each part

  /// The part of an object; null if there is none, or if it is `null`. If the key occurs several times, the last
  /// one, as with most readers.
  [[nodiscard]] const Json* find(std::string_view key) const;
  /// Whether both have the same value, wherever they stand. The order of keys counts.
  friend bool operator==(const Json& a, const Json& b) {
    return a.kind == b.kind && a.text == b.text && a.parts == b.parts && a.keys == b.keys;
  }
};

/// Why something is not JSON, and where.
struct Fault {
  source::Span span;
  std::string what;
};

/// Parses `bytes`, which are the beginning of `file`. Nothing if they are not JSON, or nested deeper than kMaxNesting: `fault` says why.
[[nodiscard]] std::optional<Json> parse(std::string_view bytes, source::FileId file, Fault& fault);

/// A key that an object has twice, and the place of its second value.
struct RepeatedKey {
  std::string_view key;
  source::Span span;
};

/// The first of them, however deep it lies; nothing if there is none. It lives as long as `json`.
[[nodiscard]] std::optional<RepeatedKey> repeated_key(const Json& json);

/// `a number`, `an object`.
[[nodiscard]] std::string_view kind_name(Json::Kind kind);

}  // namespace kb::json
