// Tables -> C++: printing only. What is decided is decided in compiler/tables.
#pragma once

#include <string>

#include "compiler/program/program.h"
#include "compiler/tables/tables.h"

namespace kb::emit {

struct CppOptions {
  std::string name_space;    ///< of everything that is emitted; a C++ identifier, or several with `::` between
  std::string header_name;   ///< as the source includes it: "route1.kb.h"
  bool compact = false;      ///< a mts::CompactMind; nothing of tables::against_compact may be so
};

/// Two files. The header declares the typed interface (facts, enumerations, Mind, controllers), the source holds the
/// tables and the engine made for them. Same program, same bytes.
struct Cpp {
  std::string header;
  std::string source;
};

/// Above so many facts the header has no named slots (`facts.Line`); `facts.set(Fact::Line, v)` remains.
inline constexpr std::uint32_t kMaxNamedFacts = 1'000;

/// The kernel of a fleet (fleet/kernel.h), to stand beside the files of `cpp` for the same program: `options.header_name` is
/// that of the fleet's header, `plain_header` and `source_name` what it includes and what the source is called. Same program,
/// same bytes. Nothing of tables::against_fleet may be so.
struct FleetFiles {
  std::string plain_header, source_name;
};
[[nodiscard]] Cpp cpp_fleet(const program::Program& program, const tables::Tables& tables, const CppOptions& options,
                            const FleetFiles& files);

[[nodiscard]] Cpp cpp(const program::Program& program, const tables::Tables& tables, const CppOptions& options);

}  // namespace kb::emit
