// A row of CSV.
#pragma once

#include <string>
#include <string_view>

namespace kb::sim::report {

/// Joins the fields of a row, and ends it when it goes.
class Row {
 public:
  /// Adds to `out`, which must outlive it.
  explicit Row(std::string& out) : out_(out) {}
  ~Row() { out_ += '\n'; }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  /// In quotes where a reader would take a comma or a bracket of it otherwise; line breaks become spaces.
  void text(std::string_view words);
  /// Six places at most; nothing if it is not known.
  void number(double value, bool known = true);
  /// Six places at most, or `nan`.
  void fact(float value);
  /// All digits, so that it is the same float again when it is read; nothing for 0, "no data".
  void certainty(float value);

 private:
  void comma();
  std::string& out_;
  bool first_ = true;
};

}  // namespace kb::sim::report
