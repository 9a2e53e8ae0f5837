#include "compiler/model/shapes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/model/units.h"
#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

using diagnostics::Kind;
using fuzzy::ShapeKind;

/// How a shape is written, for messages, and how many arguments it has.
struct Form {
  ShapeKind kind;
  std::size_t least, most;
  std::string_view written;
};
constexpr std::array kForms = {
    Form{ShapeKind::kTriangle, 3, 3, "triangle(a, b, c)"},
    Form{ShapeKind::kTrapezoid, 4, 4, "trapezoid(a, b, c, d)"},
    Form{ShapeKind::kGaussian, 2, 3, "gaussian(mean, spread)` or `gaussian(mean, left 0.1, right 0.2)"},
    Form{ShapeKind::kBell, 3, 3, "bell(centre, width, slope)"},
    Form{ShapeKind::kSigmoid, 2, 2, "sigmoid(inflection, slope)"},
    Form{ShapeKind::kRamp, 2, 2, "ramp(from, to)"},
    Form{ShapeKind::kSingleton, 1, 1, "singleton(x)"},
};

std::string unit_words(std::string_view unit) { return unit.empty() ? "a number without a unit" : fmt::format("in `{}`", unit); }

class ShapeReader {
 public:
  /// Without a domain, numbers without a unit have the unit of their neighbours.
  ShapeReader(const syntax::Shape& from, const Domain* domain, diagnostics::Diagnostics& diagnostics)
      : from_(from), domain_(domain), diagnostics_(diagnostics) {}

  std::optional<fuzzy::Shape> run() {
    const Form* form = find_form();
    if (form == nullptr) return std::nullopt;
    form_ = form;
    shape_.kind = form->kind;
    shape_.span = from_.span;
    if (from_.arguments.size() < form->least || from_.arguments.size() > form->most) {
      const std::size_t count = from_.arguments.size();
      diagnostics_.report(Kind::kShapeArgumentCount, from_.span,
                          {form->written, count == 1 ? std::string("is 1 argument") : fmt::format("are {} arguments", count)});
      return std::nullopt;
    }
    if (domain_ != nullptr && domain_->circular) {
      shape_.period = domain_->high - domain_->low;
      shape_.range_low = domain_->low;
    }
    form->kind == ShapeKind::kGaussian ? read_gaussian() : read_numbers();
    if (good_) check();
    if (!good_) return std::nullopt;
    return shape_;
  }

 private:
  const Form* find_form() {
    std::vector<std::string_view> words;
    for (const Form& form : kForms) {
      if (fuzzy::word(form.kind) == from_.name.text) return &form;
      words.push_back(fuzzy::word(form.kind));
    }
    // What other tools call these shapes.
    constexpr std::pair<std::string_view, ShapeKind> kElsewhere[] = {
        {"trimf", ShapeKind::kTriangle}, {"trapmf", ShapeKind::kTrapezoid}, {"gaussmf", ShapeKind::kGaussian}, {"gbellmf", ShapeKind::kBell},
        {"sigmf", ShapeKind::kSigmoid},  {"linsmf", ShapeKind::kRamp},      {"linzmf", ShapeKind::kRamp}};
    auto better = diagnostics::closest(from_.name.text, words);
    for (const auto& [name, kind] : kElsewhere) {
      if (name == from_.name.text) better = std::string(fuzzy::word(kind));
    }
    diagnostics_.report(Kind::kUnknownShape, from_.name.span, {from_.name.text, diagnostics::listed(words, words.size())}).suggest(better);
    return nullptr;
  }

  void fail(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
    diagnostics_.report(kind, at, arguments);
    good_ = false;
  }

  // ---- arguments

  [[nodiscard]] bool is_slope(std::size_t i) const {
    return (shape_.kind == ShapeKind::kBell && i == 2) || (shape_.kind == ShapeKind::kSigmoid && i == 1);
  }

  void read_numbers() {
    for (std::size_t i = 0; i < from_.arguments.size(); ++i) {
      const syntax::Shape::Argument& argument = from_.arguments[i];
      if (argument.label || argument.to) {
        fail(Kind::kShapeArgumentForm, argument.span, {diagnostics_.sources().text(argument.span), form_->written});
      } else if (!argument.number) {
        fail(Kind::kShapeNotANumber, argument.span, {argument.word.text, form_->written});
      } else if (is_slope(i)) {
        read_slope(*argument.number, i);
      } else {
        shape_.p[i] = quantity(*argument.number);
      }
    }
  }

  void read_slope(const syntax::Number& number, std::size_t i) {
    if (!number.unit.text.empty()) fail(Kind::kSlopeUnit, number.unit.span, {from_.name.text, number.unit.text});
    shape_.p[i] = number.value;
    good_ = good_ && in_reach(number, number.value, diagnostics_);
    // The unit of a slope is one over the unit of the other numbers.
    if (shape_.kind == ShapeKind::kSigmoid && domain_ != nullptr) shape_.p[i] /= scale({});
  }

