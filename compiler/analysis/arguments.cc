// Arguments of `control` lines: what one line says and another does not, and words that are not what they seem.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "compiler/analysis/subject.h"
#include "compiler/diagnostics/display.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::Control;

/// The lines of controllers that the host program has, or the library: what is given to them, and how often. One line for many strategies
/// counts once for each of its values.
class Lines {
 public:
  Lines(const Subject& subject, const KnownArguments& known) : known_(known) {
    for (const model::FiniteSet& set : subject.model.sets) members_.insert(set.members.begin(), set.members.end());
    std::set<std::pair<std::uint32_t, std::uint32_t>> counted;   // spans of arguments
    for (const Control& control : subject.program.controls) {
      for (const Control::Argument& argument : control.arguments) {
        if (!counted.insert({static_cast<std::uint32_t>(argument.span.file), argument.span.begin}).second) continue;
        Use& use = names_[control.controller].try_emplace(argument.name, Use{0, counted.size()}).first->second;
        ++use.lines;
      }
      for (const Control::Argument& argument : control.arguments) {
        if (argument.is_number) continue;
        words_[{control.controller, argument.name}].try_emplace(argument.word, Word{{}, counted.size()}).first->second.lines.insert(
            {static_cast<std::uint32_t>(argument.span.file), argument.span.begin});
      }
    }
  }

  /// The argument that the line gives in place of `meant`, one letter apart and given nowhere else.
  [[nodiscard]] const Control::Argument* slip_for(const Control& control, std::string_view meant) const {
    const auto slip = std::find_if(control.arguments.begin(), control.arguments.end(), [&](const auto& a) { return diagnostics::is_slip_of(a.name, meant) && meant_by(control, a) == meant; });
    return slip == control.arguments.end() ? nullptr : &*slip;
  }

  /// Whether the argument of that name, which the line gives, is one letter apart from another one.
  [[nodiscard]] bool is_slip(const Control& control, std::string_view name) const {
    return std::any_of(control.arguments.begin(), control.arguments.end(), [&](const auto& a) { return a.name == name && meant_by(control, a); });
  }

  /// Whether the controller is known to have something of that name to set.
  [[nodiscard]] bool knows(std::string_view controller, std::string_view name) const {
    const auto known = known_.find(controller);
    return known != known_.end() && std::find(known->second.begin(), known->second.end(), name) != known->second.end();
  }

  /// What the argument's name is one letter apart from, if the controller is known to have that, or if other lines give that and this line alone
  /// gives the other. Of two that one line each gives it is the later one that is not meant.
  [[nodiscard]] std::optional<std::string_view> meant_by(const Control& control, const Control::Argument& argument) const {
    if (knows(control.controller, argument.name)) return std::nullopt;
    if (const auto known = known_.find(control.controller); known != known_.end()) {
      const auto meant = std::find_if(known->second.begin(), known->second.end(), [&](std::string_view name) { return diagnostics::is_slip_of(argument.name, name); });
      if (meant != known->second.end()) return *meant;
    }
    const auto& names = names_.find(control.controller)->second;
    const Use& own = names.find(argument.name)->second;
    if (own.lines > 1) return std::nullopt;
    for (const auto& [name, use] : names) {
      if (use.lines == 1 && use.first > own.first) continue;
      if (!diagnostics::is_slip_of(argument.name, name)) continue;
      const bool here = std::any_of(control.arguments.begin(), control.arguments.end(), [&, n = name](const auto& a) { return a.name == n; });
      if (!here) return name;
    }
    return std::nullopt;
  }

  /// The word of another line, or the member of a set that such words are of, that this one is one letter apart from. As with names, of two
  /// that one line each gives it is the later one that is not meant.
  [[nodiscard]] std::optional<std::string_view> word_meant_by(const Control& control, const Control::Argument& argument) const {
    const auto& words = words_.find({control.controller, argument.name})->second;
    const Word& own = words.find(argument.word)->second;
    if (members_.contains(argument.word) || own.lines.size() > 1) return std::nullopt;
    for (const auto& [word, use] : words) {
      if (use.lines.size() == 1 && use.first > own.first && !members_.contains(word)) continue;
      if (diagnostics::is_slip_of(argument.word, word)) return word;
    }
    for (const std::string_view member : members_) {
      if (diagnostics::is_slip_of(argument.word, member)) return member;
    }
    return std::nullopt;
  }

