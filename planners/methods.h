// Declares the functions that methods.def names.
#pragma once

#include "planners/method.h"

namespace kb::planners {

#define KB_METHOD(function, name, knowledge, touch, moving, random, summary) Result function(const Problem&, const RunOptions&);
#define KB_PICTURE(name, function) Picture function(const Problem&, const Result&);
#include "planners/methods.def"
#undef KB_METHOD
#undef KB_PICTURE

}  // namespace kb::planners
