// What the grammar takes at a place, and which names and words there are for it.
#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include <waymark/controllers/registry.h>

#include "compiler/fuzzy/controller.h"
#include "compiler/fuzzy/shape.h"
#include "compiler/model/units.h"
#include "compiler/program/program.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/items.h"
#include "tools/kbc/lsp/kinds.h"
#include "tools/kbc/lsp/names.h"

namespace kb::lsp {
namespace {

using syntax::Lexeme;
using N = syntax::NameKind;

bool is_row(std::string_view kind) { return kind == "Landmark" || kind == "Command" || kind == "Route" || editor_kind(kind).kind.empty(); }
bool is_cell(std::string_view kind) { return kind == "fact" || kind == "satellite" || kind == "strategy"; }

/// Whether a declared name is of the kind that is wanted.
bool fits(N wanted, const model::KnownName& name) {
  const std::string_view kind = name.kind;
  switch (wanted) {
    case N::kAny: return kind != "rule" && kind != "control";   // these are never named in a statement
    case N::kLevel: return kind == "level";
    case N::kSet: return kind == "set" || (name.members != nullptr && is_cell(kind));   // a group with a set of its own
    case N::kRelation: return kind == "relation";
    case N::kRelationOrSet: return kind == "relation" || fits(N::kSet, name);
    case N::kMap: return kind == "map";
    case N::kRoute: return kind == "Route";
    case N::kCommand: return kind == "Command";
    case N::kLandmark: return kind == "Landmark";
    case N::kStrategy:
    case N::kSettingWord: return kind == "strategy";
    case N::kFact: return kind == "fact" || is_row(kind);
    case N::kFactOrStrategy: return kind == "strategy" || fits(N::kFact, name);
    case N::kSatellite: return kind == "satellite" || (is_row(kind) && kind != "Landmark" && kind != "Command");   // these are facts
    case N::kCell: return is_cell(kind) || is_row(kind);
    case N::kGroup: return is_cell(kind) || kind == "relation";
    case N::kPercept: return kind == "sensor" || fits(N::kFact, name);
    case N::kIndex: return kind == "table" || is_row(kind);
    case N::kValue: return is_cell(kind) || fits(N::kIndex, name);
    case N::kController: return kind == "fuzzy";
    case N::kShape: return kind == "prototype";
    default: return false;
  }
}

bool takes_variables(N wanted) {
  constexpr std::array kThese{N::kAny, N::kStrategy, N::kFact, N::kFactOrStrategy, N::kSatellite, N::kCell, N::kPercept, N::kIndex, N::kValue};
  return std::ranges::find(kThese, wanted) != kThese.end();
}

/// The same for a name in a fuzzy block, and for a controller.
bool fits(N wanted, std::string_view kind) {
  return (kind == "variable" && takes_variables(wanted)) || (kind == "input" && wanted == N::kInput) || (kind == "output" && wanted == N::kOutput) ||
         (kind == "term" && wanted == N::kTerm) || (kind == "controller" && wanted == N::kController);
}

class WantedItems {
 public:
  WantedItems(const OpenFile& file, std::span<const Lexeme> lexemes, std::uint32_t offset, const syntax::Wanted& wanted) : file_(file), offset_(offset), wanted_(wanted) {
    std::ranges::copy_if(lexemes, std::back_inserter(lexemes_), [](const Lexeme& one) { return one.what != Lexeme::Class::kComment; });
  }

  Json run() {
    for (const std::string_view word : wanted_.words) out_.add(word, kKeyword);
    const bool hedged = wanted_.names == N::kTerm && std::ranges::find(wanted_.words, "not") != wanted_.words.end();   // a term of a condition
    for (const std::string_view word : fuzzy::kHedges) {
      if (hedged && word != "not") out_.add(word, kKeyword);
    }
    if (wanted_.names == N::kNone || (wanted_.names == N::kSettingWord && before(2) != "idle")) return out_.take();   // others take numbers
    const std::vector<std::string_view> fixed = fixed_words();
    for (const std::string_view word : fixed) out_.add(word, wanted_.names == N::kUnit ? kUnit : kMember);
    if (wanted_.names == N::kController) {
      for (const mts::ControllerEntry& entry : mts::kControllers) out_.add(entry.name, editor_kind("controller").completion, entry.about);
    }
    declared();
    members();
    of_detours();
    if (wanted_.names == N::kRowField) fields();
    else if (fixed.empty() || wanted_.names == N::kShape) in_file();
    return out_.take();
  }