 private:
  const KnownArguments& known_;
  struct Use { std::uint32_t lines = 0; std::size_t first = 0; };   // in how many lines, and which it is of all arguments where it stands first
  std::map<std::string_view, std::map<std::string_view, Use>> names_;   // by controller and argument
  struct Word { std::set<std::pair<std::uint32_t, std::uint32_t>> lines; std::size_t first = 0; };   // where it stands, by file and offset
  std::map<std::pair<std::string_view, std::string_view>, std::map<std::string_view, Word>> words_;   // by controller and argument
  std::set<std::string_view> members_;
};

void diagnose_names(const Subject& subject, const Lines& lines) {
  for (const Control& control : subject.program.controls) {
    if (control.fuzzy != fuzzy::kNone) continue;
    for (const Control::Argument& argument : control.arguments) {
      const auto meant = lines.meant_by(control, argument);
      if (meant && !lines.knows(control.controller, *meant)) subject.diagnostics.report(Kind::kArgumentName, argument.name_span(), {argument.name, control.controller}).suggest(std::string(*meant));
    }
  }
}

/// A satellite that was declared as such. A landmark or the row of a plan is a place to drive to; its name is what a controller wants.
bool is_state(const Subject& subject, std::string_view name) {
  const auto& cells = subject.model.cells;
  const auto cell = std::find_if(cells.begin(), cells.end(), [name](const model::Cell& c) { return c.name == name; });
  if (cell == cells.end() || cell->kind != model::CellKind::kSatellite) return false;
  const model::CellId id{static_cast<std::uint32_t>(cell - cells.begin())};
  const auto& rows = subject.model.rows;
  return std::none_of(rows.begin(), rows.end(), [id](const model::Row& row) { return row.cell == id; });
}

bool is_group_of_states(const Subject& subject, std::string_view name) {
  const auto& groups = subject.model.groups;
  return std::any_of(groups.begin(), groups.end(), [name](const model::Group& g) { return g.name == name && g.kind == model::CellKind::kSatellite; });
}

void diagnose_words(const Subject& subject, const Lines& lines) {
  for (const Control& control : subject.program.controls) {
    if (control.fuzzy != fuzzy::kNone) continue;
    for (const Control::Argument& argument : control.arguments) {
      if (argument.is_number) continue;
      if (is_state(subject, argument.word)) {
        subject.diagnostics.report(Kind::kArgumentCell, argument.span,
                                   {argument.name, control.controller, argument.word, "satellite",
                                    fmt::format("the program asks the mind for `{}`, or two strategies have a line each", argument.word)});
      } else if (is_group_of_states(subject, argument.word)) {
        subject.diagnostics.report(Kind::kArgumentCell, argument.span,
                                   {argument.name, control.controller, argument.word, "state of",
                                    "the program asks the mind for its members, or each has a strategy and a line"});
      } else if (const auto meant = lines.word_meant_by(control, argument)) {
        subject.diagnostics.report(Kind::kArgumentWord, argument.word_span(), {argument.name, control.controller, argument.word}).suggest(std::string(*meant));
      }
    }
  }
}

std::string kind_of(const program::Control::Argument& argument) {
  if (!argument.is_number) return "a word";
  return argument.unit.empty() ? "a plain number" : fmt::format("in `{}`", argument.unit);
}

// Of each argument of a controller the first other kind.
void diagnose_kinds(const Subject& subject) {
  struct First { const program::Control* control; const program::Control::Argument* argument; bool said; };
  std::map<std::pair<std::string_view, std::string_view>, First> known;
  for (const program::Control& control : subject.program.controls) {
    if (control.fuzzy != fuzzy::kNone) continue;
    for (const auto& argument : control.arguments) {
      const auto [at, fresh] = known.try_emplace({control.controller, argument.name}, First{&control, &argument, false});
      First& first = at->second;
      const std::string here = kind_of(argument), there = kind_of(*first.argument);
      if (fresh || first.said || here == there) continue;
      first.said = true;
      subject.diagnostics.report(Kind::kArgumentKinds, control.span, {argument.name, control.controller, here, there})
          .note(Kind::kOtherControlHere, first.control->span);
    }
  }
}

