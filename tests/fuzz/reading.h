// What the fuzz targets read with, and what they demand of a text that was made of their input.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"

namespace kb {

struct Reading {
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages{sources, consumer};
};

/// A knowledge base that kbc writes has to be one.
inline void require_parse(Reading& in, const std::string& text) {
  const std::size_t before = in.messages.errors();
  static_cast<void>(syntax::parse(in.sources, in.sources.add("made.kb", text), in.messages));
  if (in.messages.errors() == before) return;
  std::fprintf(stderr, "does not parse:\n%s\n", text.c_str());
  std::abort();
}

}  // namespace kb
