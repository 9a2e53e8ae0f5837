// Controllers: `control Cross[t, mark] = turn_on_line(turn: t)`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compiler/model/references.h"
#include "compiler/model/shapes.h"
#include "compiler/model/units.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class ControlReader {
 public:
  ControlReader(Draft& draft, const syntax::Tree& tree, const syntax::Control& control,
                std::unordered_map<std::uint32_t, source::Span>& bound)
      : draft_(draft), tree_(tree), control_(control), bound_(bound) {}

  void run() {
    if (!read_arguments() || !read_fuzzy()) return;
    const syntax::Ref& ref = tree_[control_.strategy];
    const Entity* entity = draft_.names.find(ref.base.text);
    const bool indexed = ref.postfixes.size() == 1 && ref.postfixes.front().kind == syntax::Postfix::Kind::kIndex;
    if (entity != nullptr && entity->kind == Entity::Kind::kGroup && indexed) return bind_indexed(draft_.model.groups[entity->id], ref);
    std::vector<Binder> binders;
    References references(draft_, tree_, binders);
    const Operand operand = references.evaluate(references.compile(control_.strategy), {});
    if (operand.kind == Operand::Kind::kBroken) return;
    const auto cells = references.cells_of(operand);
    if (!cells || cells->empty() || draft_.model[cells->front()].kind != CellKind::kStrategy) {
      return report_no_strategy(ref, references.describe(operand));
    }
    for (const CellId cell : *cells) bind(cell, ref.span, {});
  }

 private:
  /// A free index stands for each member of its set; an argument of the same name gets that member.
  struct Variable { std::string_view name; std::string_view member; };

  void report_no_strategy(const syntax::Ref& ref, std::string_view what) {
    draft_.diagnostics.report(Kind::kControlOfNonStrategy, ref.span, {draft_.diagnostics.sources().text(ref.span), what});
  }

  /// A whole number may be an id or a mask, so no bit may be lost.
  void check_exact(const Control::Argument& argument) {
    const double given = static_cast<double>(static_cast<float>(argument.number));
    constexpr double kMost = 9007199254740992.0;   // 2^53: larger numbers were rounded when they were read
    if (argument.number != std::floor(argument.number) || std::abs(argument.number) > kMost || given == argument.number) return;
    draft_.diagnostics.report(Kind::kArgumentRounded, argument.span, {argument.name, fmt::format("{:.0f}", argument.number), fmt::format("{:.0f}", given)});
  }

  bool read_arguments() {
    bool good = true;
    std::set<std::string_view> known;
    for (const syntax::Control::Argument& from : control_.arguments) {
      if (!known.insert(from.name.text).second) {
        draft_.diagnostics.report(Kind::kControlArgumentTwice, from.name.span, {from.name.text});
        good = false;
        continue;
      }
      Control::Argument argument;
      argument.name = std::string(from.name.text);
      argument.span = source::join(from.name.span, from.number ? from.number->span : from.word.span);
      if (from.number) {
        const auto quantity = to_si(*from.number, draft_.diagnostics);
        good = quantity && in_reach(*from.number, quantity->value, draft_.diagnostics) && good;
        argument.is_number = true;
        argument.number = quantity ? quantity->value : 0.0;
        argument.unit = quantity ? std::string(quantity->unit) : std::string();
        if (good && argument.unit.empty()) check_exact(argument);
      } else {
        argument.word = std::string(from.word.text);
      }
      arguments_.push_back(std::move(argument));
    }
    return good;
  }

  /// If the controller is a fuzzy block, its arguments fix inputs. False if anything was reported.
  bool read_fuzzy() {
    const Entity* entity = draft_.names.find(control_.controller.text);
    if (entity == nullptr || entity->kind != Entity::Kind::kFuzzy) return true;
    fuzzy_ = entity->id;
    const fuzzy::Controller& controller = draft_.model.fuzzy[fuzzy_];
    bool good = true;
    for (std::size_t i = 0; i < arguments_.size(); ++i) good = fix_input(controller, control_.arguments[i], arguments_[i]) && good;
    return good;
  }

  bool fix_input(const fuzzy::Controller& controller, const syntax::Control::Argument& from, Control::Argument& argument) {
    const auto input = std::find_if(controller.inputs.begin(), controller.inputs.end(), [&](const fuzzy::Input& one) {
      return one.name == argument.name && !one.group;
    });
    if (input == controller.inputs.end()) {
      draft_.diagnostics.report(Kind::kFuzzyArgument, from.name.span, {controller.name, argument.name})
          .note(Kind::kNameDeclaredHere, controller.declared, {controller.name})
          .suggest(draft_.diagnostics.nearest(argument.name, controller.inputs,
                                              [](const fuzzy::Input& one) { return one.group ? std::string_view() : std::string_view(one.name); }));
      return false;
    }
    if (from.number) {
      const Domain domain{input->name, input->low, input->high, input->unit, input->written_unit, input->circular, input->declared};
      const auto value = resolve_number(*from.number, domain, draft_.diagnostics);
      if (!value) return false;
      argument.number = *value;
      argument.unit = input->unit;
      if (*value >= input->low && *value <= input->high) return true;
    }
    const source::Span at = from.number ? from.number->span : from.word.span;
    draft_.diagnostics.report(Kind::kFuzzyArgumentValue, at, {fmt::format("{}", input->low), fmt::format("{}", input->high), draft_.diagnostics.sources().text(at)});
    return false;
  }

  void bind_indexed(const Group& group, const syntax::Ref& ref) {
    if (group.kind != CellKind::kStrategy) return report_no_strategy(ref, "a group of other cells");
    const std::vector<syntax::Index>& indexes = ref.postfixes.front().arguments;
    const bool all = indexes.size() == 1 && indexes.front().star;
    if (indexes.size() != group.dimensions.size() && !all) {
      std::vector<Binder> binders;
      static_cast<void>(References(draft_, tree_, binders).compile(control_.strategy));  // reports what is wrong
      return;
    }
    for (std::size_t i = 0; i < group.dimensions.size(); ++i) {
      if (!read_index(all ? indexes.front() : indexes[i], group.dimensions[i])) return;
    }
    for (std::size_t place = 0; place < group.cells.size(); ++place) bind_place(group, place, ref.span);
  }

  bool read_index(const syntax::Index& index, SetId set) {
    const syntax::Ref* ref = index.star ? nullptr : &tree_[index.ref];
    if (index.star) {
      indexes_.push_back({});
      return true;
    }
    const std::string_view text = draft_.diagnostics.sources().text(ref->span);
    if (ref->postfixes.empty()) {
      if (const auto member = draft_.member(set, text)) {
        indexes_.push_back({{}, member->index});
        return true;
      }
      if (used(text)) {
        indexes_.push_back({text, std::nullopt});
        return true;
      }
    }
    const FiniteSet& known = draft_.model.sets[kb::model::index(set)];
    draft_.diagnostics.report(Kind::kControlVariable, ref->span, {text, known.name}).suggest(draft_.diagnostics.nearest(text, known.members));
    return false;
  }

  [[nodiscard]] bool used(std::string_view name) const {
    return std::any_of(control_.arguments.begin(), control_.arguments.end(),
                       [name](const syntax::Control::Argument& argument) { return !argument.number && argument.word.text == name; });
  }

  void bind_place(const Group& group, std::size_t place, source::Span at) {
    std::vector<Variable> variables;
    std::size_t rest = place;
    for (std::size_t i = group.dimensions.size(); i-- > 0;) {
      const std::vector<std::string>& members = draft_.model.sets[index(group.dimensions[i])].members;
      const std::size_t member = rest % members.size();
      rest /= members.size();
      if (indexes_[i].member && *indexes_[i].member != member) return;
      if (!indexes_[i].variable.empty()) {
        for (const Variable& variable : variables) {
          if (variable.name == indexes_[i].variable && variable.member != members[member]) return;  // `Cross[t, t]`
        }
        variables.push_back({indexes_[i].variable, members[member]});
      }
    }
    bind(group.cells[place], at, variables);
  }

  void bind(CellId strategy, source::Span at, const std::vector<Variable>& variables) {
    const auto [first, fresh] = bound_.emplace(static_cast<std::uint32_t>(strategy), at);
    if (!fresh) {
      draft_.diagnostics.report(Kind::kControlTwice, at, {draft_.model[strategy].name}).note(Kind::kFirstDeclaredHere, first->second);
      return;
    }
    Control control;
    control.strategy = strategy;
    control.controller = std::string(control_.controller.text);
    control.arguments = arguments_;
    control.span = at;
    control.controller_span = control_.controller.span;
    control.fuzzy = fuzzy_;
    for (Control::Argument& argument : control.arguments) {
      for (const Variable& variable : variables) {
        if (!argument.is_number && argument.word == variable.name) {
          argument.word = std::string(variable.member);
          break;
        }
      }
    }
    draft_.model.controls.push_back(std::move(control));
  }

  /// A member, a variable, or neither for `*`.
  struct IndexForm { std::string_view variable; std::optional<std::uint32_t> member; };

  Draft& draft_;
  const syntax::Tree& tree_;
  const syntax::Control& control_;
  std::unordered_map<std::uint32_t, source::Span>& bound_;
  std::vector<Control::Argument> arguments_;
  std::uint32_t fuzzy_ = fuzzy::kNone;
  std::vector<IndexForm> indexes_;
};

}  // namespace

void bind_controllers(Draft& draft) {
  std::unordered_map<std::uint32_t, source::Span> bound;  // by strategy
  draft.each<syntax::Control>([&](const syntax::Tree& tree, const auto&, const syntax::Control& control) {
    ControlReader(draft, tree, control, bound).run();
  });
}

}  // namespace kb::model