 private:
  [[nodiscard]] const model::Model& model() const { return file_.knowledge.compiled->model; }
  [[nodiscard]] std::string_view text(const Lexeme& one) const { return file_.sources().text(one.span); }

  /// Fixed words that can stand for what is wanted.
  [[nodiscard]] std::vector<std::string_view> fixed_words() const {
    switch (wanted_.names) {
      case N::kState: return {word(program::Term::kLow), word(program::Term::kZero), word(program::Term::kHigh)};
      case N::kFuzzyOutput: return {fuzzy::kCombineWords.begin(), fuzzy::kCombineWords.end()};
      case N::kText: return {"text"};
      case N::kUnit: return before(2) == "for" ? std::vector<std::string_view>{"us", "ms", "s", "min", "h"} : model::unit_names();
      case N::kSetting: return {model::kSettingNames.begin(), model::kSettingNames.end()};
      case N::kSettingWord: return {"stop", "hold"};
      case N::kShape: {
        std::vector<std::string_view> shapes;
        for (int i = 0; i <= static_cast<int>(fuzzy::ShapeKind::kSingleton); ++i) shapes.push_back(fuzzy::word(static_cast<fuzzy::ShapeKind>(i)));
        return shapes;
      }
      default: return {};
    }
  }

  /// The first lexeme that begins there or behind it.
  [[nodiscard]] std::vector<Lexeme>::const_iterator lexeme_at(std::uint32_t place) const {
    return std::ranges::lower_bound(lexemes_, place, {}, [](const Lexeme& one) { return one.span.begin; });
  }
  /// The lexeme that stands so many before the place; empty if there are fewer.
  [[nodiscard]] std::string_view before(std::size_t back) const {
    const auto at = lexeme_at(offset_);
    return static_cast<std::size_t>(at - lexemes_.begin()) >= back ? text(*(at - static_cast<std::ptrdiff_t>(back))) : std::string_view();
  }

  /// The conditions of detours speak of the leg that is barred, and of the exit by which it leaves.
  void of_detours() {
    const auto begin = lexeme_at(wanted_.statement);
    if (begin == lexemes_.end() || (text(*begin) != "detour" && text(*begin) != "detours")) return;
    if (wanted_.names == N::kIndex) out_.add("exit", kMember, "of the leg");
    if (takes_variables(wanted_.names)) out_.add("leg", kText, "the leg of the route");
  }

  void declared() {
    for (const model::KnownName& name : file_.knowledge.names) {
      if (!fits(wanted_.names, name) || !std::ranges::all_of(name.name, in_name)) continue;   // a leg, `Errand.1:Inn>Well`, cannot be written
      out_.add(name.name, editor_kind(name.kind).completion, detail({name.kind, name.more}));
    }
  }

  void members() {
    const auto add = [&](const model::FiniteSet& set) {
      for (const std::string& member : set.members) out_.add(member, kMember, "member of " + set.name);
    };
    if (wanted_.names == N::kExit && exits(model()) != nullptr) add(*exits(model()));
    if (wanted_.names == N::kMethod) {
      if (const auto set = set_of_roads(model(), "by")) add(model().sets[index(*set)]);
    }
    const bool any = wanted_.names == N::kAny || wanted_.names == N::kMember || wanted_.names == N::kIndex || wanted_.names == N::kValue;
    for (const model::FiniteSet& set : model().sets) {
      if (any) add(set);
    }
  }

