// Results on disk, so that an interrupted experiment continues where it stopped.
//
// note [nothing already written is lost]
// Each result is one line, appended with one write. A torn line (the process was killed, or the disk was full) has no line
// break: it is cut off when the file is opened again, and its run is repeated. Lines stand in the order in which runs ended; readers
// sort them. So an experiment gives the same table whether interrupted or not, with any number of threads.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {

/// Identifies results that belong together: by the setup (the seed and so on), the library's rules, and the `program`, as its
/// simulator and controllers influence each result: it must differ between two builds of kbc that may differ in these.
[[nodiscard]] std::string fingerprint(const Setup& setup, std::string_view program, const source::FileSystem& files);

class Results {
 public:
  /// The fingerprint of each of the user's minds, by name. Minds not named now keep their rows.
  using Minds = std::map<std::string, std::string>;
  enum class Opened : std::uint8_t { kOpen, kOther, kNotOurs, kOtherMind, kFailed };
  /// Opens or makes `path` for an experiment, and locks it for this process, as two processes would cut off each other's lines.
  /// kOther: the file holds another experiment's results and is untouched; error() says in what that differs, `seed 2 instead of 1`.
  /// kNotOurs: it holds something else, which error() names. kOtherMind: it holds results of another mind of the same name, which error() names.
  /// kFailed: see error().
  [[nodiscard]] Opened open(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds = {});
  /// The same for a file that is only read: it is neither made, locked nor changed, and nothing can be added.
  [[nodiscard]] Opened look(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds = {});
  ~Results();
  Results() = default;
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Appends a result. False if it could not be written; the file is then unchanged.
  [[nodiscard]] bool add(const Row& row);
  /// In the order of `before`.
  [[nodiscard]] std::vector<Row> sorted() const { return {rows_.begin(), rows_.end()}; }
  /// The text of the complete file, in order.
  [[nodiscard]] std::string print() const;
  [[nodiscard]] const std::string& error() const { return error_; }
  /// The number of the first whole line that is no result of this experiment, from 1; 0: there was none. It and those behind it are not taken,
  /// and `open` cut them off.
  [[nodiscard]] std::size_t bad_line() const { return bad_line_; }

 private:
  [[nodiscard]] bool append(const std::string& line);
  [[nodiscard]] Opened take(std::string_view bytes, const std::string& fingerprint, const Setup& setup, const Minds& minds);
  void read(std::string_view bytes, const Setup& setup);
  [[nodiscard]] bool take_line(std::string_view line, const Setup& setup);
  struct Order { bool operator()(const Row& a, const Row& b) const { return before(a, b); } };
  int file_ = -1;
  std::size_t size_ = 0, bad_line_ = 0;
  std::set<Row, Order> rows_;
  std::string header_;
  Setup setup_;
  Minds minds_;
  std::string error_;
};

}  // namespace kb::sim::experiment
