#include "sim/experiment/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim/batch/fingerprint.h"

namespace kb::sim::experiment {
namespace {

std::string read_all(int file) {
  std::string bytes;
  char buffer[65536];
  for (;;) {
    const ssize_t got = ::read(file, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string fingerprint(const Setup& setup, const source::FileSystem& files) {
  batch::Fingerprint rules, maze;
  for (const char* name : {"basics", "crossing", "detour", "mission", "navigation", "obstacle", "recover", "retreat", "road", "route", "search"}) {
    rules.mix(files.read(fmt::format("{}/std/{}.kb", setup.library, name)).bytes.value_or(""));
  }
  if (setup.maze != nullptr) {
    for (const std::uint8_t moves : setup.maze->all_moves()) maze.mix(std::string_view(reinterpret_cast<const char*>(&moves), 1));
  }
  return fmt::format("# seed {}, scenarios {}, labyrinths {}, maze {}, rules {:016x}", setup.seed, setup.scenarios, setup.labyrinths,
                     setup.maze != nullptr ? fmt::format("{:016x}", maze.value()) : "none", rules.value());
}

Results::~Results() {
  if (file_ >= 0) ::close(file_);
}

bool Results::append(const std::string& line) {
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t put = ::write(file_, line.data() + done, line.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) {
      error_ = put < 0 ? std::strerror(errno) : "no room";
      if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) error_ += ", and a torn line is left, which is cut off next time";
      return false;
    }
    done += static_cast<std::size_t>(put);
  }
  size_ += line.size();
  return true;
}

/// Whole lines only. False if it begins otherwise than it must.
bool Results::read(std::string_view bytes, std::string_view header, std::uint32_t scenarios) {
  if (!bytes.starts_with(header)) return false;
  bytes.remove_prefix(header.size());
  size_ = header.size();
  for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
    const auto row = parse_row(bytes.substr(0, end));
    // A page of the file that never reached the disk, or somebody else's line: all after it is done again.
    if (!row || row->scenario >= scenarios) break;
    rows_[{row->scenario, row->method}] = *row;
    size_ += end + 1;
    bytes.remove_prefix(end + 1);
  }
  return true;
}

Results::Opened Results::open(const std::string& path, const std::string& fingerprint, std::uint32_t scenarios) {
  const std::string header = fmt::format("{}\n{}\n", fingerprint, kRowHeader);
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) {
    error_ = std::strerror(errno);
    return Opened::kFailed;
  }
  const std::string bytes = read_all(file_);
  const bool torn_header = bytes.size() < header.size() && header.starts_with(bytes);
  if (!torn_header && !read(bytes, header, scenarios)) return Opened::kOther;
  if (size_ != bytes.size() && ::ftruncate(file_, static_cast<off_t>(size_)) != 0) {
    error_ = std::strerror(errno);
    return Opened::kFailed;
  }
  if (size_ == 0 && !append(header)) return Opened::kFailed;
  return rows_.empty() ? Opened::kNew : Opened::kGoesOn;
}

bool Results::add(const Row& row) {
  const std::string line = print(row);
  if (!append(line + "\n")) return false;
  // As it will be read again: rounded, or an interrupted experiment would come to another table.
  rows_[{row.scenario, row.method}] = parse_row(line).value_or(row);
  return true;
}

std::vector<Row> Results::sorted() const {
  std::vector<Row> rows;
  rows.reserve(rows_.size());
  for (const auto& [key, row] : rows_) rows.push_back(row);
  return rows;
}

}  // namespace kb::sim::experiment
