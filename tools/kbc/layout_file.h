// Files of layouts on the command line: what `kbc import` makes a map of, and whose ids the master of `kbc drive` speaks in.
//
// note [names of an import]
// Which landmark a node is hangs on what the file was imported with: the layout, the type of vehicle, the prefix, and on the names of the standard
// library. So both commands have them from here, and the one finds in a knowledge base what the other has written.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tools/kbc/layout/layout.h"
#include "tools/kbc/support.h"

namespace kb::cli {

struct LayoutFormat {
  std::string_view name;   ///< `lif`
  layout::Reader read;
};
[[nodiscard]] std::span<const LayoutFormat> layout_formats();
/// Null if there is none of that name.
[[nodiscard]] const LayoutFormat* layout_format(std::string_view name);

/// What an import is told of a layout.
struct LayoutImport {
  std::string format;        ///< the name of one
  layout::Choice choice;
  layout::Wording wording;   ///< of it `map`, `prefix` and `taken` make the names; those of the library are taken besides
};
/// The layout in `file` with its roads and the names of its landmarks. Nothing if it cannot be read (reported). That the name of the map is one of the
/// library is reported as well. `adaptations` are noted only. As long as reading the file, and compiling the library's rules of the road.
[[nodiscard]] std::optional<layout::Map> read_layout(const LayoutImport& how, source::Sources& sources, source::FileId file,
                                                     layout::Adaptations& adaptations, diagnostics::Diagnostics& diagnostics, Session& session);

/// For CLI11: empty if `text` is a name of the language, else why not.
[[nodiscard]] std::string name_fault(const std::string& text);

}  // namespace kb::cli
