#include "tools/kbc/wire/mistake.h"

#include "compiler/diagnostics/consumers.h"

namespace kb::wire {

void report(const Mistake& mistake, source::Span at, diagnostics::Diagnostics& diagnostics) {
  const auto& said = mistake.arguments;
  diagnostics.report(mistake.kind, at, {said[0], said[1], said[2]}).suggest(mistake.better);
}

std::string message_of(const Mistake& mistake) {
  const source::Sources none;
  diagnostics::CollectingConsumer list;
  diagnostics::Diagnostics messages(none, list);
  report(mistake, {}, messages);
  const diagnostics::Diagnostic& told = list.all.front();
  return told.suggestion.empty() ? told.message : told.message + "; did you mean `" + told.suggestion + "`?";
}

}  // namespace kb::wire
