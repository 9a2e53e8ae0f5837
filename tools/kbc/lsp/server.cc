#include "tools/kbc/lsp/server.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <stdexcept>
#include <utility>

namespace kb::lsp {
namespace {

// Error codes of JSON-RPC and of the protocol.
constexpr int kParseError = -32700, kInvalidRequest = -32600, kMethodNotFound = -32601, kInvalidParams = -32602, kInternalError = -32603,
              kNotInitialized = -32002, kRequestFailed = -32803, kRequestCancelled = -32800;
constexpr int kWholeText = 1, kLogError = 1;
/// Messages that nest deeper are refused, because the library copies and prints JSON recursively.
constexpr int kMaxNesting = 100;
/// How many messages are read before the first of them is answered; a later one may cancel it.
constexpr std::size_t kMostAtOnce = 64;

struct WrongParameters final : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The parameters name a file that is not open, or no file.
struct NotOpen final : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "the file is not open"; }
};

/// A whole number of the protocol.
std::uint32_t number_in(const Json& json) {
  constexpr std::uint64_t kMost = (std::uint64_t{1} << 31u) - 1;
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > kMost) throw WrongParameters("lines and characters are whole numbers from 0 to 2147483647");
  return json.get<std::uint32_t>();
}
Position position_in(const Json& json) { return {number_in(json.at("line")), number_in(json.at("character"))}; }

/// A question about an open file.
struct Question {
  std::string_view name;
  Json (*answer)(const OpenFile& file, const Json& params);
};
/// A question about a place.
template <Json (*kAnswer)(const OpenFile& file, Position at)>
Json of_place(const OpenFile& file, const Json& params) { return kAnswer(file, position_in(params.at("position"))); }
/// A question about the whole file.
template <Json (*kAnswer)(const OpenFile& file)>
Json of_file(const OpenFile& file, const Json&) { return kAnswer(file); }

constexpr std::array kQuestions{
    Question{"textDocument/hover", of_place<hover>},
    Question{"textDocument/definition", of_place<definition>},
    Question{"textDocument/declaration", of_place<definition>},
    Question{"textDocument/documentHighlight", of_place<highlights>},
    Question{"textDocument/completion", of_place<completion>},
    Question{"textDocument/signatureHelp", of_place<signature>},
    Question{"textDocument/prepareRename", of_place<prepare_rename>},
    Question{"textDocument/documentSymbol", of_file<symbols>},
    Question{"textDocument/foldingRange", of_file<folds>},
    Question{"textDocument/documentLink", of_file<links>},
    Question{"textDocument/formatting", of_file<formatting>},
    Question{"textDocument/semanticTokens/full", of_file<semantic_tokens>},
    Question{"textDocument/references", [](const OpenFile& file, const Json& params) {
      return references(file, position_in(params.at("position")), params.value(Json::json_pointer("/context/includeDeclaration"), true));
    }},
    Question{"textDocument/rename", [](const OpenFile& file, const Json& params) {
      return rename(file, position_in(params.at("position")), params.at("newName").get<std::string>());
    }},
    Question{"textDocument/selectionRange", [](const OpenFile& file, const Json& params) {
      Json out = Json::array();
      for (const Json& at : params.at("positions")) out.push_back(selections(file, position_in(at)));
      return out;
    }},
    Question{"textDocument/codeAction", [](const OpenFile& file, const Json& params) {
      const Json only = params.value(Json::json_pointer("/context/only"), Json::array());
      if (!only.empty() && std::ranges::find(only, Json("quickfix")) == only.end()) return Json(Json::array());
      const Json& range = params.at("range");
      return quick_fixes(file, position_in(range.at("start")), position_in(range.at("end")));
    }},
};

/// The code unit that the escape at `text[at]` stands for, `\uD83D`; 0 if there is no such escape.
unsigned escaped_unit(std::string_view text, std::size_t at) {
  unsigned unit = 0;
  if (text.size() - at < 6 || text[at] != '\\' || text[at + 1] != 'u') return 0;
  const auto [end, error] = std::from_chars(text.data() + at + 2, text.data() + at + 6, unit, 16);
  return error == std::errc() && end == text.data() + at + 6 ? unit : 0;
}

