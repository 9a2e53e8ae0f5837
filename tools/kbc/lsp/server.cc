#include "tools/kbc/lsp/server.h"

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>

namespace kb::lsp {
namespace {

// Error codes of JSON-RPC and of the protocol.
constexpr int kParseError = -32700, kInvalidRequest = -32600, kMethodNotFound = -32601, kInvalidParams = -32602, kInternalError = -32603,
              kNotInitialized = -32002, kRequestFailed = -32803;
constexpr int kWholeText = 1, kLogError = 1;
/// What is nested deeper is no message: the library copies and prints JSON by calling itself.
constexpr int kMaxNesting = 100;

/// The parameters speak of a file that is not open, or of none.
struct NotOpen final : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "the file is not open"; }
};

Position position_in(const Json& json) { return {json.at("line").get<std::uint32_t>(), json.at("character").get<std::uint32_t>()}; }

/// What is asked of an open file.
struct Question {
  std::string_view name;
  Json (*answer)(const OpenFile& file, const Json& params);
};
constexpr std::array kQuestions{
    Question{"textDocument/hover", [](const OpenFile& file, const Json& params) { return hover(file, position_in(params.at("position"))); }},
    Question{"textDocument/definition", [](const OpenFile& file, const Json& params) { return definition(file, position_in(params.at("position"))); }},
    Question{"textDocument/references", [](const OpenFile& file, const Json& params) {
      return references(file, position_in(params.at("position")), params.value(Json::json_pointer("/context/includeDeclaration"), true));
    }},
    Question{"textDocument/prepareRename", [](const OpenFile& file, const Json& params) { return prepare_rename(file, position_in(params.at("position"))); }},
    Question{"textDocument/rename", [](const OpenFile& file, const Json& params) {
      return rename(file, position_in(params.at("position")), params.at("newName").get<std::string>());
    }},
    Question{"textDocument/completion", [](const OpenFile& file, const Json& params) { return completion(file, position_in(params.at("position"))); }},
    Question{"textDocument/documentSymbol", [](const OpenFile& file, const Json&) { return symbols(file); }},
    Question{"textDocument/formatting", [](const OpenFile& file, const Json&) { return formatting(file); }},
    Question{"textDocument/semanticTokens/full", [](const OpenFile& file, const Json&) { return semantic_tokens(file); }},
    Question{"textDocument/codeAction", [](const OpenFile& file, const Json& params) {
      const Json& range = params.at("range");
      return quick_fixes(file, position_in(range.at("start")), position_in(range.at("end")));
    }},
};

/// Discarded if it is no JSON, or is nested too deep.
Json parsed(const std::string& text) {
  bool deep = false;
  Json json = Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) { return !(deep = deep || depth > kMaxNesting); }, false);
  return deep ? Json(Json::value_t::discarded) : json;
}

/// The editor asks what the server has not.
struct UnknownMethod final : std::exception {};

}  // namespace

const Server::Event Server::kEvents[] = {
    {"initialize", &Server::initialize},
    {"initialized", &Server::begun},
    {"shutdown", &Server::shut_down},
    {"exit", &Server::exit},
    {"textDocument/didOpen", &Server::opened},
    {"textDocument/didChange", &Server::changed},
    {"textDocument/didSave", &Server::saved},
    {"textDocument/didClose", &Server::closed},
    {"workspace/didChangeWatchedFiles", &Server::saved},
};

bool Server::run() {
  while (!left_) {
    const auto text = wire_.read();
    if (!text) return false;
    take(*text);
    // While somebody types, only the last text counts.
    if (!left_ && workspace_.changed() && !wire_.waiting()) publish();
  }
  return shut_down_;
}

void Server::take(const std::string& text) {
  const Json message = parsed(text);
  if (message.is_discarded()) return fail(nullptr, kParseError, "this is no JSON, or it is nested too deep");
  const Json id = message.is_object() ? message.value("id", Json()) : Json();
  if (!message.is_object() || !message.contains("method") || !message["method"].is_string()) {
    const bool answer_of_editor = message.is_object() && (message.contains("result") || message.contains("error"));
    return answer_of_editor ? void() : fail(id, kInvalidRequest, "a message without a method");
  }
  answer(id, message["method"].get_ref<const std::string&>(), message.value("params", Json::object()));
}

/// `id` is null for what wants no answer.
void Server::answer(const Json& id, std::string_view method, const Json& params) {
  const bool asks = !id.is_null();
  const bool early = !begun_ && method != "initialize" && method != "exit";
  if (early) return asks ? fail(id, kNotInitialized, "`initialize` comes first") : void();
  if (shut_down_ && method != "exit") return asks ? fail(id, kInvalidRequest, "after `shutdown` only `exit` can come") : void();
  Json said;
  try {
    said = result(method, params);
  } catch (const NotOpen&) {   // and so there is nothing to say
  } catch (const UnknownMethod&) {
    return asks ? fail(id, kMethodNotFound, "kbc has no answer to this") : void();
  } catch (const Refused& why) {
    return fail(id, kRequestFailed, why.what());
  } catch (const Json::exception& wrong) {
    return fail(id, kInvalidParams, wrong.what());
  } catch (const std::logic_error& bug) {
    return fail(id, kInternalError, bug.what());
  }
  if (asks) wire_.write({{"jsonrpc", "2.0"}, {"id", id}, {"result", said}});
}

