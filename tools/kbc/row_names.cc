#include "tools/kbc/row_names.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "compiler/source/encoding.h"

namespace kb::cli {
namespace {

bool is_plain(char c) { return source::is_letter_or_digit(c) || c == '_' || c == '-' || c == '.'; }

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
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain)) return "letters, digits, `_`, `-` and `.` can";
  if (std::find(kMissing.begin(), kMissing.end(), name) != kMissing.end()) return "readers of tables take it for a value that is missing";
  if (name == "all") return "tables have a row of this name, for all runs together";
  return {};
}

std::string plain_name(std::string name) {
  std::replace_if(name.begin(), name.end(), [](char c) { return !is_plain(c); }, '_');
  return name;
}

}  // namespace kb::cli
