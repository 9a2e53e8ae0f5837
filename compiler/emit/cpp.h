// Inside of the C++ emitter: one function a part of the output.
#pragma once

#include <iterator>
#include <string>
#include <vector>

#include "compiler/emit/emit.h"
#include "compiler/emit/names.h"

namespace kb::emit {

struct CppInput {
  const program::Program& program;
  const tables::Tables& tables;
  const CppOptions& options;
  Names names;
};

/// "std::uint16_t" or "std::uint32_t".
[[nodiscard]] const char* index_type(const CppInput& in);
/// A float literal that reads back as the same float: "0.75f".
[[nodiscard]] std::string float_literal(float value);

void emit_enumerations(const CppInput& in, std::string& out);
void emit_facts(const CppInput& in, std::string& out);
void emit_knowledge(const CppInput& in, std::string& out);
void emit_controllers(const CppInput& in, std::string& out);
/// The class of each fuzzy controller, and what it computes: the tables and, where it is faster, straight C++.
void emit_fuzzy(const CppInput& in, std::string& out);
void emit_fuzzy_code(const CppInput& in, std::string& out);
void emit_tables(const CppInput& in, std::string& out);
/// Whether some fact is perceived; then the two below have something to say.
[[nodiscard]] bool has_perception(const CppInput& in);
void emit_readings(const CppInput& in, std::string& out);
void emit_perception(const CppInput& in, std::string& out);
void emit_texts(const CppInput& in, std::string& out);

}  // namespace kb::emit