  /// The size of `unit` in SI units; without a unit, that of the domain's unit.
  [[nodiscard]] double scale(std::string_view unit) const {
    syntax::Number one;
    one.value = 1.0;
    one.unit.text = unit.empty() ? domain_->written_unit : unit;
    const auto si = to_si(one, diagnostics_);
    return si ? si->value : 1.0;
  }

  void read_gaussian() {
    const std::vector<syntax::Shape::Argument>& in = from_.arguments;
    if (in[0].label || !in[0].number) {
      const bool label = in[0].label.has_value();
      return fail(label ? Kind::kShapeArgumentForm : Kind::kShapeNotANumber, in[0].span,
                  {diagnostics_.sources().text(in[0].span), form_->written});
    }
    shape_.p[0] = quantity(*in[0].number, in[0].to ? &*in[0].to : nullptr);
    shape_.p[1] = in[0].to ? quantity(*in[0].to) : shape_.p[0];
    if (in.size() == 2 && !in[1].label) {
      shape_.p[2] = shape_.p[3] = spread(in[1]);
      return;
    }
    std::array<bool, 2> seen{};
    for (std::size_t i = 1; i < in.size(); ++i) {
      const std::string_view label = in[i].label ? in[i].label->text : std::string_view{};
      const std::size_t side = label == "left" ? 0 : label == "right" ? 1 : 2;
      if (side == 2 || seen[side]) {
        return fail(Kind::kShapeArgumentForm, in[i].span, {diagnostics_.sources().text(in[i].span), form_->written});
      }
      seen[side] = true;
      shape_.p[2 + side] = spread(in[i]);
    }
    if (good_ && !(seen[0] && seen[1])) {
      fail(Kind::kShapeArgumentForm, in[1].span, {diagnostics_.sources().text(in[1].span), form_->written});
    }
  }

  double spread(const syntax::Shape::Argument& argument) {
    if (argument.to) {
      fail(Kind::kShapeArgumentForm, argument.span, {diagnostics_.sources().text(argument.span), form_->written});
      return 1.0;
    }
    if (!argument.number) {
      if (argument.word.text == "inf") return fuzzy::kInfinity;
      fail(Kind::kShapeNotANumber, argument.word.span, {argument.word.text, form_->written});
      return 1.0;
    }
    const double value = quantity(*argument.number);
    if (good_ && !(value > 0.0)) fail(Kind::kSpreadNotPositive, argument.span, {"spread", from_.name.text, syntax::number_text(*argument.number)});
    return value;
  }

  /// In SI. `unit_from` is where the unit stands if the number has none.
  double quantity(const syntax::Number& number, const syntax::Number* unit_from = nullptr) {
    syntax::Number with_unit = number;
    if (number.unit.text.empty() && unit_from != nullptr) with_unit.unit = unit_from->unit;
    if (domain_ != nullptr) {
      const auto value = resolve_number(with_unit, *domain_, diagnostics_);
      good_ = good_ && value.has_value();
      return value.value_or(0.0);
    }
    const auto si = to_si(with_unit, diagnostics_);
    good_ = good_ && si.has_value();
    if (!si) return 0.0;
    good_ = good_ && in_reach(number, si->value, diagnostics_);
    bare_ = bare_ || (with_unit.unit.text.empty() && number.value != 0.0);
    if (with_unit.unit.text.empty()) return si->value;
    if (unit_at_ != nullptr && si->unit != unit_) {
      diagnostics_.report(Kind::kShapeUnits, with_unit.unit.span, {with_unit.unit.text, unit_at_->unit.text})
          .note(Kind::kShapeNumberHere, unit_at_->span, {diagnostics_.sources().text(unit_at_->span)});
      good_ = false;
    }
    if (unit_at_ == nullptr) {
      unit_at_ = number.unit.text.empty() ? unit_from : &number;
      unit_ = si->unit;
    }
    return si->value;
  }

  // ---- what the numbers must obey

  void check() {
    // Without a domain, numbers with and without a unit cannot be compared yet.
    if (domain_ == nullptr && bare_ && unit_at_ != nullptr) return;
    switch (shape_.kind) {
      case ShapeKind::kTriangle: return check_corners(3);
      case ShapeKind::kTrapezoid: return check_corners(4);
      case ShapeKind::kGaussian:
        if (!(shape_.p[0] <= shape_.p[1])) fail_order(from_.arguments[0].span, *from_.arguments[0].number, *from_.arguments[0].to);
        check_turn(shape_.p[0], shape_.p[1]);
        return check_sides();
      case ShapeKind::kBell:
        check_positive(1, "width");
        return check_positive(2, "slope");
      case ShapeKind::kSigmoid:
        if (shape_.p[1] == 0.0) fail(Kind::kFlatShape, from_.span, {from_.name.text});
        return check_no_circle();
      case ShapeKind::kRamp:
        if (shape_.p[0] == shape_.p[1]) fail(Kind::kFlatShape, from_.span, {from_.name.text});
        return check_no_circle();
      case ShapeKind::kSingleton: return;
    }
  }

