#include "sim/experiment/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/model.h"
#include "compiler/source/fingerprint.h"
#include "compiler/source/reason.h"
#include "sim/experiment/town.h"

namespace kb::sim::experiment {
namespace {

constexpr std::string_view kMindMark = "# mind ";

/// Reads the whole file. False, with the reason in errno, if that fails: rows that were not read must not be cut off later.
bool read_all(int file, std::string& bytes) {
  char buffer[65536];
  for (;;) {
    const ssize_t got = ::read(file, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got == 0;
    bytes.append(buffer, static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string fingerprint(const Setup& setup, std::string_view program, const source::FileSystem& files) {
  source::Fingerprint rules, maze;
  source::Sources imported;
  diagnostics::CountingConsumer nobody;
  diagnostics::Diagnostics messages(imported, nobody);
  constexpr std::string_view kMission = "mission.kb";
  static_cast<void>(model::load(kMission, setup.library, source::OneFileMore(kMission, kRules, files), imported, messages));
  for (std::uint32_t i = 0; i < imported.size(); ++i) rules.mix(imported.bytes(source::FileId{i}));
  if (setup.maze != nullptr) maze.mix(setup.maze->all_moves());
  std::string set;
  for (std::size_t key = 0; key < setup.set.front().size(); ++key) {
    set += fmt::format(", {}=", setup.set.front()[key].key);
    std::vector<std::string> values;
    for (const auto& settings : setup.set) {
      if (std::find(values.begin(), values.end(), settings[key].value) == values.end()) values.push_back(settings[key].value);
    }
    set += fmt::format("{}", fmt::join(values, ","));
  }
  return fmt::format("# kbc {}, seed {}, scenarios {}, labyrinths {}, maze {}, rules {:016x}{}", program, setup.seed, setup.scenarios, setup.labyrinths,
                     setup.maze != nullptr ? fmt::format("{:016x}", maze.value()) : "none", rules.value(), set);
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
      error_ = put < 0 ? source::reason(errno) : "no room";
      if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) error_ += ", and a torn line is left, which is cut off next time";
      return false;
    }
    done += static_cast<std::size_t>(put);
  }
  size_ += line.size();
  return true;
}

/// Takes a row, or the line before the first row of a mind that says by which rules its rows were driven. False if the line is neither.
bool Results::take_line(std::string_view line, std::uint32_t scenarios) {
  if (line.starts_with(kMindMark)) {
    line.remove_prefix(kMindMark.size());
    const std::size_t blank = line.find(' ');
    return blank != std::string_view::npos && minds_.emplace(line.substr(0, blank), line.substr(blank + 1)).second;
  }
  auto row = parse_row(line, set_);
  if (!row || row->scenario >= scenarios) return false;
  const auto& known = built_in_methods();
  if (!minds_.contains(row->method) && std::none_of(known.begin(), known.end(), [&](const Method& m) { return m.name == row->method; })) return false;
  rows_.insert(std::move(*row));
  return true;
}

/// Takes whole lines only. False if the file does not begin with the header of this experiment.
bool Results::read(std::string_view bytes, std::uint32_t scenarios) {
  if (!bytes.starts_with(header_)) return false;
  bytes.remove_prefix(header_.size());
  size_ = header_.size();
  for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
    // A bad line is a page of the file that never reached the disk, or was written by somebody else: all runs after it are done again.
    if (!take_line(bytes.substr(0, end), scenarios)) break;
    size_ += end + 1;
    bytes.remove_prefix(end + 1);
  }
  return true;
}

Results::Opened Results::open(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds) {
  set_ = setup.set;
  header_ = fmt::format("{}\n{}\n", fingerprint, row_header(set_));
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  // The kernel releases the lock when the process ends, however it ends. Where files cannot be locked, two experiments at once drive runs
  // twice.
  if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    error_ = "another `kbc experiment` has it in hand";
    return Opened::kFailed;
  }
  std::string bytes;
  if (file_ < 0 || !read_all(file_, bytes)) {
    error_ = source::reason(errno);
    return Opened::kFailed;
  }
  const bool torn_header = bytes.size() < header_.size() && header_.starts_with(bytes);
  if (!torn_header && !read(bytes, setup.scenarios)) return Opened::kOther;
  for (const auto& [name, mind] : minds) {
    if (const auto known = minds_.find(name); known == minds_.end() || known->second == mind) continue;
    error_ = name;
    return Opened::kOtherMind;
  }
  if (size_ != bytes.size() && ::ftruncate(file_, static_cast<off_t>(size_)) != 0) {
    error_ = source::reason(errno);
    return Opened::kFailed;
  }
  if (size_ == 0 && !append(header_)) return Opened::kFailed;
  for (const auto& [name, mind] : minds) {
    if (minds_.emplace(name, mind).second && !append(fmt::format("{}{} {}\n", kMindMark, name, mind))) return Opened::kFailed;
  }
  return Opened::kOpen;
}

bool Results::add(const Row& row) {
  const std::string line = experiment::print(row, set_);
  if (!append(line + "\n")) return false;
  // The row is kept rounded, as it will be read again; otherwise an interrupted experiment would end with another table.
  rows_.insert(parse_row(line, set_).value_or(row));
  return true;
}

std::string Results::print() const {
  std::string out = header_;
  for (const auto& [name, mind] : minds_) out += fmt::format("{}{} {}\n", kMindMark, name, mind);
  for (const Row& row : rows_) out += experiment::print(row, set_) + "\n";
  return out;
}

}  // namespace kb::sim::experiment
