// Knowledge bases compiled in memory over the real standard library, for benchmarks.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"

namespace bench {

/// Ends the program if it does not compile.
inline std::unique_ptr<kb::driver::Compilation> compile(std::string_view path, const kb::source::FileSystem& files, const kb::driver::Options& options) {
  auto compilation = kb::driver::compile(path, files, options, kb::diagnostics::CountingConsumer::make, nullptr);
  if (!compilation->ok()) std::abort();
  return compilation;
}
inline std::unique_ptr<kb::driver::Compilation> compile_text(const std::string& text, const kb::driver::Options& options) {
  const kb::source::RealFileSystem real;
  return compile("text.kb", kb::source::OneFileMore("text.kb", text, real), options);
}

}  // namespace bench
