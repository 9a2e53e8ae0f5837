// A language server: one editor, one process.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/wire.h"
#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

class Server {
 public:
  /// `wire` must outlive it. `version`: of kbc.
  Server(Wire& wire, Workspace workspace, std::string version) : wire_(wire), workspace_(std::move(workspace)), version_(std::move(version)) {}

  /// Serves until the editor sends `exit` or the stream ends. Returns whether the editor ended the session properly.
  [[nodiscard]] bool run();

 private:
  /// A message that changes the session or the texts.
  struct Event {
    std::string_view name;
    Json (Server::*handler)(const Json& params);
  };
  static const Event kEvents[];

  /// Waits for a message, then takes all that have arrived. False if the stream has ended.
  [[nodiscard]] bool listen();
  void take(const Json& message);
  void answer(const Json& id, std::string_view method, const Json& params);
  void fail(const Json& id, int code, std::string_view what);
  [[nodiscard]] Json result(std::string_view method, const Json& params);
  void publish();
  [[nodiscard]] std::string path_in(const Json& params) const;
  [[nodiscard]] std::string open_path_in(const Json& params) const;
  [[nodiscard]] OpenFile file_in(const Json& params) const;

  /// Remembers the version that the editor gave the text of a file.
  void number(const std::string& path, const Json& params);

  void add_folders(const Json& params);

  Json initialize(const Json& params);
  Json begun(const Json& params);
  Json shut_down(const Json& params);
  Json exit(const Json& params);
  Json opened(const Json& params);
  Json changed(const Json& params);
  Json saved(const Json& params);
  Json closed(const Json& params);
  Json moved(const Json& params);

  Wire& wire_;
  Workspace workspace_;
  std::string version_;
  Encoding encoding_ = Encoding::kUtf16;
  bool begun_ = false, watches_ = false, versioned_ = false, shut_down_ = false, left_ = false;
  std::map<std::string, Json> told_;   // by URI: the messages that the editor has, as they were sent
  std::deque<Json> come_;              // messages not handled yet
  std::set<Json> cancelled_;           // ids of requests among these
};

}  // namespace kb::lsp
