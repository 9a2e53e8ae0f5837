#include "tools/kbc/fleet_shards.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "compiler/source/fingerprint.h"
#include "compiler/source/numbers.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/stream.h"

namespace kb::cli {

using diagnostics::Kind;
using sim::batch::Batch;

constexpr std::string_view kClaims = "shards/.claims";

Claims::~Claims() {
  if (file_ >= 0) ::close(file_);
}

bool Claims::take(const std::string& path, std::size_t number) {
  if (file_ < 0) file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = static_cast<off_t>(number);
  byte.l_len = 1;
  // The lock belongs to the open file and not to the process: threads share it, and closing another descriptor does not release it.
  if (file_ >= 0 && ::fcntl(file_, F_OFD_SETLK, &byte) == 0) return true;
  const bool held = file_ >= 0 && (errno == EAGAIN || errno == EACCES);
  locks_ = locks_ && held;
  return !held;
}

/// The contents of a file, and where its rows begin.
struct BatchFiles::Text {
  std::string path, bytes;
  std::size_t rows_at = 0;

  /// False if it cannot be read (reported).
  bool load(Session& session) {
    std::string error;
    auto read = trace::read_all(path, SIZE_MAX, error);
    if (read) bytes = std::move(*read);
    else session.report(Kind::kCannotRead, {path, error});
    return read.has_value();
  }
  /// Reports what is wrong with the line that begins at `at`.
  void complain(Session& session, Kind kind, std::size_t at, std::initializer_list<std::string_view> arguments) const {
    source::Sources sources;
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const auto file = sources.add(path, bytes);
    session.diagnostics(sources).report(kind, {file, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)}, arguments);
  }
};

std::string fingerprint_of(const BatchParts& parts) {
  source::Fingerprint print;
  for (const auto& [name, value] : parts) print.mix(fmt::format("{} {}\n", name, value));
  return fmt::format("{:016x}", print.value());
}

BatchFiles::BatchFiles(std::string folder, const Batch& batch, BatchParts parts)
    : folder_(std::move(folder)), batch_(batch), parts_(std::move(parts)), head_(fmt::format("# kbc fleet, batch {}, {} runs", fingerprint_of(parts_), batch.runs())) {
  for (const auto& [name, value] : parts_) head_ += fmt::format(", {} {}", name, value);
}

std::string BatchFiles::path(std::string_view name) const { return (std::filesystem::path(folder_) / name).string(); }
std::string BatchFiles::shard_path(std::size_t shard) const { return path(fmt::format("shards/{:04}.csv", shard + 1)); }
std::string BatchFiles::shard_head(std::size_t shard) const { return fmt::format("{}, shard {} of {}", head_, shard + 1, batch_.shards()); }

/// Of what results are that do not begin as those of this batch do.
std::string BatchFiles::differs(std::string_view there) const {
  if (!there.starts_with("# kbc fleet, batch ")) return there.starts_with("# kbc ") ? "an experiment; name another folder" : "no batch; name another folder";
  const std::string_view line = there.substr(0, there.find('\n'));
  if (line.ends_with('\r')) return "a batch whose lines end as on Windows (CRLF); copy its files as they are";
  std::string items;
  for (const auto& [name, value] : parts_) {
    const std::size_t at = line.find(", " + name + " ");
    const std::string_view rest = at == std::string_view::npos ? std::string_view() : line.substr(at + name.size() + 3);
    const std::string_view other = rest.substr(0, rest.find(','));
    if (other == value) continue;
    const bool number = name == "seeds" || name == "robots", several = name == "scenarios" || name == "options";
    items += (items.empty() ? "" : ", ") + (number ? fmt::format("{} {} instead of {}", name, other, value) : (several ? "other " : "another ") + name);
  }
  return fmt::format("another batch ({}); name another folder, or remove what is in this one", items.empty() ? "other options" : items);
}

bool BatchFiles::read_head(Text& file, const std::string& head, Session& session) const {
  if (!file.load(session)) return false;
  const std::string begin = fmt::format("{}\n{}\n", head, batch_.header());
  file.rows_at = begin.size();
  if (file.bytes.starts_with(begin)) return true;
  if (begin.starts_with(file.bytes)) file.complain(session, Kind::kFleetDamaged, file.bytes.size(), {"the head of the table"});
  else file.complain(session, Kind::kFleetOther, 0, {differs(file.bytes)});
  return false;
}

// Every row is checked, so that a file that has been shortened does not become a shorter batch.
bool BatchFiles::read(Text& file, const std::string& head, Batch::Block block, std::vector<sim::batch::Run>* runs, Session& session) const {
  if (!read_head(file, head, session)) return false;
  std::size_t at = file.rows_at;
  for (std::size_t number = block.first; number < block.last; ++number) {
    const std::size_t end = file.bytes.find('\n', at);
    auto run = end == std::string::npos ? std::nullopt : batch_.parse(std::string_view(file.bytes).substr(at, end - at), number);
    if (!run) {
      const sim::batch::Run wanted = batch_.run(number);
      const std::string name = fmt::format("the run of `{}`, seed {}, robot {}", batch_.scenarios()[wanted.scenario].name, wanted.seed, wanted.robot);
      file.complain(session, Kind::kFleetDamaged, std::min(at, file.bytes.size()), {name});
      return false;
    }
    if (runs != nullptr) runs->push_back(std::move(*run));
    at = end + 1;
  }
  if (at == file.bytes.size()) return true;
  file.complain(session, Kind::kFleetDamaged, at, {"the end of the file"});
  return false;
}

