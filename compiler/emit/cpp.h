// Inside the C++ emitter: one function for each part of the output.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/emit/emit.h"
#include "compiler/emit/names.h"
#include "compiler/tables/planes.h"

namespace kb::emit {

struct CppInput {
  const program::Program& program;
  const tables::Tables& tables;
  const CppOptions& options;
  Names names;
  TypeNames types;
  tables::PlaneForm planes;   ///< none in compact form
};

/// A float literal that reads back as the same float: "0.75f".
[[nodiscard]] std::string float_literal(float value);
/// The same, or `mts::kInfinity`.
[[nodiscard]] std::string float_constant(float value);
/// The row of a membership function, in braces.
[[nodiscard]] std::string membership_row(const mts::Membership& m);

/// Whether there is more than the C++ may have, so that the rest of it need not be made.
[[nodiscard]] inline bool is_full(const std::string& out) { return out.size() > kMaxCppBytes; }

/// An array of `row(i)`, one a line; nothing at all if it is empty (pointers to it are then emitted as nullptr).
template <class F>
void emit_array(std::string& out, std::string_view type, std::string_view name, std::size_t count, F&& row) {
  if (count == 0) return;
  fmt::format_to(std::back_inserter(out), "constexpr {} {}[] = {{\n", type, name);
  for (std::size_t i = 0; i < count && !is_full(out); ++i) out += "    " + row(i) + "\n";
  out += "};\n\n";
}
/// An array of numbers, several on a line: offsets and the like, whose rows have no names.
template <class T>
void emit_numbers(std::string& out, std::string_view type, std::string_view name, const std::vector<T>& values) {
  if (values.empty()) return;
  fmt::format_to(std::back_inserter(out), "constexpr {} {}[] = {{\n", type, name);
  for (std::size_t i = 0; i < values.size() && !is_full(out); i += 16) {
    out += "   ";
    for (std::size_t k = i; k < values.size() && k < i + 16; ++k) fmt::format_to(std::back_inserter(out), " {},", values[k]);
    out += '\n';
  }
  out += "};\n\n";
}

void emit_facts(const CppInput& in, std::string& out);
void emit_controllers(const CppInput& in, std::string& out);
/// The control lines as data (runtime/control_line.h); nothing if there are none.
void emit_control_lines(const CppInput& in, std::string& out);
void emit_limits(const CppInput& in, std::string& out);
/// The class of each fuzzy controller, and what it computes: the tables and, where it is faster, straight C++.
void emit_fuzzy(const CppInput& in, std::string& out);
void emit_fuzzy_code(const CppInput& in, std::string& out);
void emit_tables(const CppInput& in, std::string& out);
/// Whether some fact is perceived; if none is, the two functions below emit nothing.
[[nodiscard]] bool has_perception(const CppInput& in);
void emit_readings(const CppInput& in, std::string& out);
void emit_perception(const CppInput& in, std::string& out);
void emit_texts(const CppInput& in, std::string& out);

}  // namespace kb::emit
