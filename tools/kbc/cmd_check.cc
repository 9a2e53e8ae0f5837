// kbc check: what is wrong with knowledge bases.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "sim/mind/control_words.h"
#include "tools/kbc/support.h"

namespace kb::cli {

Run setup_check(CLI::App& app) {
  auto files = std::make_shared<std::vector<std::string>>();
  app.add_option("FILE", *files, "The knowledge bases, each for itself")->required();
  return [files](Session& session) {
    for (const std::string& file : *files) {
      const auto compiled = session.compile(file, driver::Stage::kAnalysis, true);
      if (!compiled->ok()) continue;
      auto messages = session.diagnostics(compiled->sources);
      sim::check_controls(compiled->program, messages);
    }
    return session.exit_code();
  };
}

}  // namespace kb::cli
