// Tables -> C++: printing only. What is decided is decided in compiler/tables.
#pragma once

#include <string>

#include "compiler/program/program.h"
#include "compiler/tables/tables.h"

namespace kb::emit {

struct CppOptions {
  std::string name_space;    ///< of everything that is emitted; must be a C++ identifier
  std::string header_name;   ///< as the source includes it: "route1.kb.h"
};

/// Two files. The header declares the typed interface (facts, enumerations, Mind, controllers), the source holds the
/// tables and the engine made for them. Same program, same bytes.
struct Cpp {
  std::string header;
  std::string source;
};

/// Above so many facts the header has no named slots (`facts.Line`); `facts.set(Fact::Line, v)` remains.
inline constexpr std::uint32_t kMaxNamedFacts = 1'000;

[[nodiscard]] Cpp cpp(const program::Program& program, const tables::Tables& tables, const CppOptions& options);

}  // namespace kb::emit