/// Makes halves of surrogate pairs, which an editor may send while a character is cut in two, U+FFFD. The parser refuses them.
void mend_surrogates(std::string& json) {
  for (std::size_t at = json.find('\\'); at < json.size(); at = json.find('\\', at + 2)) {
    const unsigned unit = escaped_unit(json, at);
    if ((unit & 0xF800u) != 0xD800u) continue;
    const bool pair = unit < 0xDC00u && (escaped_unit(json, at + 6) & 0xFC00u) == 0xDC00u;
    if (pair) at += 6;
    else json.replace(at + 2, 4, "FFFD");
  }
}

/// Parses a message; `discarded` if it is not JSON or nests too deeply.
Json parsed(std::string text) {
  mend_surrogates(text);
  bool deep = false;
  Json json = Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) { return !(deep = deep || depth > kMaxNesting); }, false);
  return deep ? Json(Json::value_t::discarded) : json;
}

/// The editor calls a method that the server does not have.
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
    {"workspace/didChangeWorkspaceFolders", &Server::moved},
};

bool Server::run() {
  for (bool open = true; open && !left_;) {
    open = listen();
    while (!left_ && !come_.empty()) {
      const Json message = std::move(come_.front());
      come_.pop_front();
      take(message);
    }
    cancelled_.clear();
    // If more messages wait, because the user is typing, only the last text counts.
    if (!left_ && workspace_.changed() && (!open || !wire_.waiting())) publish();
  }
  return left_ && shut_down_;
}

bool Server::listen() {
  do {
    auto text = wire_.read();
    if (!text) return false;
    Json message = parsed(*std::move(text));
    const bool cancels = message.is_object() && message.value("method", Json()) == "$/cancelRequest";
    const Json what = cancels ? message.value("params", Json()) : Json();
    if (what.is_object()) cancelled_.insert(what.value("id", Json()));
    if (!cancels) come_.push_back(std::move(message));
  } while (wire_.waiting() && come_.size() < kMostAtOnce);
  return true;
}

void Server::take(const Json& message) {
  if (message.is_discarded()) return fail(nullptr, kParseError, "this is no JSON, or it is nested too deep");
  const Json id = message.is_object() ? message.value("id", Json()) : Json();
  if (!message.is_object() || !message.contains("method") || !message["method"].is_string()) {
    const bool answer_of_editor = message.is_object() && (message.contains("result") || message.contains("error"));
    return answer_of_editor ? void() : fail(id, kInvalidRequest, "a message without a method");
  }
  answer(id, message["method"].get_ref<const std::string&>(), message.value("params", Json::object()));
}

