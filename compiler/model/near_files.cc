#include "compiler/model/near_files.h"

#include <utility>
#include <vector>

#include "compiler/source/encoding.h"

namespace kb::model {
namespace {

constexpr std::string_view kExtension = ".kb";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_-";
constexpr std::size_t kLongestName = 20;  // longer names have too many variants to try

std::vector<std::string> names_near(const std::string& name) {
  std::vector<std::string> out;
  const std::string lower = source::lower(name);
  if (lower != name) out.push_back(lower);
  if (name.size() > kLongestName) return out;
  for (std::size_t i = 0; i + 1 < name.size(); ++i) {
    out.push_back(name);
    std::swap(out.back()[i], out.back()[i + 1]);
  }
  for (std::size_t i = 0; i < name.size() && name.size() > 1; ++i) out.push_back(std::string(name).erase(i, 1));
  for (std::size_t i = 0; i < name.size(); ++i) {
    for (const char c : kLetters) {
      out.push_back(name);
      out.back()[i] = c;
    }
  }
  for (std::size_t i = 0; i <= name.size(); ++i) {
    for (const char c : kLetters) out.push_back(std::string(name).insert(i, 1, c));
  }
  return out;
}

}  // namespace

std::optional<std::string> near_file(std::string_view path, const source::FileSystem& files) {
  const auto there = [&files](const std::string& name) { return files.read(name).bytes.has_value(); };
  if (!path.ends_with(kExtension)) {
    std::string longer = std::string(path) + std::string(kExtension);
    if (there(longer)) return longer;
    return std::nullopt;
  }
  const std::size_t slash = path.rfind('/');
  const std::size_t begin = slash == std::string_view::npos ? 0 : slash + 1;
  const std::string folder(path.substr(0, begin));
  const std::string name(path.substr(begin, path.size() - begin - kExtension.size()));
  for (const std::string& near : names_near(name)) {
    std::string other = folder + near + std::string(kExtension);
    if (near != name && there(other)) return other;
  }
  return std::nullopt;
}

}  // namespace kb::model
