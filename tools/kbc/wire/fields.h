// Reads the fields of a JSON object by a table. Unknown fields, fields given twice, wrong types and values out of range are mistakes; the
// first one is kept.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/json/json.h"
#include "tools/kbc/wire/mistake.h"

namespace kb::wire {

using json::Json;

/// The longest line that is read, in bytes; the longest answer as well.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 18;

struct Range { double low = 0.0, high = 0.0; };

/// Converts values of JSON and keeps the first mistake.
class Reading {
 public:
  /// The object that `text` consists of. Nothing if it is not one (a mistake).
  [[nodiscard]] std::optional<Json> object(std::string_view text);

  /// A number as the float nearest to its digits. This restores a float that was written with the fewest digits that identify it.
  void number(std::string_view field, const Json& json, Range range, float& value);
  void number(std::string_view field, const Json& json, Range range, double& value);
  void truth(std::string_view field, const Json& json, bool& value);
  void text(std::string_view field, const Json& json, std::string& value);
  void texts(std::string_view field, const Json& json, std::vector<std::string>& values);
  /// A string that is one of `words`.
  void word(std::string_view field, const Json& json, std::span<const std::string_view> words, std::string& value);
  /// As many numbers as `values` has; `null` becomes NaN.
  void numbers(std::string_view field, const Json& json, Range range, std::span<float> values);
  /// Whether the value is of that kind; if not, that is a mistake.
  bool is(std::string_view field, const Json& json, Json::Kind kind);
  /// Another kind of value was wanted: `a number`.
  void unwanted(std::string_view field, const Json& json, std::string wanted);
  /// Checks that no key occurs twice; `prefix` is put before their names: `tag.`.
  void once(std::string_view prefix, const Json& object);

  void wrong(Mistake mistake) {
    if (!mistake_) mistake_ = std::move(mistake);
  }
  /// The place of a key whose value is at `value`.
  [[nodiscard]] source::Span key_of(std::string_view key, source::Span value) const;
  void missing(std::string_view field, std::string_view why, source::Span at);
  [[nodiscard]] const std::optional<Mistake>& mistake() const { return mistake_; }

 private:
  bool in_range(std::string_view field, const Json& json, double value, Range range);
  std::string_view text_;
  std::optional<Mistake> mistake_;
};

/// One field of an object that is read into a `Target`. A value `null` counts as a missing field.
template <class Target>
struct Field {
  std::string_view name;
  void (*read)(Reading& reading, const Json& json, Target& target);
  std::string_view unit = {}, about = {};   ///< for help; empty where none is given
};

/// The object or list that begins at `begin` in `text`, which must be JSON, up to its closing bracket.
[[nodiscard]] std::string_view part_at(std::string_view text, std::size_t begin);

[[nodiscard]] Mistake unknown_field(std::string_view prefix, const std::string& key, std::span<const std::string_view> known, source::Span at);

/// Reads all fields of `object`, in its order, up to the first mistake.
template <class Target>
void read_fields(Reading& reading, std::string_view prefix, const Json& object, std::span<const Field<Target>> fields, Target& target) {
  reading.once(prefix, object);
  for (std::size_t i = 0; i < object.keys.size() && !reading.mistake(); ++i) {
    const Field<Target>* found = nullptr;
    for (const Field<Target>& field : fields) {
      if (field.name == object.keys[i]) found = &field;
    }
    if (found == nullptr) {
      std::vector<std::string_view> known;
      for (const Field<Target>& field : fields) known.push_back(field.name);
      reading.wrong(unknown_field(prefix, object.keys[i], known, reading.key_of(object.keys[i], object.parts[i].span)));
    } else if (object.parts[i].kind != Json::Kind::kNull) {
      found->read(reading, object.parts[i], target);
    }
  }
}

}  // namespace kb::wire
