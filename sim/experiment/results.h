// Results on disk, so that an interrupted experiment goes on where it was.
//
// note [nothing already written is lost]
// Each result is one line, appended with one write. A line that was torn (killed, or the disk was full) has no end: it is cut
// off when the file is opened again, and its run is done anew. Lines stand in the order in which runs ended; whoever reads them
// sorts. So an interrupted experiment and one that was not give the same table, whatever the number of threads.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {

/// What must be the same for results to belong together: the seed and the like, and what the library's rules say.
[[nodiscard]] std::string fingerprint(const Setup& setup, const source::FileSystem& files);

class Results {
 public:
  enum class Opened : std::uint8_t { kNew, kGoesOn, kOther, kFailed };
  /// Opens or makes `path` for an experiment of so many scenarios. kOther: it holds the results of another one (untouched).
  /// kFailed: see error().
  [[nodiscard]] Opened open(const std::string& path, const std::string& fingerprint, std::uint32_t scenarios);
  ~Results();
  Results() = default;
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  [[nodiscard]] bool has(std::uint32_t scenario, Method method) const { return rows_.contains({scenario, method}); }
  [[nodiscard]] std::size_t count() const { return rows_.size(); }
  /// Appends a result. False if it could not be written: then the file holds what it held.
  [[nodiscard]] bool add(const Row& row);
  /// By scenario, then by method.
  [[nodiscard]] std::vector<Row> sorted() const;
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] bool append(const std::string& line);
  [[nodiscard]] bool read(std::string_view bytes, std::string_view header, std::uint32_t scenarios);
  int file_ = -1;
  std::size_t size_ = 0;
  std::map<std::pair<std::uint32_t, Method>, Row> rows_;
  std::string error_;
};

}  // namespace kb::sim::experiment
