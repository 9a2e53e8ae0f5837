#include <nlohmann/json.hpp>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/place.h"

namespace kb::diagnostics {
namespace {

using Json = nlohmann::ordered_json;

Json place_json(const source::Sources& sources, source::Span span) {
  if (!span.known()) return nullptr;
  const Place at = place(sources, span);
  return {{"file", sources.path(span.file)}, {"line", at.begin.line},        {"column", at.begin.column},
          {"end_line", at.end.line},         {"end_column", at.end.column}, {"begin", span.begin},
          {"end", span.end}};
}

}  // namespace

void JsonConsumer::consume(const Diagnostic& d) {
  const KindInfo& kind = info(d.kind);
  Json notes = Json::array();
  for (const Note& note : d.notes) notes.push_back({{"message", note.text}, {"place", place_json(sources_, note.span)}});
  const Json object = {{"severity", word(d.severity)},
                       {"code", kind.code == 0 ? std::string() : code_text(d.kind)},
                       {"flag", kind.flag},
                       {"message", d.message},
                       {"suggestion", d.suggestion},
                       {"place", place_json(sources_, d.span)},
                       {"notes", std::move(notes)}};
  // A file's name may hold bytes that are not UTF-8; JSON may not.
  sink_(object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace kb::diagnostics
