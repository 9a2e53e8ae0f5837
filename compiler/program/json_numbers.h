// Inside of the JSON form of a program: how numbers become words, and words numbers.
#pragma once

#include <string>

#include "compiler/program/program.h"

namespace kb::program {

/// Appends the keys `sensors`, `percepts` and `fuzzy`, each only where there is something to say; one item a line.
void append_perception_json(std::string& out, const Program& program);
void append_fuzzy_json(std::string& out, const Program& program);

}  // namespace kb::program