Json Server::result(std::string_view method, const Json& params) {
  if (const auto* const event = std::ranges::find(kEvents, method, &Event::name); event != std::end(kEvents)) return (this->*event->handler)(params);
  const auto* const question = std::ranges::find(kQuestions, method, &Question::name);
  if (question == kQuestions.end()) throw UnknownMethod();
  if (workspace_.changed()) publish();
  return question->answer(file_in(params), params);
}

/// To whom asked; to the editor's log where nobody did.
void Server::fail(const Json& id, int code, std::string_view what) {
  if (id.is_null() && code != kParseError && code != kInvalidRequest) {
    return wire_.write({{"jsonrpc", "2.0"}, {"method", "window/logMessage"}, {"params", {{"type", kLogError}, {"message", what}}}});
  }
  wire_.write({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", what}}}});
}

void Server::publish() {
  try {
    workspace_.compile();
  } catch (const std::logic_error& bug) {
    return fail(nullptr, kInternalError, bug.what());
  }
  std::map<std::string, Json> messages = messages_by_uri(workspace_, encoding_);
  for (const std::string& uri : told_) messages.try_emplace(uri, Json::array());
  told_.clear();
  for (const auto& [uri, all] : messages) {
    if (!all.empty()) told_.insert(uri);
    wire_.write({{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", {{"uri", uri}, {"diagnostics", all}}}});
  }
}

std::string Server::path_in(const Json& params) const {
  const auto path = path_of(params.at("textDocument").at("uri").get_ref<const std::string&>());
  if (!path) throw NotOpen();   // an editor's own scheme: a text that was never saved
  return workspace_.canonical(*path);
}

OpenFile Server::file_in(const Json& params) const {
  std::string path = path_in(params);
  if (!workspace_.files().texts().contains(path)) throw NotOpen();
  return {workspace_, std::move(path), encoding_, versioned_};
}

// ---- the session

Json Server::initialize(const Json& params) {
  const Json offered = params.value(Json::json_pointer("/capabilities/general/positionEncodings"), Json::array());
  const bool bytes = std::ranges::find(offered, Json("utf-8")) != offered.end();
  encoding_ = bytes ? Encoding::kUtf8 : Encoding::kUtf16;
  watches_ = params.value(Json::json_pointer("/capabilities/workspace/didChangeWatchedFiles/dynamicRegistration"), false);
  versioned_ = params.value(Json::json_pointer("/capabilities/workspace/workspaceEdit/documentChanges"), false);
  const bool prepares = params.value(Json::json_pointer("/capabilities/textDocument/rename/prepareSupport"), false);
  begun_ = true;
  return {{"serverInfo", {{"name", "kbc"}, {"version", version_}}},
          {"capabilities",
           {{"positionEncoding", bytes ? "utf-8" : "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", kWholeText}, {"save", true}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"renameProvider", prepares ? Json{{"prepareProvider", true}} : Json(true)},
            {"documentSymbolProvider", true},
            {"documentFormattingProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
            {"completionProvider", {{"triggerCharacters", {"."}}}},
            {"semanticTokensProvider", {{"legend", {{"tokenTypes", token_legend()}, {"tokenModifiers", Json::array()}}}, {"full", true}}}}}};
}
/// Asks to be told of files that change outside of the editor.
Json Server::begun(const Json&) {
  if (!watches_) return nullptr;
  const Json watchers{{"watchers", {{{"globPattern", "**/*.kb"}}}}};
  const Json registration{{"id", "files"}, {"method", "workspace/didChangeWatchedFiles"}, {"registerOptions", watchers}};
  wire_.write({{"jsonrpc", "2.0"}, {"id", "files"}, {"method", "client/registerCapability"}, {"params", {{"registrations", {registration}}}}});
  return nullptr;
}
Json Server::shut_down(const Json&) {
  shut_down_ = true;
  return nullptr;
}
Json Server::exit(const Json&) {
  left_ = true;
  return nullptr;
}

// ---- texts

Json Server::opened(const Json& params) {
  const Json& document = params.at("textDocument");
  const std::string path = path_in(params);
  workspace_.open(path, document.at("uri").get<std::string>(), document.at("text").get<std::string>());
  number(path, params);
  return nullptr;
}
void Server::number(const std::string& path, const Json& params) {
  const Json version = params.value(Json::json_pointer("/textDocument/version"), Json());
  if (version.is_number_integer()) workspace_.set_version(path, version.get<std::int64_t>());
}
Json Server::changed(const Json& params) {
  const OpenFile file = file_in(params);
  for (const Json& change : params.at("contentChanges")) workspace_.change(file.path, change.at("text").get<std::string>());
  number(file.path, params);
  return nullptr;
}
Json Server::saved(const Json&) {
  workspace_.look_again();
  return nullptr;
}
Json Server::closed(const Json& params) {
  const OpenFile file = file_in(params);
  workspace_.close(file.path);
  publish();   // what nobody has open any more has no messages either
  return nullptr;
}

}  // namespace kb::lsp
