#include "tools/kbc/named_files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "tools/kbc/command_line.h"
#include "tools/kbc/trace/output_file.h"

namespace kb::cli {
namespace {

struct Named {
  const CLI::Option* option = nullptr;   // null: the command makes the name
  std::string file, path;
};

bool names_files(const CLI::Option& option) {
  const std::string name = option.get_name(true);
  return option.get_positional() ? name == "FILE" || name == "NEW" || name == "DIR" : option.get_type_name() == "FILE";
}

bool may_share(const Named& a, const Named& b) {
  return a.option == b.option || (a.option != nullptr && b.option != nullptr && a.option->get_positional() && b.option->get_positional());
}

std::string complain(const Named& first, const Named& second) {
  const std::string by = option_names(*first.option);
  if (second.option == nullptr) return "`" + first.path + "` is named by " + by + ", and the command writes `" + second.path + "` itself; name two files";
  return "`" + second.path + "` is named twice, by " + by + " and by " + option_names(*second.option) + "; name two files";
}

}  // namespace

bool is_standard_output(std::string_view path) { return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1"; }

std::optional<std::string> file_named(const std::string& path) {
  std::error_code error;
  if (path == "-" || (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))) return std::nullopt;
  // Twice, because `new/../link` becomes `link` only the first time.
  return std::filesystem::weakly_canonical(std::filesystem::weakly_canonical(std::filesystem::absolute(trace::led_to(path), error), error), error).string();
}

std::string named_twice(const CLI::App& command, const std::vector<std::string>& derived) {
  std::vector<Named> all;
  const auto add = [&all](const CLI::Option* option, const std::string& path) {
    if (auto file = file_named(path)) all.push_back({option, std::move(*file), path});
  };
  for (const CLI::Option* option : command.get_options()) {
    if (!names_files(*option)) continue;
    for (const std::string& path : option->results()) add(option, path);
  }
  for (const std::string& path : derived) add(nullptr, path);
  for (std::size_t second = 1; second < all.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      if (all[first].file == all[second].file && !may_share(all[first], all[second])) return complain(all[first], all[second]);
    }
  }
  return {};
}

namespace {

/// Whether a list of values has an empty one, as in `A,` or `A,,B`. Looked for among the words of the command line, for the parser drops it.
bool has_empty_item(const CLI::Option& list, std::span<char* const> words) {
  const std::string around(1, list.get_delimiter());
  const auto open = [&](std::string_view values) {
    const std::string all = around + std::string(values) + around;
    return values.find(around) != std::string_view::npos && all.find(around + around) != std::string::npos;
  };
  for (const std::string& name : list.get_lnames()) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::string_view word = words[i];
      if (word == "--" + name && i + 1 < words.size() && open(words[i + 1])) return true;
      if (word.starts_with("--" + name + "=") && open(word.substr(name.size() + 3))) return true;
    }
  }
  return false;
}

}  // namespace

std::string left_empty(const CLI::App& command, std::span<char* const> words) {
  const auto stands_open = [&words](const std::string& name) { return std::any_of(words.begin(), words.end(), [&](const char* word) { return word == name + "="; }); };
  for (const CLI::Option* option : command.get_options()) {
    const auto& values = option->results();
    const auto& names = option->get_lnames();
    const bool open = std::any_of(names.begin(), names.end(), [&](const std::string& name) { return stands_open("--" + name); });
    if (option->get_delimiter() != '\0' && has_empty_item(*option, words)) return "an item of " + option_names(*option) + " is empty; a variable of the shell that is not set, perhaps";
    if (open || std::find(values.begin(), values.end(), "") != values.end()) return option_names(*option) + " is empty; a variable of the shell that is not set, perhaps";
  }
  return {};
}

}  // namespace kb::cli
