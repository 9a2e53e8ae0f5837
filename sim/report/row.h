// A row of CSV.
#pragma once

#include <string>
#include <string_view>

namespace kb::sim::report {

/// Joins the fields of a row; the destructor ends the row.
class Row {
 public:
  /// Adds to `out`, which must outlive it.
  explicit Row(std::string& out) : out_(out) {}
  ~Row() { out_ += '\n'; }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  /// Adds a text, in quotes if a reader would misread a comma or a bracket in it; line breaks become spaces.
  void text(std::string_view words);
  /// At most six decimal places; empty if it is unknown.
  void number(double value, bool known = true);
  /// At most six decimal places, or `nan`.
  void fact(float value);
  /// All digits, so that reading gives the same float; empty for 0, "no data".
  void certainty(float value);

 private:
  void comma();
  std::string& out_;
  bool first_ = true;
};

}  // namespace kb::sim::report