  void fail_order(source::Span at, const syntax::Number& first, const syntax::Number& second) {
    good_ = false;
    auto told = diagnostics_.report(Kind::kShapeOrder, at, {from_.name.text, syntax::number_text(second), syntax::number_text(first)});
    if (!shape_.circular()) return;
    const std::string_view unit = second.unit.text;
    const double round_on = second.value + shape_.period / scale(unit);
    if (round_on > first.value) told.note(Kind::kShapeGoesOn, {}, {syntax::number_text(second), fmt::format("{:.6g}{}{}", round_on, unit.empty() ? "" : " ", unit)});
  }

  void check_corners(std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) {
      if (shape_.p[i - 1] <= shape_.p[i]) continue;
      return fail_order(from_.arguments[i].span, *from_.arguments[i - 1].number, *from_.arguments[i].number);
    }
    check_turn(shape_.p[0], shape_.p[count - 1]);
  }

  void check_turn(double first, double last) {
    if (!shape_.circular() || last - first < shape_.period) return;
    fail(Kind::kShapeTooWide, from_.span, {from_.name.text, fmt::format("{}", last - first), fmt::format("{}", shape_.period)});
  }

  void check_sides() {
    for (const syntax::Shape::Argument& argument : from_.arguments) {
      if (!shape_.circular() || argument.word.text != "inf") continue;
      return fail(Kind::kShapeOnCircle, argument.span, {diagnostics_.sources().text(argument.span), domain_->name});
    }
  }

  void check_positive(std::size_t i, std::string_view what) {
    if (shape_.p[i] > 0.0) return;
    fail(Kind::kSpreadNotPositive, from_.arguments[i].span, {what, from_.name.text, syntax::number_text(*from_.arguments[i].number)});
  }

  void check_no_circle() {
    if (shape_.circular()) fail(Kind::kShapeOnCircle, from_.span, {from_.name.text, domain_->name});
  }

  const syntax::Shape& from_;
  const Domain* domain_;
  diagnostics::Diagnostics& diagnostics_;
  const Form* form_ = nullptr;
  fuzzy::Shape shape_;
  bool good_ = true;
  bool bare_ = false;                            // a number without a unit that is not 0
  const syntax::Number* unit_at_ = nullptr;      // the first number with a unit
  std::string_view unit_;
};

}  // namespace

bool in_reach(const syntax::Number& number, double value, diagnostics::Diagnostics& diagnostics) {
  const double size = std::fabs(value);
  if (size == 0.0 || (size >= 1e-18 && size <= 1e18)) return true;
  diagnostics.report(Kind::kNumberOutOfReach, number.span, {syntax::number_text(number)});
  return false;
}

std::optional<Domain> resolve_range(const syntax::Number& low, const syntax::Number& high, std::string name, bool circular,
                                    diagnostics::Diagnostics& diagnostics) {
  syntax::Number from = low, to = high;
  if (from.unit.text.empty()) from.unit = to.unit;
  if (to.unit.text.empty()) to.unit = from.unit;
  const auto first = to_si(from, diagnostics);
  if (!first) return std::nullopt;
  const auto last = to_si(to, diagnostics);
  if (!last) return std::nullopt;
  const source::Span whole = source::join(low.span, high.span);
  if (!in_reach(low, first->value, diagnostics) || !in_reach(high, last->value, diagnostics)) return std::nullopt;
  if (first->unit != last->unit) {
    diagnostics.report(Kind::kRangeUnits, whole, {from.unit.text, to.unit.text});
    return std::nullopt;
  }
  // The robot's tables are in float. If both ends are the same number there, the range is empty.
  if (!(static_cast<float>(first->value) < static_cast<float>(last->value))) {
    diagnostics.report(Kind::kEmptyRange, whole, {syntax::number_text(low), syntax::number_text(high)});
    return std::nullopt;
  }
  return Domain{std::move(name), first->value, last->value, std::string(last->unit), std::string(to.unit.text), circular, whole};
}

std::optional<double> resolve_number(const syntax::Number& number, const Domain& domain, diagnostics::Diagnostics& diagnostics) {
  syntax::Number with_unit = number;
  if (number.unit.text.empty()) with_unit.unit.text = domain.written_unit;
  const auto si = to_si(with_unit, diagnostics);
  if (!si) return std::nullopt;
  if (!in_reach(number, si->value, diagnostics)) return std::nullopt;
  if (si->unit == domain.unit) return si->value;
  diagnostics.report(Kind::kUnitMismatch, number.span, {syntax::number_text(number), domain.name, unit_words(domain.unit)})
      .note(Kind::kRangeHere, domain.declared, {domain.name});
  return std::nullopt;
}

std::optional<fuzzy::Shape> resolve_shape(const syntax::Shape& shape, const Domain& domain, diagnostics::Diagnostics& diagnostics) {
  return ShapeReader(shape, &domain, diagnostics).run();
}

bool check_shape(const syntax::Shape& shape, diagnostics::Diagnostics& diagnostics) {
  return ShapeReader(shape, nullptr, diagnostics).run().has_value();
}

}  // namespace kb::model
