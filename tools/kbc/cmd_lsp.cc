// kbc lsp: a server for editors.
#include <CLI/CLI.hpp>
#include <unistd.h>

#include "tools/kbc/lsp/server.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

int serve(Session& session) {
  const source::Sources none;
  lsp::Wire wire(STDIN_FILENO, stdout);
  lsp::Server server(wire, lsp::Workspace(session.library(), session.diagnostics(none).options()), KB_VERSION);
  if (server.run()) return kClean;
  if (!wire.error().empty()) session.report(diagnostics::Kind::kCannotRead, {"standard input", wire.error()});
  return kErrors;
}

}  // namespace

Run setup_lsp(CLI::App& app) {
  app.add_flag_callback("--stdio", [] {}, "What some editors add: there is no other way")->group("");
  return [](Session& session) { return serve(session); };
}

}  // namespace kb::cli
