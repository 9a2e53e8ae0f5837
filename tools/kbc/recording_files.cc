#include "tools/kbc/recording_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "tools/kbc/named_files.h"

namespace kb::cli {

source::FileSystem::Result RecordingFiles::read(std::string_view path) const {
  Result result = files_.read(path);
  if (!result.bytes) return result;
  const std::lock_guard lock(mutex_);
  if (known_.emplace(path).second) read_.emplace_back(path);
  return result;
}

void RecordingFiles::note(std::string_view path) {
  const std::lock_guard lock(mutex_);
  known_.emplace(path);
}

bool RecordingFiles::is_input(std::string_view path) const {
  std::error_code ignored;
  const auto file = file_named(std::string(path));
  if (!file || !std::filesystem::exists(*file, ignored)) return false;
  const std::lock_guard lock(mutex_);
  return std::any_of(known_.begin(), known_.end(), [&](const std::string& known) { return file_named(known) == file; });
}

}  // namespace kb::cli
