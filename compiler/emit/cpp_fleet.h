// Inside of the emitter of fleets: one function a part of the output.
#pragma once

#include <string>

#include "compiler/emit/emit.h"
#include "compiler/emit/names.h"
#include "compiler/tables/fleet.h"

namespace kb::emit {

struct FleetInput {
  const program::Program& program;
  const tables::Tables& tables;
  const CppOptions& options;
  tables::FleetForm form;
  FleetNames names;
};

/// The tick of a word of robots, as straight code.
void emit_fleet_kernel(const FleetInput& in, std::string& out);

}  // namespace kb::emit
