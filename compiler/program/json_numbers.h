// Parts of the JSON form of a program: sensors, percepts and fuzzy controllers. Private to this folder.
#pragma once

#include <string>

#include "compiler/program/program.h"

namespace kb::program {

/// Appends the keys `sensors`, `percepts` and `fuzzy`, each only if it is not empty; one item a line.
void append_perception_json(std::string& out, const Program& program);
void append_fuzzy_json(std::string& out, const Program& program);

}  // namespace kb::program