/// `id` is null for a notification, which gets no answer.
void Server::answer(const Json& id, std::string_view method, const Json& params) {
  const bool asks = !id.is_null();
  if (begun_ && method == "initialize") return fail(id, kInvalidRequest, "`initialize` comes once");
  const bool early = !begun_ && method != "initialize" && method != "exit";
  if (early) return asks ? fail(id, kNotInitialized, "`initialize` comes first") : void();
  if (asks && cancelled_.contains(id)) return fail(id, kRequestCancelled, "it is no longer asked");
  if (shut_down_ && method != "exit") return asks ? fail(id, kInvalidRequest, "after `shutdown` only `exit` can come") : void();
  Json said;
  try {
    said = result(method, params);
  } catch (const NotOpen&) {   // so there is nothing to answer
  } catch (const UnknownMethod&) {
    return asks ? fail(id, kMethodNotFound, "kbc has no answer to this") : void();
  } catch (const Refused& why) {
    return fail(id, kRequestFailed, why.what());
  } catch (const WrongParameters& wrong) {
    return fail(id, kInvalidParams, wrong.what());
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
  const bool of_workspace = method == "workspace/symbol";
  if (question == kQuestions.end() && !of_workspace) throw UnknownMethod();
  if (workspace_.changed()) publish();
  return of_workspace ? workspace_symbols(workspace_, params.at("query").get<std::string>(), encoding_) : question->answer(file_in(params), params);
}

/// Reports an error as the answer to a request, or to the editor's log if it was a notification.
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
  const std::map<std::string, Json> messages = messages_by_uri(workspace_, encoding_);
  const std::map<std::string, Json> before = std::exchange(told_, {});
  const auto tell = [&](const Json& params) { wire_.write({{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", params}}); };
  for (const auto& [uri, all] : messages) {
    Json params{{"uri", uri}, {"diagnostics", all}};
    const auto path = path_of(uri);
    if (const auto version = path ? workspace_.version(workspace_.canonical(*path)) : std::nullopt) params["version"] = *version;
    const auto known = before.find(uri);
    if (known == before.end() || known->second != params) tell(params);
    told_.emplace(uri, std::move(params));
  }
  for (const auto& [uri, params] : before) {
    if (!messages.contains(uri) && !params["diagnostics"].empty()) tell({{"uri", uri}, {"diagnostics", Json::array()}});
  }
}

std::string Server::path_in(const Json& params) const {
  const auto path = path_of(params.at("textDocument").at("uri").get_ref<const std::string&>());
  if (!path) throw NotOpen();   // an editor's own scheme, for a text that was never saved
  return workspace_.canonical(*path);
}

std::string Server::open_path_in(const Json& params) const {
  std::string path = path_in(params);
  if (!workspace_.files().texts().contains(path)) throw NotOpen();
  return path;
}

OpenFile Server::file_in(const Json& params) const {
  std::string path = open_path_in(params);
  const Knowledge* const knowledge = workspace_.of(path);
  const auto id = knowledge == nullptr ? std::nullopt : knowledge->file(path);
  if (!id) throw NotOpen();
  return {workspace_, *knowledge, *id, std::move(path), encoding_, versioned_};
}

// ---- the session

Json Server::initialize(const Json& params) {
  const Json offered = params.value(Json::json_pointer("/capabilities/general/positionEncodings"), Json::array());
  const bool bytes = std::ranges::find(offered, Json("utf-8")) != offered.end();
  encoding_ = bytes ? Encoding::kUtf8 : Encoding::kUtf16;
  watches_ = params.value(Json::json_pointer("/capabilities/workspace/didChangeWatchedFiles/dynamicRegistration"), false);
  versioned_ = params.value(Json::json_pointer("/capabilities/workspace/workspaceEdit/documentChanges"), false);
  const bool prepares = params.value(Json::json_pointer("/capabilities/textDocument/rename/prepareSupport"), false);
  add_folders(params);
  begun_ = true;
  return {{"serverInfo", {{"name", "kbc"}, {"version", version_}}},
          {"capabilities",
           {{"positionEncoding", bytes ? "utf-8" : "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", kWholeText}, {"save", true}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"declarationProvider", true},
            {"documentHighlightProvider", true},
            {"referencesProvider", true},
            {"renameProvider", prepares ? Json{{"prepareProvider", true}} : Json(true)},
            {"documentSymbolProvider", true},
            {"workspaceSymbolProvider", true},
            {"foldingRangeProvider", true},
            {"selectionRangeProvider", true},
            {"documentLinkProvider", Json::object()},
            {"documentFormattingProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
            {"completionProvider", {{"triggerCharacters", {"."}}}},
            {"signatureHelpProvider", {{"triggerCharacters", {"(", ",", ":"}}}},
            {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}},
            {"semanticTokensProvider", {{"legend", {{"tokenTypes", token_legend()}, {"tokenModifiers", Json::array()}}}, {"full", true}}}}}};
}
/// An editor with a single folder may give it without a list.
void Server::add_folders(const Json& params) {
  const auto add = [&](const Json& uri) {
    const auto path = uri.is_string() ? path_of(uri.get_ref<const std::string&>()) : std::nullopt;
    if (path) workspace_.add_folder(workspace_.canonical(*path));
  };
  const Json folders = params.value("workspaceFolders", Json());
  for (const Json& folder : folders) add(folder.at("uri"));
  if (!folders.is_array()) add(params.value("rootUri", Json()));
}
Json Server::moved(const Json& params) {
  const Json& event = params.at("event");
  for (const Json& folder : event.at("removed")) {
    if (const auto path = path_of(folder.at("uri").get_ref<const std::string&>())) workspace_.remove_folder(workspace_.canonical(*path));
  }
  add_folders({{"workspaceFolders", event.at("added")}});
  return saved(params);
}
/// Asks the editor for notifications about files that change outside of it.
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
  const std::string path = open_path_in(params);
  for (const Json& change : params.at("contentChanges")) {
    if (change.contains("range")) throw WrongParameters("a change has a range, and whole documents were asked for (textDocumentSync 1)");
    workspace_.change(path, change.at("text").get<std::string>());
  }
  number(path, params);
  return nullptr;
}
Json Server::saved(const Json&) {
  workspace_.look_again();
  return nullptr;
}
Json Server::closed(const Json& params) {
  workspace_.close(open_path_in(params));
  publish();   // files that are no longer open have no messages
  return nullptr;
}

}  // namespace kb::lsp
