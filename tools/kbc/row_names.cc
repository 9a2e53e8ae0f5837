#include "tools/kbc/row_names.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"
#include "compiler/source/utf8.h"

namespace kb::cli {
namespace {

bool is_plain(char c) { return source::is_letter_or_digit(c) || c == '_' || c == '-' || c == '.'; }

/// The same for a character of any script; `shown` is one, or a byte that is none.
bool is_plain(std::string_view shown) { return is_plain(shown[0]) || (static_cast<unsigned char>(shown[0]) >= 0x80 && diagnostics::visible(shown) == shown); }

/// Calls `each` for every character, and for every byte that belongs to none.
template <class F>
void for_characters(std::string_view text, F&& each) {
  while (!text.empty()) {
    const std::size_t bytes = std::max<std::size_t>(1, source::code_point(text).bytes);
    each(text.substr(0, bytes));
    text.remove_prefix(bytes);
  }
}

/// What `pandas.read_csv` and R's `read.csv` take for a missing value, of the texts that could be names.
constexpr std::array<std::string_view, 8> kMissing{"NA", "NULL", "NaN", "None", "nan", "null", "-NaN", "-nan"};

}  // namespace

std::pair<std::string, std::string> file_and_name(const std::string& option) {
  const std::size_t equals = option.rfind('=');
  std::error_code ignored;
  if (equals == std::string::npos || std::filesystem::exists(option, ignored)) return {option, {}};
  return {option.substr(0, equals), option.substr(equals + 1)};
}

std::string_view refused_name(std::string_view name) {
  if (name.empty() || plain_name(name) != name) return "letters, digits, `_`, `-` and `.` can";
  if (std::find(kMissing.begin(), kMissing.end(), name) != kMissing.end()) return "readers of tables take it for a value that is missing";
  if (name == "all") return "tables have a row of this name, for all runs together";
  return {};
}

std::string plain_name(std::string_view name) {
  std::string plain;
  for_characters(name, [&](std::string_view character) { plain += is_plain(character) ? character : "_"; });
  return plain;
}

}  // namespace kb::cli
