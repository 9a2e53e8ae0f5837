// Arguments of `control` lines: those that one line gives and another does not, and words that are not what they seem.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "compiler/analysis/subject.h"
#include "compiler/diagnostics/display.h"
#include "compiler/diagnostics/look_alike.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::Control;

/// Finds words that may be slips of one another without comparing all pairs. Two words that differ by one letter, or by two swapped ones,
/// become equal if the right letter is left out of each; two words that look alike have the same appearance.
class Neighbours {
 public:
  void add(std::string_view word) {
    for_each_key(word, [&](std::size_t key) { by_key_[key].push_back(word); });
  }
  /// The alphabetically first word that `written` may be a slip of and for which `counts` is true.
  template <class F>
  [[nodiscard]] std::optional<std::string_view> meant_by(std::string_view written, F&& counts) const {
    std::set<std::string_view> near;
    for_each_key(written, [&](std::size_t key) {
      if (const auto at = by_key_.find(key); at != by_key_.end()) near.insert(at->second.begin(), at->second.end());
    });
    const auto found = std::find_if(near.begin(), near.end(), [&](std::string_view word) { return diagnostics::is_slip_of(written, word) && counts(word); });
    return found == near.end() ? std::nullopt : std::optional(*found);
  }

 private:
  template <class F>
  static void for_each_key(std::string_view word, F&& f) {
    const std::hash<std::string_view> key;
    f(key(word));
    f(key(diagnostics::appearance(word)));
    std::string shorter(word);
    for (std::size_t i = word.size(); i-- > 0;) {
      shorter.assign(word.substr(0, i)).append(word.substr(i + 1));
      f(key(shorter));
    }
  }

  std::unordered_map<std::size_t, std::vector<std::string_view>> by_key_;   // looked up, never iterated
};

using Place = std::pair<std::uint32_t, std::uint32_t>;   // of an argument: file and offset
Place place_of(const Control::Argument& argument) { return {static_cast<std::uint32_t>(argument.span.file), argument.span.begin}; }

/// The `control` lines of controllers that the host program or the library has: which arguments they give, and how often. A line for
/// many strategies counts once for each of its arguments.
class Lines {
 public:
  Lines(const Subject& subject, const KnownArguments& known) : known_(known) {
    for (const model::FiniteSet& set : subject.model.sets) members_.insert(set.members.begin(), set.members.end());
    std::set<Place> counted;
    bool strange = false;   // some word belongs to no set
    for (const Control& control : subject.program.controls) {
      for (const Control::Argument& argument : control.arguments) {
        if (!counted.insert(place_of(argument)).second) continue;
        names_[control.controller].add(argument.name, place_of(argument), counted.size());
      }
      for (const Control::Argument& argument : control.arguments) {
        if (argument.is_number) continue;
        words_[{control.controller, argument.name}].add(argument.word, place_of(argument), counted.size());
        strange = strange || !members_.contains(argument.word);
      }
    }
    for (const std::string_view member : members_) {
      if (strange) near_members_.add(member);
    }
  }

  /// Whether the controller is known to have a parameter of that name.
  [[nodiscard]] bool knows(std::string_view controller, std::string_view name) const {
    const auto known = known_.find(controller);
    return known != known_.end() && std::find(known->second.begin(), known->second.end(), name) != known->second.end();
  }

  /// The name that the argument's name is probably a slip of: a name that the controller is known to have, or one that other lines give
  /// while only this line gives the present one. If one line each gives the two names, the later one is the slip.
  [[nodiscard]] std::optional<std::string_view> meant_by(const Control& control, const Control::Argument& argument) const {
    if (knows(control.controller, argument.name)) return std::nullopt;
    if (const auto known = known_.find(control.controller); known != known_.end()) {
      const auto meant = std::find_if(known->second.begin(), known->second.end(), [&](std::string_view name) { return diagnostics::is_slip_of(argument.name, name); });
      if (meant != known->second.end()) return *meant;
    }
    return names_.find(control.controller)->second.meant_by(argument.name, [&](std::string_view name) {
      return std::none_of(control.arguments.begin(), control.arguments.end(), [&](const auto& a) { return a.name == name; });
    });
  }

