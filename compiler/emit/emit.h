// Tables -> C++: printing only; all decisions are made in compiler/tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/model/model.h"
#include "compiler/program/program.h"
#include "compiler/tables/fleet.h"
#include "compiler/tables/tables.h"

namespace kb::emit {

struct CppOptions {
  std::string name_space;    ///< encloses everything emitted: a C++ identifier, or several joined by `::`
  std::string header_name;   ///< as the source includes it: "route1.kb.h"
  bool compact = false;      ///< emit a mts::CompactMind; tables::against_compact must be empty
  std::uint64_t map_print = 0;   ///< of a mind that is made together with its map: see `print_of_map`
};

/// The most bytes of a header or a source. Compilers take many times the memory of their source, and kbc itself some five times.
inline constexpr std::size_t kMaxCppBytes = std::size_t{128} << 20;

/// Two files. The header declares the typed interface (facts, enumerations, Mind, controllers), the source holds the
/// tables and the engine made for them. Same program, same bytes.
struct Cpp {
  std::string header;
  std::string source;
  std::uint64_t print = 0;   ///< of a mind: the fingerprint of its code. Its fleet and its map need it
};

/// With more facts than this the header has no named slots (`facts.Line`); `facts.set(Fact::Line, v)` remains.
inline constexpr std::uint32_t kMaxNamedFacts = 1'000;

/// The kernel of a fleet (fleet/kernel.h), emitted beside the files of `cpp` for the same program. `options.header_name` names
/// the fleet's header, `plain_header` the header that it includes, `source_name` the source. Same program, same bytes.
/// tables::against_fleet must be empty.
struct FleetFiles {
  std::string plain_header, source_name;
  std::uint64_t mind_print = 0;   ///< Cpp::print of the mind
};
[[nodiscard]] Cpp cpp_fleet(const program::Program& program, const tables::Tables& tables, const CppOptions& options,
                            const FleetFiles& files, const tables::FleetRest& rest = {});

/// What stands in the header of the roads that legs lead along, and of the road of the present leg (controllers/road_map.h). Empty if no
/// leg leads along a road, or a map does not say where its roads lie. Same program, same bytes.
[[nodiscard]] std::string map_body(const model::Model& model, const program::Program& program, const tables::Tables& tables);
/// Its fingerprint; never 0.
[[nodiscard]] std::uint64_t print_of_map(std::string_view body);
/// The header itself, for a mind that was made with `options.map_print`. It includes `options.header_name`. `mind_print`: Cpp::print of the mind.
[[nodiscard]] std::string cpp_map(std::string_view body, const CppOptions& options, std::uint64_t mind_print);

/// Both are empty if one would be larger than kMaxCppBytes; that takes no longer than to write that much.
[[nodiscard]] Cpp cpp(const program::Program& program, const tables::Tables& tables, const CppOptions& options);

}  // namespace kb::emit
