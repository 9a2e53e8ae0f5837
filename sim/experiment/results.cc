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

constexpr std::string_view kMindMark = "# mind ", kProgramMark = "# kbc ";

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

/// The items of the first line of results: `seed 1`, `rules 0123456789abcdef`, `sensors.range.noise=0.1`. No item has a comma before a space.
std::vector<std::string_view> items_of(std::string_view line) {
  std::vector<std::string_view> items;
  for (std::size_t end = line.find(", "); end != std::string_view::npos; end = line.find(", ")) {
    items.push_back(line.substr(0, end));
    line.remove_prefix(end + 2);
  }
  items.push_back(line);
  return items;
}

std::string_view name_of(std::string_view item) { return item.starts_with(kProgramMark) ? kProgramMark : item.substr(0, item.find_first_of(" =")); }

/// In what the experiment of the line `there` differs from that of the line `here`: `seed 2 instead of 1, another maze`.
std::string difference(std::string_view there, std::string_view here) {
  const auto theirs = items_of(there), ours = items_of(here);
  std::string all;
  const auto add = [&all](const std::string& one) { all += (all.empty() ? "" : ", ") + one; };
  const auto find = [](const auto& items, std::string_view name) { return std::find_if(items.begin(), items.end(), [&](std::string_view item) { return name_of(item) == name; }); };
  for (const std::string_view item : theirs) {
    const std::string_view name = name_of(item);
    const auto same = find(ours, name);
    const std::string_view value = item.substr(std::min(name.size() + 1, item.size()));
    if (same != ours.end() && *same == item) continue;
    if (item.starts_with(kProgramMark)) add("another kbc");
    else if (name == "maze") add(value == "none" ? "no maze" : "another maze");
    else if (name == "rules") add("other rules of the library");
    else if (same != ours.end()) add(fmt::format("{} instead of {}", item, same->substr(name.size() + 1)));
    else add(fmt::format("{}", item));
  }
  for (const std::string_view item : ours) {
    if (find(theirs, name_of(item)) == theirs.end()) add(fmt::format("no {}", item));
  }
  return all.empty() ? "other columns" : all;
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
  return fmt::format("{}{}, seed {}, scenarios {}, labyrinths {}, maze {}, rules {:016x}{}", kProgramMark, program, setup.seed, setup.scenarios, setup.labyrinths,
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
bool Results::take_line(std::string_view line, const Setup& setup) {
  if (line.starts_with(kMindMark)) {
    line.remove_prefix(kMindMark.size());
    const std::size_t blank = line.find(' ');
    return blank != std::string_view::npos && minds_.emplace(line.substr(0, blank), line.substr(blank + 1)).second;
  }
  auto row = parse_row(line, setup);
  if (!row) return false;
  const auto& known = built_in_methods();
  if (!minds_.contains(row->method) && std::none_of(known.begin(), known.end(), [&](const Method& m) { return m.name == row->method; })) return false;
  rows_.insert(std::move(*row));
  return true;
}

/// Takes whole lines only, behind the header.
void Results::read(std::string_view bytes, const Setup& setup) {
  bytes.remove_prefix(header_.size());
  size_ = header_.size();
  auto number = static_cast<std::size_t>(std::count(header_.begin(), header_.end(), '\n'));
  for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
    ++number;
    // A bad line is a page of the file that never reached the disk, or was written by somebody else: all runs after it are done again.
    if (!take_line(bytes.substr(0, end), setup)) {
      bad_line_ = number;
      break;
    }
    size_ += end + 1;
    bytes.remove_prefix(end + 1);
  }
}

/// Takes the bytes of a file, which may be cut off anywhere.
Results::Opened Results::take(std::string_view bytes, const std::string& fingerprint, const Setup& setup, const Minds& minds) {
  setup_ = setup;
  header_ = fmt::format("{}\n{}\n", fingerprint, row_header(setup.set));
  if (bytes.starts_with(header_)) {
    read(bytes, setup);
  } else if (!header_.starts_with(bytes)) {
    const std::string_view there = bytes.substr(0, bytes.find('\n'));
    const bool fleet = there.starts_with("# kbc fleet");
    if (there.starts_with(kProgramMark) && !fleet) {
      error_ = difference(there, fingerprint);
      return Opened::kOther;
    }
    error_ = fleet ? "a batch of `kbc fleet`" : "a `runs.csv` that no `kbc experiment` has written";
    return Opened::kNotOurs;
  }
  for (const auto& [name, mind] : minds) {
    if (const auto known = minds_.find(name); known == minds_.end() || known->second == mind) continue;
    error_ = name;
    return Opened::kOtherMind;
  }
  return Opened::kOpen;
}

Results::Opened Results::look(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  std::string bytes;
  const bool good = file >= 0 && read_all(file, bytes);
  if (!good) error_ = source::reason(errno);
  if (file >= 0) ::close(file);
  return good ? take(bytes, fingerprint, setup, minds) : Opened::kFailed;
}

Results::Opened Results::open(const std::string& path, const std::string& fingerprint, const Setup& setup, const Minds& minds) {
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
  if (const Opened opened = take(bytes, fingerprint, setup, minds); opened != Opened::kOpen) return opened;
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
  const std::string line = experiment::print(row, setup_.set);
  if (!append(line + "\n")) return false;
  // The row is kept rounded, as it will be read again; otherwise an interrupted experiment would end with another table.
  rows_.insert(parse_row(line, setup_).value_or(row));
  return true;
}

std::string Results::print() const {
  std::string out = header_;
  for (const auto& [name, mind] : minds_) out += fmt::format("{}{} {}\n", kMindMark, name, mind);
  for (const Row& row : rows_) out += experiment::print(row, setup_.set) + "\n";
  return out;
}

}  // namespace kb::sim::experiment