  /// The word of another line, or the member of a set, that this word is probably a slip of. As with names, if one line each gives the two
  /// words, the later one is the slip.
  [[nodiscard]] std::optional<std::string_view> word_meant_by(const Control& control, const Control::Argument& argument) const {
    if (members_.contains(argument.word)) return std::nullopt;
    const Uses& words = words_.find({control.controller, argument.name})->second;
    if (words.often(argument.word)) return std::nullopt;
    if (const auto meant = words.meant_by(argument.word, [](std::string_view) { return true; }, members_)) return meant;
    return near_members_.meant_by(argument.word, [](std::string_view) { return true; });
  }

 private:
  /// Names or words, and their places.
  class Uses {
   public:
    void add(std::string_view word, Place place, std::size_t order) {
      const auto [at, fresh] = uses_.try_emplace(word, Use{{}, order});
      at->second.places.insert(place);
      if (fresh) near_.add(word);
    }
    [[nodiscard]] bool often(std::string_view word) const { return uses_.find(word)->second.places.size() > 1; }
    /// Words in `right` are no slips, wherever they stand.
    template <class F>
    [[nodiscard]] std::optional<std::string_view> meant_by(std::string_view written, F&& counts, const std::set<std::string_view>& right = {}) const {
      if (often(written)) return std::nullopt;
      const Use& own = uses_.find(written)->second;
      return near_.meant_by(written, [&](std::string_view word) {
        const Use& use = uses_.find(word)->second;
        return (use.places.size() > 1 || use.first <= own.first || right.contains(word)) && counts(word);
      });
    }

   private:
    struct Use { std::set<Place> places; std::size_t first = 0; };   // its places, and the number of its first argument among all arguments
    std::unordered_map<std::string_view, Use> uses_;                 // looked up, never iterated
    Neighbours near_;
  };

