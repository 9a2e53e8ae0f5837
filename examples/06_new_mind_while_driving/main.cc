// A robot that is given another mind while it drives: a route is added to what it knows, between two ticks.
//
//   example_new_mind [TICK]     the tick after which the new image comes; 60 by default
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <waymark/runtime/image_mind.h>

namespace {

/// A file as it lies on disk; no copy of it is made.
class MappedFile {
 public:
  explicit MappedFile(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat about {};
    if (file < 0 || ::fstat(file, &about) != 0) throw std::runtime_error("cannot read " + path);
    size_ = static_cast<std::size_t>(about.st_size);
    bytes_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    ::close(file);
    if (bytes_ == MAP_FAILED) throw std::runtime_error("cannot map " + path);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile() { ::munmap(bytes_, size_); }
  [[nodiscard]] const void* bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  void* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// The recorded drive: the names of facts, and a row for each tick, 200 ms apart.
struct Drive {
  std::vector<std::string> names;
  std::vector<std::vector<float>> rows;
};

Drive read_drive(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Drive drive;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',') fields.emplace_back();
      else fields.back() += c;
    }
    if (drive.names.empty()) {
      drive.names = fields;
      continue;
    }
    drive.rows.emplace_back();
    for (const std::string& field : fields) drive.rows.back().push_back(field.empty() ? 0.0f : std::stof(field));
  }
  return drive;
}

/// A mind and its memory: one block to run in, and one for the mind that is to take over.
class Robot {
 public:
  Robot(const MappedFile& image, const Drive& drive) : drive_(drive) {
    if (offer("the first image", image.bytes(), image.size()) != mts::ImageStatus::kOk) throw std::runtime_error("no mind");
  }

  /// Between two ticks. If the image is refused, the robot drives on as if nothing had been offered.
  mts::ImageStatus offer(const char* what, const void* bytes, std::size_t size) {
    std::byte* free_block = mind_.block() == memory_[0] ? memory_[1] : memory_[0];
    mts::SwapReport report;
    const auto lost = [](const mts::SwapLoss& loss) { std::printf("  lost: %s %s\n", mts::text(loss.what), loss.name); };
    const mts::ImageStatus status = mind_.take(bytes, size, free_block, sizeof memory_[0], report, lost);
    std::printf("%s: %s\n", what, status == mts::ImageStatus::kOk ? "taken" : mts::text(status));
    if (status != mts::ImageStatus::kOk) return status;
    std::printf("  satellites: %u carried, %u new; rules: %u carried, %u new\n", report.satellites.carried, report.satellites.fresh,
                report.rules.carried, report.rules.fresh);
    columns_.clear();
    for (const std::string& name : drive_.names) columns_.push_back(mind_.find(mts::ImageKind::kFact, name.c_str()));
    return status;
  }

  /// One tick of the recorded drive. Says when another controller takes the wheel.
  void tick(std::size_t row) {
    for (std::size_t i = 0; i < columns_.size(); ++i) mind_.set_fact(columns_[i], drive_.rows[row][i]);
    mind_.tick(mts::milliseconds(200));
    const std::string now = mind_.drives() ? mind_.strategy_name() : "stands";
    if (now != running_) std::printf("tick %3zu  %s\n", row + 1, now.c_str());
    running_ = now;
  }

 private:
  const Drive& drive_;
  alignas(8) std::byte memory_[2][64 * 1024];
  mts::ImageMind mind_;
  std::vector<std::uint32_t> columns_;   // the fact of each column; one that the mind does not know is passed over
  std::string running_;
};

}  // namespace

int main(int argc, char** argv) try {
  const std::size_t news = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 60;
  const Drive drive = read_drive(EXAMPLE_FOLDER "/drive.facts.csv");
  const MappedFile before(BEFORE), after(AFTER);
  Robot robot(before, drive);
  for (std::size_t row = 0; row < drive.rows.size(); ++row) {
    robot.tick(row);
    if (row + 1 != news) continue;
    robot.offer("half of the new image", after.bytes(), after.size() / 2);   // the connection was lost; it drives on
    robot.offer("the new image", after.bytes(), after.size());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_new_mind: %s\n", error.what());
  return 1;
}
