#include "tools/kbc/lsp/wire.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "compiler/source/reason.h"
#include "compiler/source/source.h"

namespace kb::lsp {
namespace {

constexpr std::size_t kLongestHeader = 4'096;
/// The longest file, each byte of which may be escaped as six.
constexpr std::size_t kLongestMessage = 6 * source::kMaxFileBytes;
constexpr std::string_view kLength = "content-length:";

/// The length that a line of the header gives, if it does.
std::optional<std::size_t> length_in(const std::string& line) {
  const std::string text = source::lower(line);
  if (!text.starts_with(kLength)) return std::nullopt;
  const std::size_t at = text.find_first_not_of(" \t", kLength.size());
  std::size_t bytes = 0;
  if (at == std::string::npos) return std::nullopt;
  return source::read_number(std::string_view(text).substr(at), bytes) ? std::optional(bytes) : std::nullopt;
}

}  // namespace

bool Wire::more() {
  char chunk[1 << 16];
  ssize_t got = 0;
  do got = ::read(in_, chunk, sizeof chunk);
  while (got < 0 && errno == EINTR);
  if (got < 0) error_ = source::reason(errno);
  if (got <= 0) return false;
  come_.append(chunk, static_cast<std::size_t>(got));
  return true;
}

bool Wire::waiting() const {
  pollfd file{in_, POLLIN, 0};
  return !come_.empty() || ::poll(&file, 1, 0) > 0;
}

std::optional<std::string> Wire::take(std::size_t bytes) {
  while (come_.size() < bytes) {
    if (!more()) return std::nullopt;
  }
  std::string out = come_.substr(0, bytes);
  come_.erase(0, bytes);
  return out;
}

std::optional<std::string> Wire::line() {
  std::size_t end = come_.find("\r\n");
  for (; end == std::string::npos; end = come_.find("\r\n")) {
    if (come_.size() > kLongestHeader) error_ = "a header without an end";
    if (!error_.empty() || !more()) return std::nullopt;
  }
  std::string out = come_.substr(0, end);
  come_.erase(0, end + 2);
  return out;
}

std::optional<std::string> Wire::read() {
  std::optional<std::size_t> bytes;
  for (auto header = line(); header; header = line()) {
    if (!header->empty()) {
      if (const auto length = length_in(*header)) bytes = length;
      continue;
    }
    if (bytes && *bytes <= kLongestMessage) return take(*bytes);
    error_ = bytes ? "a message that is too long" : "a message without `Content-Length`";
    return std::nullopt;
  }
  return std::nullopt;
}

void Wire::write(const Json& message) {
  const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::fprintf(out_, "Content-Length: %zu\r\n\r\n", text.size());
  std::fwrite(text.data(), 1, text.size(), out_);
  std::fflush(out_);
}

}  // namespace kb::lsp
