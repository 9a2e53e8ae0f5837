// JSON of layouts; errors in a value are reported at its place. Private to this folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "tools/kbc/json/json.h"

namespace kb::layout {

using json::Json;

/// The document in `file`. Nothing if it is not JSON, or nested deeper than 64 (reported).
[[nodiscard]] std::optional<Json> read_json(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);

/// An object with its name in messages; reports required parts that are missing.
class Fields {
 public:
  Fields(const Json& object, std::string what, diagnostics::Diagnostics& diagnostics)
      : object_(object), what_(std::move(what)), diagnostics_(diagnostics) {}
  /// The part of that kind, which must be there. Null if it is not, or is something else (reported).
  [[nodiscard]] const Json* want(std::string_view key, Json::Kind kind) const;
  /// The same, but optional: null without a message if it is not there.
  [[nodiscard]] const Json* may(std::string_view key, Json::Kind kind) const;
  /// The number that must be there; 0 if it is not.
  [[nodiscard]] double number(std::string_view key) const;
  /// The same for a 32-bit integer from 0 on.
  [[nodiscard]] double count(std::string_view key) const;
  /// The objects of a list that must be there. Anything else in it is reported and skipped.
  [[nodiscard]] std::vector<const Json*> objects(std::string_view key) const;

 private:
  [[nodiscard]] const Json* checked(const Json* part, std::string_view key, Json::Kind kind) const;
  const Json& object_;
  std::string what_;
  diagnostics::Diagnostics& diagnostics_;
};

}  // namespace kb::layout
