// The tables as the engine reads them.
#include <waymark/runtime/image_layout.h>
#include "compiler/tables/form.h"

namespace kb::tables {

mts::Tables<I> view(const Tables& t) {
  mts::Tables<I> v;
  v.shape = t.shape;
  v.firing = t.firing;
  v.idle = t.idle;
  v.idle_strategy = t.idle_strategy;
  v.hold_limit_us = t.hold_limit_us;
#define KB_ARRAY(name, type, length) v.name = t.name.empty() ? nullptr : t.name.data();
  MTS_IMAGE_TABLES(KB_ARRAY)
#undef KB_ARRAY
  return v;
}

}  // namespace kb::tables
