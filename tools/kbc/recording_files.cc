#include "tools/kbc/recording_files.h"

#include <algorithm>

namespace kb::cli {

source::FileSystem::Result RecordingFiles::read(std::string_view path) const {
  Result result = files_.read(path);
  const bool known = std::find(read_.begin(), read_.end(), path) != read_.end();
  if (result.bytes && !known) read_.emplace_back(path);
  return result;
}

}  // namespace kb::cli
