// Text in, forms out, for the tests of this folder.
#pragma once

#include <string>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"

namespace kb::syntax::testing {

struct Reading {
  std::string tree;                              ///< print_tree
  std::vector<diagnostics::Diagnostic> messages;
  std::vector<std::string> places;               ///< "line:column" of each message
};

inline Reading read(std::string text) {
  source::Sources sources;
  const source::FileId file = sources.add("test.kb", std::move(text));
  diagnostics::CollectingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  const Tree tree = parse(sources, file, diagnostics);
  Reading reading{print_tree(sources, tree), consumer.all, {}};
  for (const auto& message : reading.messages) {
    const source::Location at = sources.locate(file, message.span.begin);
    reading.places.push_back(std::to_string(at.line) + ":" + std::to_string(at.column));
  }
  return reading;
}

/// The tokens of `text` as `kbc dump tokens` prints them; `messages` as in `read`.
inline Reading read_tokens(std::string text) {
  source::Sources sources;
  const source::FileId file = sources.add("test.kb", std::move(text));
  diagnostics::CollectingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  const std::vector<Token> tokens = lex(sources, file, diagnostics);
  return {print_tokens(sources, tokens), consumer.all, {}};
}

/// The messages, one a line.
inline std::string said(const Reading& reading) {
  std::string out;
  for (std::size_t i = 0; i < reading.messages.size(); ++i) {
    out += (reading.places.empty() ? "" : reading.places[i] + " ") + reading.messages[i].message;
    if (!reading.messages[i].suggestion.empty()) out += " [" + reading.messages[i].suggestion + "]";
    out += '\n';
  }
  return out;
}

inline std::string formatted(std::string text) {
  source::Sources sources;
  const source::FileId file = sources.add("test.kb", std::move(text));
  return format(sources, file);
}

}  // namespace kb::syntax::testing
