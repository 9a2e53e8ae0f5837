#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/place.h"
#include "compiler/source/encoding.h"

namespace kb::diagnostics {
namespace {

using Json = nlohmann::ordered_json;

Json location(const source::Sources& sources, source::Span span) {
  const Place at = place(sources, span);
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", uri(sources.path(span.file))}}},
            {"region",
             {{"startLine", at.begin.line},
              {"startColumn", at.begin.column},
              {"endLine", at.end.line},
              {"endColumn", at.end.column}}}}}};
}

Json text(std::string_view words) { return {{"text", words}}; }

Json rule(Kind kind) {
  const KindInfo& about = info(kind);
  const std::string help(explanation(kind));
  Json result = {{"id", code_text(kind)},
                 {"name", about.name},
                 {"shortDescription", text(general_text(kind))},
                 {"defaultConfiguration", {{"level", word(about.severity)}}}};
  if (!help.empty()) result["help"] = {{"text", help}, {"markdown", help}};
  return result;
}

}  // namespace

std::string uri(std::string_view path) {
  std::string out;
  if (path.starts_with("/")) out = "file://";
  for (const char c : path) {
    if (source::is_letter_or_digit(c) || std::string_view("-._~/").find(c) != std::string_view::npos) out += c;
    else fmt::format_to(std::back_inserter(out), "%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

struct SarifLog::Impl {
  std::string version;
  std::map<std::uint16_t, Kind> kinds;   // by code: the rules in their order
  std::vector<std::pair<Kind, Json>> results;
  Json remarks = Json::array();
  bool failed = false;
};

SarifLog::SarifLog(std::string version) : impl_(std::make_unique<Impl>()) { impl_->version = std::move(version); }
SarifLog::~SarifLog() = default;

void SarifLog::add(const source::Sources& sources, const Diagnostic& d) {
  if (d.severity == Severity::kError) impl_->failed = true;
  if (info(d.kind).code == 0) {
    impl_->remarks.push_back({{"level", word(d.severity)}, {"message", text(d.message)}});
    return;
  }
  impl_->kinds.emplace(info(d.kind).code, d.kind);
  const std::string better = d.suggestion.empty() ? "" : fmt::format("; did you mean `{}`?", d.suggestion);
  Json result = {{"ruleId", code_text(d.kind)}, {"ruleIndex", 0}, {"level", word(d.severity)},
                 {"message", text(d.message + better)}};
  if (d.span.known()) result["locations"] = Json::array({location(sources, d.span)});
  Json related = Json::array();
  for (const Note& note : d.notes) {
    Json at = note.span.known() ? location(sources, note.span) : Json::object();
    at["id"] = related.size() + 1;
    at["message"] = text(note.text);
    related.push_back(std::move(at));
  }
  if (!related.empty()) result["relatedLocations"] = std::move(related);
  impl_->results.emplace_back(d.kind, std::move(result));
}

std::string SarifLog::print() const {
  Json rules = Json::array();
  std::map<Kind, std::size_t> index;
  for (const auto& [code, kind] : impl_->kinds) {
    index[kind] = rules.size();
    rules.push_back(rule(kind));
  }
  Json results = Json::array();
  for (const auto& [kind, made] : impl_->results) {
    results.push_back(made);
    results.back()["ruleIndex"] = index[kind];
  }
  Json invocation = {{"executionSuccessful", !impl_->failed}};
  if (!impl_->remarks.empty()) invocation["toolExecutionNotifications"] = impl_->remarks;
  const Json driver = {{"name", "kbc"}, {"version", impl_->version}, {"rules", std::move(rules)}};
  const Json run = {{"tool", {{"driver", driver}}},
                    {"columnKind", "unicodeCodePoints"},
                    {"invocations", Json::array({std::move(invocation)})},
                    {"results", std::move(results)}};
  const Json document = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                         {"version", "2.1.0"},
                         {"runs", Json::array({run})}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace kb::diagnostics
