// Files of layouts on the command line: `kbc import` makes a map of one, and the master of `kbc drive` uses its ids.
//
// note [names of an import]
// The landmark of a node depends on how the file was imported (the layout, the type of vehicle, the prefix) and on the names of the
// standard library. Both commands take them from here, so that one finds in a knowledge base what the other has written.
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

/// How to import a layout.
struct LayoutImport {
  std::string format;        ///< the name of one
  layout::Choice choice;
  layout::Wording wording;   ///< its `map`, `prefix` and `taken` decide the names; names of the library are taken too
};
/// The layout in `file` with its roads and the names of its landmarks. Nothing if it cannot be read (reported). A map name that the
/// library has is reported too. `adaptations` are only noted. Takes as long as reading the file and compiling the library's rules of the
/// road.
[[nodiscard]] std::optional<layout::Map> read_layout(const LayoutImport& how, source::Sources& sources, source::FileId file,
                                                     layout::Adaptations& adaptations, diagnostics::Diagnostics& diagnostics, Session& session);

/// For CLI11: empty if `text` is a name of the language, else why not.
[[nodiscard]] std::string name_fault(const std::string& text);

}  // namespace kb::cli
