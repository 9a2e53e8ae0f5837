// What is certain about a knowledge base of which some text could not be read.
#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "compiler/model/draft.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {
namespace {

using diagnostics::Diagnostic;
using diagnostics::Kind;

/// Errors that only the names at their place and the declarations of these decide. Numbers are not among them, since some could not be read.
constexpr Kind kOfNames[] = {
    Kind::kRedeclared, Kind::kMemberTwice, Kind::kUnknownSet, Kind::kNotASet, Kind::kMoreOfUnknown, Kind::kOfNothing,
    Kind::kFieldTwice, Kind::kUnknownRelation, Kind::kRuleTwice,
    Kind::kUnknownName, Kind::kUnknownMember, Kind::kUnknownField, Kind::kNoFields, Kind::kIndexCount, Kind::kNotIndexed,
    Kind::kIndexOfWrongSet, Kind::kIndexNotAMember, Kind::kNotATable, Kind::kArgumentCount, Kind::kStarInCall, Kind::kTableWithoutArguments,
    Kind::kBareMember, Kind::kEventOfNonFact, Kind::kWholeGroup, Kind::kNotACell, Kind::kSatOfSatellite, Kind::kBinderTwice, Kind::kEventOfGroup,
    Kind::kLandmarkTwice, Kind::kRoadUnknownLandmark, Kind::kUnknownMap, Kind::kUnknownCommand, Kind::kNotACommand,
    Kind::kUnknownLandmark, Kind::kNotALandmark, Kind::kUnknownRoute,
    Kind::kUnknownLevel, Kind::kWriteToFact, Kind::kWriteToStrategy, Kind::kWriteToLandmark, Kind::kWriteToCommand, Kind::kWriteWholeGroup, Kind::kValueWithUnit,
    Kind::kLevelTwice, Kind::kUnknownSetting, Kind::kSettingKind, Kind::kIdleUnknown, Kind::kTableMoreOfUnknown,
    Kind::kPriorityOfNonStrategy, Kind::kControlOfNonStrategy, Kind::kUnknownUnit, Kind::kControlArgumentTwice,
    Kind::kUnknownSensor, Kind::kNotASensor,
};

}  // namespace

void report_only_certain(const Forest& forest, diagnostics::Diagnostics& diagnostics) {
  const source::Sources& sources = diagnostics.sources();
  std::unordered_set<std::string_view> unread;   // its order decides nothing
  for (const syntax::Tree& tree : forest.trees) {
    if (sources.standard(tree.file)) continue;
    for (const std::string_view word : syntax::unread_words(sources, tree)) unread.insert(word);
  }
  // That may be an import, or a declaration of any name.
  const auto says_all = [](std::string_view word) { return word.empty() || word == "import" || diagnostics::is_slip_of(word, "import"); };
  if (!forest.all_imports || std::ranges::any_of(unread, says_all)) {
    diagnostics.limit([](const Diagnostic&) { return false; });
    return;
  }
  // A name is often taken for the word of the language that stands where it is missing.
  for (const std::string_view word : syntax::words()) unread.insert(word);
  diagnostics.limit([&sources, unread = std::move(unread)](const Diagnostic& diagnostic) {
    if (std::ranges::find(kOfNames, diagnostic.kind) == std::end(kOfNames)) return false;
    bool certain = true;
    syntax::each_word(sources.text(diagnostic.span), [&](std::string_view word) { certain = certain && !unread.contains(word); });
    return certain;
  });
}

}  // namespace kb::model
