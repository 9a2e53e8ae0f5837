// JSON whose values know where they stand, so that what is wrong with one can be shown. Private to this folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"

namespace kb::layout {

struct Json {
  enum class Kind : std::uint8_t { kNull, kBool, kNumber, kString, kList, kObject };
  Kind kind = Kind::kNull;
  source::Span span;               ///< of lists and objects their first bracket
  std::string text;                ///< a string; a number or a truth value as it is written
  double number = 0.0;
  std::vector<Json> parts;         ///< of lists and objects
  std::vector<std::string> keys;   ///< of objects: one for each part

  /// The part of an object; null if there is none, or if it is `null`. Of several the last, as most readers have it.
  [[nodiscard]] const Json* find(std::string_view key) const;
  /// Whether both say the same, wherever they stand. Keys count in their order.
  friend bool operator==(const Json& a, const Json& b) {
    return a.kind == b.kind && a.text == b.text && a.parts == b.parts && a.keys == b.keys;
  }
};

/// The document in `file`. Nothing if it is none, or nested deeper than 64 (reported).
[[nodiscard]] std::optional<Json> read_json(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);

/// An object under the name by which messages speak of it; what it must have and has not is reported.
class Fields {
 public:
  Fields(const Json& object, std::string what, diagnostics::Diagnostics& diagnostics)
      : object_(object), what_(std::move(what)), diagnostics_(diagnostics) {}
  /// The part of that kind, which must be there. Null if it is not, or is something else (reported).
  [[nodiscard]] const Json* want(std::string_view key, Json::Kind kind) const;
  /// The same, but it need not be there: null without a message then.
  [[nodiscard]] const Json* may(std::string_view key, Json::Kind kind) const;
  /// The number that must be there; 0 if it is not.
  [[nodiscard]] double number(std::string_view key) const;
  /// The same, which must be an integer of 32 bits from 0 on.
  [[nodiscard]] double count(std::string_view key) const;
  /// The objects of a list that must be there. What is none in it is reported and passed over.
  [[nodiscard]] std::vector<const Json*> objects(std::string_view key) const;

 private:
  [[nodiscard]] const Json* checked(const Json* part, std::string_view key, Json::Kind kind) const;
  const Json& object_;
  std::string what_;
  diagnostics::Diagnostics& diagnostics_;
};

}  // namespace kb::layout