bool BatchFiles::open(Session& session, const std::vector<std::size_t>& wanted) {
  std::error_code ignored;
  Text whole{path("runs.csv"), {}, 0};
  complete_ = std::filesystem::exists(whole.path, ignored);
  if (complete_) return read(whole, head_, {0, batch_.runs()}, nullptr, session);
  for (const std::size_t shard : wanted) {
    Text file{shard_path(shard), {}, 0};
    if (!std::filesystem::exists(file.path, ignored)) missing_.push_back(shard);
    else if (!read(file, shard_head(shard), batch_.block(shard), nullptr, session)) return false;
    else there_.push_back(shard);
  }
  for (std::size_t shard = 0; shard < batch_.shards(); ++shard) {   // of the others one tells whose they are
    Text file{shard_path(shard), {}, 0};
    if (std::ranges::binary_search(wanted, shard) || !std::filesystem::exists(file.path, ignored)) continue;
    return read_head(file, shard_head(shard), session);
  }
  return true;
}

std::optional<std::vector<sim::batch::Run>> BatchFiles::runs(Session& session) const {
  std::vector<sim::batch::Run> runs;
  const auto take = [&](const std::string& from, const std::string& head, Batch::Block block) {
    Text file{from, {}, 0};
    return read(file, head, block, &runs, session);
  };
  const bool good = complete_ ? take(path("runs.csv"), head_, {0, batch_.runs()})
                              : std::ranges::all_of(there_, [&](std::size_t shard) { return take(shard_path(shard), shard_head(shard), batch_.block(shard)); });
  return good ? std::optional(std::move(runs)) : std::nullopt;
}

std::size_t BatchFiles::done() const {
  std::error_code ignored;
  std::size_t count = 0;
  for (std::size_t shard = 0; shard < batch_.shards(); ++shard) count += complete_ || std::filesystem::exists(shard_path(shard), ignored) ? 1 : 0;
  return count;
}

bool BatchFiles::claim(Session& session) {
  const auto failed = trace::make_folders(path("shards"));
  if (failed) session.report(Kind::kCannotMakeFolder, {path("shards"), *failed});
  std::erase_if(missing_, [&](std::size_t shard) {
    const bool mine = failed || claims_.take(path(kClaims), shard);
    std::error_code ignored;
    if (mine && std::filesystem::exists(shard_path(shard), ignored)) return true;   // whoever had it in hand has just written it
    if (!mine && elsewhere_.empty()) elsewhere_ = shard_path(shard);
    return !mine;
  });
  if (!failed && claims_.locks()) remove_left();
  look_again();
  return !failed;
}

void BatchFiles::look_again() {
  std::error_code ignored;
  if (complete_ || !std::filesystem::exists(path("runs.csv"), ignored)) return;
  complete_ = true;
  missing_.clear();
  elsewhere_.clear();
}

void BatchFiles::remove_left() const {
  std::error_code failed, ignored;
  std::vector<std::filesystem::path> left;
  for (std::filesystem::directory_iterator entry(path("shards"), failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::size_t number = 0;
    if (!source::read_number(std::string_view(name).substr(0, name.find('.')), number) || !std::ranges::binary_search(missing_, number - 1)) continue;
    const std::string shard = std::filesystem::path(shard_path(number - 1)).filename().string();
    if (trace::is_left_of(shard, name) && entry->is_regular_file(ignored)) left.push_back(entry->path());
  }
  for (const auto& file : left) std::filesystem::remove(file, ignored);
}

bool BatchFiles::refuse(const std::string& path, Session& session) {
  session.report(Kind::kCannotWrite, {path, "another `kbc fleet` has it in hand; the same command goes on when that has ended"});
  return false;
}

std::string BatchFiles::write(std::size_t shard, const std::string& rows) const {
  trace::OutputFile file;
  if (!file.open(shard_path(shard))) return file.error();
  file.write(fmt::format("{}\n{}\n", shard_head(shard), batch_.header()));
  file.write(rows);
  return file.commit() ? std::string() : file.error();
}

std::optional<BatchFiles::Merged> BatchFiles::merge(Session& session) {
  if (!complete_ && !claims_.take(path(kClaims), batch_.shards()) && !refuse(path("runs.csv"), session)) return std::nullopt;
  look_again();
  std::vector<sim::batch::Run> runs;
  runs.reserve(batch_.runs());
  std::string rows;
  const auto gather = [&](const std::string& from, const std::string& head, Batch::Block block) {
    Text file{from, {}, 0};
    if (!read(file, head, block, &runs, session)) return false;
    rows.append(file.bytes, file.rows_at);
    return true;
  };
  if (complete_) {
    if (!gather(path("runs.csv"), head_, {0, batch_.runs()})) return std::nullopt;
  }
  for (std::size_t shard = 0; !complete_ && shard < batch_.shards(); ++shard) {
    if (!gather(shard_path(shard), shard_head(shard), batch_.block(shard))) return std::nullopt;
  }
  std::string summary = sim::batch::summarise(batch_, runs), ignored_error;
  std::vector<Session::OutputFile> files;   // those that are not there yet: results that are complete may lie where nothing can be written
  if (!complete_) files.push_back({path("runs.csv"), fmt::format("{}\n{}\n{}", head_, batch_.header(), rows)});
  if (!complete_ || trace::read_all(path("summary.md"), summary.size(), ignored_error) != summary) files.push_back({path("summary.md"), summary});
  if (!session.write_files(files)) return std::nullopt;
  std::error_code ignored;
  for (std::size_t shard = 0; shard < batch_.shards(); ++shard) std::filesystem::remove(shard_path(shard), ignored);
  std::filesystem::remove(path(kClaims), ignored);
  std::filesystem::remove(path("shards"), ignored);   // the folder stays if it contains something else
  return Merged{std::move(summary), std::move(runs)};
}

}  // namespace kb::cli