  /// Names that only this file has: those within the statement, and those in statements that cannot be compiled yet.
  void in_file() {
    const std::string_view whose = wanted_.names == N::kTerm ? subject() : "";
    std::string_view quantity;   // the input or output among whose terms a lexeme stands
    for (std::size_t i = 0; i < lexemes_.size(); ++i) {
      const Lexeme& one = lexemes_[i];
      if (declares_quantity(i)) quantity = text(lexemes_[i + 1]);
      else if (text(one) == "}") quantity = {};
      if (wanted_.names == N::kTerm && (quantity.empty() || (!whose.empty() && quantity != whose))) continue;
      const bool here = one.span.begin <= offset_ && offset_ <= one.span.end;
      if (one.what != Lexeme::Class::kName || here || (i > 0 && lexemes_[i - 1].what == Lexeme::Class::kNumber)) continue;
      const bool inside = one.span.begin >= wanted_.statement && one.span.begin < offset_;
      const Use* const use = file_.knowledge.use_at(file_.id, one.span.begin);
      const auto what = use == nullptr ? std::nullopt : symbol(file_.knowledge, *use);
      if (what && (inside || what->kind == "controller") && fits(wanted_.names, what->kind)) {
        out_.add(text(one), editor_kind(what->kind).completion, std::string(what->kind));
      } else if (use == nullptr && (inside ? names_something(i) : !was_read(one.span))) {
        out_.add(text(one), kText);
      }
    }
  }
  [[nodiscard]] bool declares_quantity(std::size_t i) const {
    return i + 1 < lexemes_.size() && (text(lexemes_[i]) == "input" || text(lexemes_[i]) == "output") && lexemes_[i + 1].what == Lexeme::Class::kName;
  }
  /// The input or output of which a term is wanted: `x` of `x[2] is not `, of `x = `, of `output x ... default `. Empty if it is not declared.
  [[nodiscard]] std::string_view subject() const {
    std::size_t at = 0;   // behind the last lexeme before the place
    std::string_view last;
    std::set<std::string_view> quantities;
    for (; at < lexemes_.size() && lexemes_[at].span.end < offset_; ++at) {
      if (lexemes_[at].span.begin >= wanted_.statement && declares_quantity(at)) quantities.insert(last = text(lexemes_[at + 1]));
    }
    const auto before = [&] { return at > 0 ? text(lexemes_[at - 1]) : std::string_view(); };
    if (before() == "default") return last;
    while (fuzzy::hedge_of(before())) --at;
    if (before() == "is" || before() == "=") --at;
    if (before() == "]") at -= std::min<std::size_t>(at, 3);
    return quantities.contains(before()) ? before() : std::string_view();
  }
  [[nodiscard]] bool was_read(source::Span span) const {
    const auto statements = file_.knowledge.statements(file_.id);
    const auto after = std::ranges::upper_bound(statements, span.begin, {}, [](const syntax::Statement& one) { return one.span.begin; });
    return after != statements.begin() && span.end <= std::prev(after)->span.end;
  }
  /// Whether the i-th word names something within the statement: a variable, a landmark of the map, or something in a fuzzy block.
  [[nodiscard]] bool names_something(std::size_t i) const {
    const std::string_view before = i > 0 ? text(lexemes_[i - 1]) : "", after = i + 1 < lexemes_.size() ? text(lexemes_[i + 1]) : "";
    switch (wanted_.names) {
      case N::kLandmark: return before == "landmark";
      case N::kInput: return before == "input";
      case N::kOutput: return before == "output";
      case N::kTerm: return after == "=";   // in the braces of an input or output
      default: return takes_variables(wanted_.names) && after == "in";
    }
  }

  /// Fields of the relation that the row being written does not have yet.
  void fields() {
    const auto begin = lexeme_at(wanted_.statement);
    const auto open = std::find_if(begin, lexemes_.cend(), [&](const Lexeme& one) { return text(one) == "("; });
    const auto relation = open == lexemes_.end() || open == begin ? std::nullopt : relation_called(model(), text(*std::prev(open)));
    if (!relation) return;
    std::vector<std::string_view> given;
    for (auto at = open; at != lexemes_.end() && at->span.end <= offset_; ++at) {
      if (text(*at) == ":") given.push_back(text(*std::prev(at)));
    }
    for (const std::string& field : model()[*relation].fields) {
      if (std::ranges::find(given, field) == given.end()) out_.add(field, kField, "field of " + model()[*relation].name);
    }
  }

  const OpenFile& file_;
  const std::uint32_t offset_;
  const syntax::Wanted& wanted_;
  std::vector<Lexeme> lexemes_;   // of the file, without comments
  Items out_;
};

}  // namespace

const model::FiniteSet* exits(const model::Model& model) {
  if (const auto set = set_of_roads(model, "exit")) return &model.sets[index(*set)];
  const auto set = std::ranges::find(model.sets, "Direction", &model::FiniteSet::name);
  return set == model.sets.end() ? nullptr : &*set;
}

Json wanted(const OpenFile& file, std::span<const Lexeme> lexemes, std::uint32_t offset) {
  std::optional<syntax::Wanted> found = syntax::wanted_at(file.sources(), file.id, offset);
  if (!found) {   // the text before the place cannot be read, so anything may follow
    found.emplace();
    found->words.assign(syntax::words().begin(), syntax::words().end());
    found->words.insert(found->words.end(), syntax::words_in_places().begin(), syntax::words_in_places().end());
    found->names = N::kAny;
    found->statement = offset;
  }
  return WantedItems(file, lexemes, offset, *found).run();
}

}  // namespace kb::lsp