  const KnownArguments& known_;
  std::map<std::string_view, Uses> names_;                                  // by controller
  std::map<std::pair<std::string_view, std::string_view>, Uses> words_;     // by controller and argument
  std::set<std::string_view> members_;
  Neighbours near_members_;
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

/// Those words of arguments that are names of declared satellites. Landmarks and rows of plans are places to drive to, so a controller may
/// well want their names.
std::set<std::string_view> states_among_words(const Subject& subject) {
  std::set<std::string_view> words, states;
  for (const Control& control : subject.program.controls) {
    for (const Control::Argument& argument : control.arguments) words.insert(argument.word);
  }
  for (const model::Cell& cell : subject.model.cells) {
    if (cell.kind == model::CellKind::kSatellite && words.contains(cell.name)) states.insert(cell.name);
  }
  if (states.empty()) return states;
  for (const model::Row& row : subject.model.rows) {
    if (row.cell != model::CellId::kNone) states.erase(subject.model[row.cell].name);
  }
  return states;
}

bool is_group_of_states(const Subject& subject, std::string_view name) {
  const auto& groups = subject.model.groups;
  return std::any_of(groups.begin(), groups.end(), [name](const model::Group& g) { return g.name == name && g.kind == model::CellKind::kSatellite; });
}

void diagnose_words(const Subject& subject, const Lines& lines) {
  const std::set<std::string_view> states = states_among_words(subject);
  for (const Control& control : subject.program.controls) {
    if (control.fuzzy != fuzzy::kNone) continue;
    for (const Control::Argument& argument : control.arguments) {
      if (argument.is_number) continue;
      if (states.contains(argument.word)) {
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

// Reports for each argument of a controller the first line that gives it another kind.
void diagnose_kinds(const Subject& subject) {
  struct First { const program::Control::Argument* argument; bool said; };
  std::map<std::pair<std::string_view, std::string_view>, First> known;
  for (const program::Control& control : subject.program.controls) {
    if (control.fuzzy != fuzzy::kNone) continue;
    for (const auto& argument : control.arguments) {
      const auto [at, fresh] = known.try_emplace({control.controller, argument.name}, First{&argument, false});
      First& first = at->second;
      const std::string here = kind_of(argument), there = kind_of(*first.argument);
      if (fresh || first.said || here == there) continue;
      first.said = true;
      subject.diagnostics.report(Kind::kArgumentKinds, argument.span, {argument.name, control.controller, here, there})
          .note(Kind::kOtherControlHere, first.argument->span);
    }
  }
}

/// Lines of one controller that do not give certain numbers, the same ones in each, while other lines do.
struct Missing {
  struct Given { const Control::Argument* argument; std::size_t lines; };
  static constexpr std::size_t kShown = 3;
  std::string_view controller;
  std::vector<source::Span> lines;   // only the first ones, which the message names
  std::size_t count = 0;
  std::vector<Given> arguments;   // the first line that gives each, and the number of such lines
};

void report_missing(const Subject& subject, const Missing& missing) {
  std::vector<std::string_view> names, others(missing.count - 1);
  for (const Missing::Given& given : missing.arguments) names.emplace_back(given.argument->name);
  for (std::size_t i = 1; i < missing.lines.size(); ++i) others[i - 1] = subject.diagnostics.sources().text(missing.lines[i]);
  const bool one = names.size() == 1;
  const Missing::Given& first = missing.arguments.front();
  subject.diagnostics.report(Kind::kArgumentMissing, missing.lines.front(),
                             {diagnostics::listed(names, Missing::kShown), missing.controller, one ? "is" : "are",
                              others.empty() ? "here" : fmt::format("here, and not for {}", diagnostics::listed(others, Missing::kShown)), one ? "it" : "them"})
      .note(first.lines == 1 ? Kind::kOnlyGivenHere : Kind::kOtherControlHere, first.argument->span, {first.argument->name});
}

/// The lines of one controller, and the numbers that some of them give.
struct Family {
  struct Given {
    const Control* control;
    const Control::Argument* argument;
    std::size_t lines = 0;
    std::vector<std::size_t> excused;   // the lines that give it, or misspell it, ascending
  };
  std::vector<const Control*> lines;    // one for each place
  std::map<std::string_view, Given> numbers;

  void excuse(std::string_view name, std::size_t line) {
    const auto at = numbers.find(name);
    if (at != numbers.end() && (at->second.excused.empty() || at->second.excused.back() != line)) at->second.excused.push_back(line);
  }
};

std::map<std::string_view, Family> families_of(const Subject& subject, const Lines& lines) {
  std::map<std::string_view, Family> families;
  for (const Control& control : subject.program.controls) {
    Family& family = families[control.controller];
    if (control.fuzzy != fuzzy::kNone || (!family.lines.empty() && family.lines.back()->span == control.span)) continue;
    family.lines.push_back(&control);
    for (const Control::Argument& argument : control.arguments) {
      if (argument.is_number) ++family.numbers.try_emplace(argument.name, Family::Given{&control, &argument, 0, {}}).first->second.lines;
    }
  }
  for (auto& one : families) {
    Family& family = one.second;
    for (std::size_t line = 0; line < family.lines.size(); ++line) {
      for (const Control::Argument& argument : family.lines[line]->arguments) {
        family.excuse(argument.name, line);
        if (const auto meant = lines.meant_by(*family.lines[line], argument)) family.excuse(*meant, line);
      }
    }
  }
  return families;
}

// Only for numbers: in C++ a number that is not given looks like 0, but a word that is not given can be told.
void diagnose_missing(const Subject& subject, const Lines& lines) {
  std::vector<Missing> all;
  for (const auto& [controller, family] : families_of(subject, lines)) {
    std::map<std::vector<std::size_t>, std::size_t> known;   // by the lines that are excused: the index into `all`
    for (const auto& one : family.numbers) {
      const Family::Given& given = one.second;
      if (given.excused.size() == family.lines.size() || lines.meant_by(*given.control, *given.argument)) continue;
      const auto [at, fresh] = known.try_emplace(given.excused, all.size());
      if (fresh) {
        all.push_back(Missing{controller, {}, family.lines.size() - given.excused.size(), {}});
        for (std::size_t line = 0, next = 0; line < family.lines.size() && all.back().lines.size() <= Missing::kShown; ++line) {
          if (next < given.excused.size() && given.excused[next] == line) ++next;
          else all.back().lines.push_back(family.lines[line]->span);
        }
      }
      all[at->second].arguments.push_back({given.argument, given.lines});
    }
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
