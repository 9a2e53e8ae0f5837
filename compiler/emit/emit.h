// Tables -> C++: printing only; all decisions are made in compiler/tables.
#pragma once

#include <cstddef>
#include <string>

#include "compiler/model/model.h"
#include "compiler/program/program.h"
#include "compiler/tables/tables.h"

namespace kb::emit {

struct CppOptions {
  std::string name_space;    ///< encloses everything emitted: a C++ identifier, or several joined by `::`
  std::string header_name;   ///< as the source includes it: "route1.kb.h"
  bool compact = false;      ///< emit a mts::CompactMind; tables::against_compact must be empty
};

/// The most bytes of a header or a source. Compilers take many times the memory of their source, and kbc itself some five times.
inline constexpr std::size_t kMaxCppBytes = std::size_t{128} << 20;

/// Two files. The header declares the typed interface (facts, enumerations, Mind, controllers), the source holds the
/// tables and the engine made for them. Same program, same bytes.
struct Cpp {
  std::string header;
  std::string source;
};

/// With more facts than this the header has no named slots (`facts.Line`); `facts.set(Fact::Line, v)` remains.
inline constexpr std::uint32_t kMaxNamedFacts = 1'000;

/// The kernel of a fleet (fleet/kernel.h), emitted beside the files of `cpp` for the same program. `options.header_name` names
/// the fleet's header, `plain_header` the header that it includes, `source_name` the source. Same program, same bytes.
/// tables::against_fleet must be empty.
struct FleetFiles {
  std::string plain_header, source_name;
};
[[nodiscard]] Cpp cpp_fleet(const program::Program& program, const tables::Tables& tables, const CppOptions& options,
                            const FleetFiles& files);

/// The header of the roads that legs lead along, and of the road of the present leg (controllers/road_map.h). It includes
/// `options.header_name`. Empty if no leg leads along a road, or a map does not say where its roads lie. Same program, same bytes.
[[nodiscard]] std::string cpp_map(const model::Model& model, const program::Program& program, const tables::Tables& tables, const CppOptions& options);

/// Both are empty if one would be larger than kMaxCppBytes; that takes no longer than to write that much.
[[nodiscard]] Cpp cpp(const program::Program& program, const tables::Tables& tables, const CppOptions& options);

}  // namespace kb::emit
