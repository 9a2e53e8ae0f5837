#include "tools/kbc/layout_file.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "compiler/model/known_names.h"
#include "compiler/syntax/syntax.h"

namespace kb::cli {
namespace {

constexpr LayoutFormat kFormats[] = {{"lif", layout::read_lif}, {"nav2", layout::read_nav2}, {"opentcs", layout::read_opentcs}};

/// The names that landmarks must not have: those of the standard library and of a mission. Views into `library`.
std::unordered_set<std::string_view> taken_names(const driver::Compilation& library) {
  std::unordered_set<std::string_view> taken(syntax::words().begin(), syntax::words().end());
  taken.insert({"Start", "Mission"});
  for (const model::KnownName& known : model::known_names(library.model)) {
    taken.insert(known.name);
    if (known.members != nullptr) taken.insert(known.members->members.begin(), known.members->members.end());
  }
  return taken;
}

}  // namespace

std::span<const LayoutFormat> layout_formats() { return kFormats; }

const LayoutFormat* layout_format(std::string_view name) {
  const auto found = std::find_if(std::begin(kFormats), std::end(kFormats), [&](const LayoutFormat& format) { return format.name == name; });
  return found == std::end(kFormats) ? nullptr : found;
}

std::optional<layout::Map> read_layout(const LayoutImport& how, source::Sources& sources, source::FileId file,
                                       layout::Adaptations& adaptations, diagnostics::Diagnostics& diagnostics, Session& session) {
  auto layout = layout_format(how.format)->read(sources, file, how.choice, adaptations, diagnostics);
  if (!layout) return std::nullopt;
  if (layout->places.empty()) {
    diagnostics.report(diagnostics::Kind::kLayoutEmpty, {file, 0, 0});
    return std::nullopt;
  }
  layout::warn_of_units(*layout, diagnostics);   // before places that are near one another become one
  layout = layout::joined(std::move(*layout), adaptations, diagnostics);
  if (!layout) return std::nullopt;
  auto roads = layout::roads_of(*layout, adaptations, diagnostics);
  if (!roads) return std::nullopt;
  const auto library = session.compile_text("layout.kb", "import std.navigation\nimport std.compass8\n");
  if (!library->ok()) return std::nullopt;
  const auto taken = taken_names(*library);
  if (taken.contains(how.wording.map)) diagnostics.report(diagnostics::Kind::kLayoutMapName, {}, {how.wording.map});
  layout::Wording wording = how.wording;
  wording.taken = [&](std::string_view name) {
    return taken.contains(name) || name == how.wording.map || (how.wording.taken && how.wording.taken(name));
  };
  auto names = layout::landmark_names(*layout, wording);
  return layout::Map{std::move(*layout), std::move(*roads), std::move(names)};
}

std::string name_fault(const std::string& text) {
  return syntax::is_name(text) ? "" : "`" + text + "` is no name: letters, digits and `_`, no digit first, and no word of the language";
}

}  // namespace kb::cli
