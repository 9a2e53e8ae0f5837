// Results on disk, so that an interrupted experiment goes on where it was.
//
// note [nothing already written is lost]
// Each result is one line, appended with one write. A line that was torn (killed, or the disk was full) has no end: it is cut
// off when the file is opened again, and its run is done anew. Lines stand in the order in which runs ended; whoever reads them
// sorts. So an interrupted experiment and one that was not give the same table, whatever the number of threads.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {

/// What must be the same for results to belong together: the seed and the like, what the library's rules say, and the `version` of kbc, whose
/// simulator and controllers have a part in each result.
[[nodiscard]] std::string fingerprint(const Setup& setup, std::string_view version, const source::FileSystem& files);

class Results {
 public:
  /// What tells each mind of the user's from others: by name, its fingerprint. Minds that are not named now keep their rows.
  using Minds = std::map<std::string, std::string>;
  enum class Opened : std::uint8_t { kOpen, kOther, kOtherMind, kFailed };
  /// Opens or makes `path` for an experiment, and locks it for this process: two would cut off each other's lines. kOther: it holds the results of another one (untouched). kOtherMind: it holds those of
  /// another mind of the same name, which error() says. kFailed: see error().
  [[nodiscard]] Opened open(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds = {});
  ~Results();
  Results() = default;
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Appends a result. False if it could not be written: then the file holds what it held.
  [[nodiscard]] bool add(const Row& row);
  /// In the order of `before`.
  [[nodiscard]] std::vector<Row> sorted() const { return {rows_.begin(), rows_.end()}; }
  /// The file as it is when all runs are in it.
  [[nodiscard]] std::string print() const;
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] bool append(const std::string& line);
  [[nodiscard]] bool read(std::string_view bytes, std::uint32_t scenarios);
  [[nodiscard]] bool take_line(std::string_view line, std::uint32_t scenarios);
  struct Order { bool operator()(const Row& a, const Row& b) const { return before(a, b); } };
  int file_ = -1;
  std::size_t size_ = 0;
  std::set<Row, Order> rows_;
  std::string header_;
  Combinations set_;
  Minds minds_;
  std::string error_;
};

}  // namespace kb::sim::experiment