/// Numbers that lines of one controller do not give, all of them the same, and others do.
struct Missing {
  struct Given { const Control::Argument* argument; std::size_t lines; };
  std::string_view controller;
  std::vector<source::Span> lines;
  std::vector<Given> arguments;   // where each is given first, and in how many lines
};

void report_missing(const Subject& subject, const Missing& missing) {
  constexpr std::size_t kShown = 3;
  std::vector<std::string_view> names, others;
  for (const Missing::Given& given : missing.arguments) names.emplace_back(given.argument->name);
  for (std::size_t i = 1; i < missing.lines.size(); ++i) others.push_back(subject.diagnostics.sources().text(missing.lines[i]));
  const bool one = names.size() == 1;
  const Missing::Given& first = missing.arguments.front();
  subject.diagnostics.report(Kind::kArgumentMissing, missing.lines.front(),
                             {diagnostics::listed(names, kShown), missing.controller, one ? "is" : "are",
                              others.empty() ? "here" : fmt::format("here, and not for {}", diagnostics::listed(others, kShown)), one ? "it" : "them"})
      .note(first.lines == 1 ? Kind::kOnlyGivenHere : Kind::kOtherControlHere, first.argument->span, {first.argument->name});
}

// Numbers that another line of the same controller gives; a word that is not given is told apart in C++.
void diagnose_missing(const Subject& subject, const Lines& lines) {
  struct Given { const Control* control; const Control::Argument* argument; std::size_t lines; source::Span last; };
  std::map<std::string_view, std::map<std::string_view, Given>> given;
  for (const Control& control : subject.program.controls) {
    for (const Control::Argument& argument : control.arguments) {
      if (control.fuzzy != fuzzy::kNone || !argument.is_number) continue;
      Given& there = given[control.controller].try_emplace(argument.name, Given{&control, &argument, 0, {}}).first->second;
      there.lines += there.last == control.span ? 0 : 1;   // one line for many strategies
      there.last = control.span;
    }
  }
  std::map<std::pair<std::string_view, std::string_view>, std::vector<source::Span>> lacking;   // by controller and argument: lines
  for (const Control& control : subject.program.controls) {
    for (const auto& [name, there] : given[control.controller]) {
      const bool here = std::any_of(control.arguments.begin(), control.arguments.end(), [&, n = name](const auto& a) { return a.name == n; });
      if (here || control.fuzzy != fuzzy::kNone || lines.is_slip(*there.control, name) || lines.slip_for(control, name) != nullptr) continue;
      std::vector<source::Span>& places = lacking[{control.controller, name}];
      if (places.empty() || places.back() != control.span) places.push_back(control.span);
    }
  }
  std::vector<Missing> all;
  for (const auto& one : lacking) {
    const auto& [controller, name] = one.first;
    const Given& there = given[controller].find(name)->second;
    const auto same = std::find_if(all.begin(), all.end(), [&one](const Missing& m) { return m.controller == one.first.first && m.lines == one.second; });
    Missing& missing = same != all.end() ? *same : all.emplace_back(Missing{controller, one.second, {}});
    missing.arguments.push_back({there.argument, there.lines});
  }
  const auto place = [](const Missing& m) { return std::pair(m.lines.front().file, m.lines.front().begin); };
  std::stable_sort(all.begin(), all.end(), [&](const Missing& a, const Missing& b) { return place(a) < place(b); });
  for (const Missing& missing : all) report_missing(subject, missing);
}

}  // namespace

void diagnose_arguments(const Subject& subject, const KnownArguments& known) {
  const Lines lines(subject, known);
  diagnose_kinds(subject);
  diagnose_missing(subject, lines);
  diagnose_names(subject, lines);
  diagnose_words(subject, lines);
}

}  // namespace kb::analysis
