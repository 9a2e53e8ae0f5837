#include "compiler/analysis/confusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "compiler/analysis/definitions.h"
#include "compiler/fuzzy/certainty.h"

namespace kb::analysis {
namespace {

using program::CellId;
using program::Percept;
using program::PerceptId;
using program::Program;

constexpr std::size_t kGrid = 400;
constexpr std::uint64_t kMostWork = 1'000'000, kOfNumber = 32;   // pairs of `and`s; a search over the values of a number is as dear as so many

/// The highest certainty that one reading can give to all of some literals at once, and at which value.
struct Best { double degree = -2.0; std::string where; };

/// What the caller wants to know: results up to `least` do not interest it, nor by how much a result exceeds `enough`.
struct Asked { double least = -2.0, enough = 2.0; };

/// The certainty of a prototype for the readings of a sensor: on a grid, and bounds between two neighbours of the grid.
struct Curve {
  std::vector<double> at;
  std::vector<double> most, least;   // by gap
};

}  // namespace

struct Confusions::Impl {
  explicit Impl(const Program& p) : program(p), definitions(p) {
    readings.reserve(p.perception.perceived.size());
  }

  /// Facts that are defined alike are compared once.
  const Best& most(const Definition& a, const Definition& b, double least) {
    const auto [known, fresh] = compared.try_emplace({&a, &b, least});
    if (fresh) known->second = most(a.terms, b.terms, {.least = least});
    return known->second;
  }

  Best most(const Disjunction& a, const Disjunction& b, Asked asked) {
    Best best{asked.least, {}};
    for (const Conjunction& x : a) {
      for (const Conjunction& y : b) {
        if (++work > kMostWork) return best;
        Best here = most(joined(x, y), Asked{best.degree, asked.enough});
        if (here.degree > best.degree) best = std::move(here);
        if (best.degree > asked.enough) return best;
      }
    }
    return best;
  }

  Best most(const Conjunction& all, Asked asked) {
    Best best{1.0, {}};
    for (std::size_t begin = 0; begin < all.size();) {
      std::size_t end = begin;
      while (end < all.size() && all[end].given == all[begin].given && all[end].subject == all[begin].subject) ++end;
      const Best here = most_of(std::span(all).subspan(begin, end - begin), asked);
      best.degree = std::min(best.degree, here.degree);
      if (!here.where.empty()) best.where += (best.where.empty() ? "" : " and ") + here.where;
      if (best.degree <= asked.least) return best;
      begin = end;
    }
    return best;
  }

  bool exclusive(const Definition& a, const Definition& b, double limit) {
    constexpr std::size_t kMostProducts = 256;
    constexpr double kRounding = 1e-6;
    if (a.cut || b.cut || a.terms.size() * b.terms.size() > kMostProducts) return false;
    const auto [known, fresh] = exclusives.try_emplace({&a, &b, limit});
    if (!fresh) return known->second;
    const Asked asked{limit - 1.0 - kRounding, limit - 1.0};
    const auto apart = [&](const Conjunction& x, const Conjunction& y) {
      if (!share_subject(x, y) || ++work > kMostWork) return false;
      const Conjunction both = joined(x, y);
      return torn(both) || most(both, asked).degree <= asked.least;
    };
    return known->second = std::all_of(a.terms.begin(), a.terms.end(), [&](const Conjunction& x) {
      return std::all_of(b.terms.begin(), b.terms.end(), [&](const Conjunction& y) { return apart(x, y); });
    });
  }

  [[nodiscard]] static Conjunction joined(const Conjunction& x, const Conjunction& y) {
    Conjunction both;
    both.reserve(x.size() + y.size());
    std::ranges::set_union(x, y, std::back_inserter(both));
    return both;
  }

  /// Whether both ask for a reading, or a fact of the host. What only one asks for cannot make them exclusive.
  [[nodiscard]] static bool share_subject(const Conjunction& x, const Conjunction& y) {
    const auto subject = [](const Literal& literal) { return std::pair(literal.given, literal.subject); };
    auto a = x.begin();
    for (auto b = y.begin(); a != x.end() && b != y.end(); ++(subject(*a) < subject(*b) ? a : b)) {
      if (subject(*a) == subject(*b)) return true;
    }
    return false;
  }

  /// Whether it has a part and its opposite, which then stand side by side.
  [[nodiscard]] static bool torn(const Conjunction& all) {
    return std::ranges::adjacent_find(all, [](const Literal& a, const Literal& b) {
             return a.negated != b.negated && std::tie(a.given, a.subject, a.prototype, a.text) == std::tie(b.given, b.subject, b.prototype, b.text);
           }) != all.end();
  }

  Best most_of(std::span<const Literal> same, Asked asked) {
    if (same.front().given) {
      const bool torn = std::any_of(same.begin(), same.end(), [&](const Literal& l) { return l.negated != same.front().negated; });
      return {torn ? 0.0 : 1.0, {}};
    }
    const program::Sensor& sensor = program.perception.sensor_of(same.front().subject);
    return sensor.text ? most_of_text(same, sensor) : most_of_number(same, sensor, asked);
  }

  Best most_of_text(std::span<const Literal> same, const program::Sensor& sensor) const {
    const auto asked = std::find_if(same.begin(), same.end(), [](const Literal& l) { return !l.negated; });
    std::vector<std::string> candidates;
    if (asked != same.end()) {
      candidates.push_back(asked->text);
    } else {
      candidates = sensor.texts;
      candidates.emplace_back();  // any other text
    }
    for (const std::string& text : candidates) {
      const bool all = std::all_of(same.begin(), same.end(), [&](const Literal& l) { return (l.text == text) != l.negated; });
      if (!all) continue;
      return {1.0, fmt::format("`{}` reads {}", program.perception.reading_name(same.front().subject),
                               text.empty() ? "something else" : "\"" + text + "\"")};
    }
    return {-1.0, {}};
  }

  [[nodiscard]] double at(const Literal& literal, const program::Sensor& sensor, double x) const {
    const double cf = fuzzy::certainty(program.perception.prototypes[literal.prototype].shape, x, sensor.noise);
    return literal.negated ? -cf : cf;
  }

  /// The places where prototypes change, the ends of the range, and the middles between these, ascending.
  [[nodiscard]] std::vector<double> corners_of(std::span<const Literal> same, const program::Sensor& sensor) const {
    std::vector<double> corners{sensor.low, sensor.high};
    for (const Literal& literal : same) {
      const fuzzy::Shape& shape = program.perception.prototypes[literal.prototype].shape;
      const std::size_t count = shape.kind == fuzzy::ShapeKind::kTrapezoid   ? 4
                                : shape.kind == fuzzy::ShapeKind::kTriangle  ? 3
                                : shape.kind == fuzzy::ShapeKind::kSingleton ? 1
                                                                             : 2;
      for (std::size_t k = 0; k < count; ++k) corners.push_back(shape.circular() ? fuzzy::wrapped(shape.p[k], sensor.low, shape.period) : shape.p[k]);
    }
    std::sort(corners.begin(), corners.end());
    for (std::size_t i = corners.size() - 1; i > 0; --i) corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(i), (corners[i - 1] + corners[i]) / 2.0);
    return corners;
  }

  // Possibility and necessity each rise up to some place and fall behind it (on a circle they fall up to the opposite place, where both are
  // nearly 0). So between two neighbours of the grid neither is lower than at the lower one of them, and higher than both only next to the
  // maximum.
  const Curve& curve(const Literal& literal, const program::Sensor& sensor) {
    const auto [known, fresh] = curves.try_emplace({sensor.first, literal.prototype});
    Curve& curve = known->second;
    if (!fresh) return curve;
    const fuzzy::Shape& shape = program.perception.prototypes[literal.prototype].shape;
    std::vector<fuzzy::Fit> fits;
    fuzzy::Fit top;
    for (std::size_t i = 0; i <= kGrid; ++i) {
      const fuzzy::Fit& fit = fits.emplace_back(fuzzy::fit(shape, grid_place(sensor, i), sensor.noise));
      curve.at.push_back(fit.possibility + fit.necessity - 1.0);
      top = {std::max(top.possibility, fit.possibility), std::max(top.necessity, fit.necessity)};
    }
    constexpr double kRounding = 1e-9;
    const auto upper = [](double a, double b, double greatest) { return std::max(a, b) >= greatest - kRounding ? 1.0 : std::max(a, b); };
    for (std::size_t i = 0; i < kGrid; ++i) {
      const fuzzy::Fit &a = fits[i], &b = fits[i + 1];
      curve.most.push_back(upper(a.possibility, b.possibility, top.possibility) + upper(a.necessity, b.necessity, top.necessity) - 1.0 + kRounding);
      curve.least.push_back(shape.circular() ? -1.0 : std::min(a.possibility, b.possibility) + std::min(a.necessity, b.necessity) - 1.0 - kRounding);
    }
    return curve;
  }

  [[nodiscard]] static double grid_place(const program::Sensor& sensor, std::size_t i) {
    return sensor.low + (sensor.high - sensor.low) * static_cast<double>(i) / kGrid;
  }

  [[nodiscard]] double least_at(std::span<const Literal> same, const program::Sensor& sensor, double x, double worth) const {
    double least = 2.0;
    for (std::size_t l = 0; l < same.size() && least > worth; ++l) least = std::min(least, at(same[l], sensor, x));
    return least;
  }

  [[nodiscard]] std::string where(std::span<const Literal> same, const program::Sensor& sensor, double x) const {
    return fmt::format("`{}` reads {:.4g}{}{}", program.perception.reading_name(same.front().subject), x, sensor.unit.empty() ? "" : " ", sensor.unit);
  }

  Best most_of_number(std::span<const Literal> same, const program::Sensor& sensor, Asked asked) {
    work += kOfNumber;
    const std::vector<double> corners = corners_of(same, sensor);
    for (const double corner : corners) {
      if (asked.enough >= 1.0) break;   // nothing is more
      const double here = std::clamp(corner, sensor.low, sensor.high), least = least_at(same, sensor, here, asked.enough);
      if (least > asked.enough) return {least, where(same, sensor, here)};
    }
    std::vector<const Curve*> lines;
    for (const Literal& literal : same) lines.push_back(&curve(literal, sensor));
    if (const double bound = most_between(same, lines); bound <= asked.least) return {bound, {}};
    double degree = -2.0;
    std::size_t place_of_best = 0;
    for (std::size_t i = 0; i <= kGrid; ++i) {
      double least = 2.0;
      for (std::size_t l = 0; l < same.size(); ++l) {
        const double cf = lines[l]->at[i];
        least = std::min(least, same[l].negated ? -cf : cf);
      }
      if (least > degree) degree = least, place_of_best = i;
    }
    double step = (sensor.high - sensor.low) / kGrid;
    double x = grid_place(sensor, place_of_best);
    const auto look_at = [&](double anywhere) {
      const double here = std::clamp(anywhere, sensor.low, sensor.high), least = least_at(same, sensor, here, degree);
      if (least > degree) degree = least, x = here;
    };
    for (const double corner : corners) look_at(corner);   // a peak there may be narrower than a step
    for (int round = 0; round < 2; ++round, step /= 10.0) {  // with smaller steps round the best place
      const double centre = x;
      for (int i = -10; i <= 10; ++i) look_at(centre + step * i / 10.0);
    }
    constexpr double kExact = 1e12;   // so that the sum of two halves is 0 and not a little less
    return {std::round(degree * kExact) / kExact + 0.0, where(same, sensor, x)};
  }

  /// A bound that all of them together exceed nowhere.
  [[nodiscard]] static double most_between(std::span<const Literal> same, std::span<const Curve* const> lines) {
    double bound = -2.0;
    for (std::size_t gap = 0; gap < kGrid; ++gap) {
      double here = 2.0;
      for (std::size_t l = 0; l < same.size(); ++l) here = std::min(here, same[l].negated ? -lines[l]->least[gap] : lines[l]->most[gap]);
      bound = std::max(bound, here);
    }
    return bound;
  }

  /// Whether each `and` of `narrow` has a part for every part of some `and` of `wide` that is never more certain where it is likely.
  bool follows(const Definition& narrow, const Definition& wide) {
    const auto [known, fresh] = followed.try_emplace({&narrow, &wide});
    if (!fresh) return known->second;
    const auto serves = [&](const Conjunction& x, const Conjunction& y) {
      return ++work <= kMostWork && std::all_of(y.begin(), y.end(), [&](const Literal& of_wide) {
        return std::any_of(x.begin(), x.end(), [&](const Literal& of_narrow) { return follows(of_narrow, of_wide); });
      });
    };
    return known->second = std::all_of(narrow.terms.begin(), narrow.terms.end(), [&](const Conjunction& x) {
      return std::any_of(wide.terms.begin(), wide.terms.end(), [&](const Conjunction& y) { return serves(x, y); });
    });
  }

  bool follows(const Literal& narrow, const Literal& wide) {
    if (narrow == wide) return true;
    if (narrow.given != wide.given || narrow.given || narrow.subject != wide.subject) return false;
    const program::Sensor& sensor = program.perception.sensor_of(narrow.subject);
    if (sensor.text) return !narrow.negated && wide.negated && narrow.text != wide.text;
    const auto [known, fresh] = below.try_emplace({sensor.first, narrow.prototype, narrow.negated, wide.prototype, wide.negated});
    if (!fresh) return known->second;
    std::vector<double> places = corners_of(std::array{narrow, wide}, sensor);
    for (std::size_t i = 0; i <= kGrid; ++i) places.push_back(grid_place(sensor, i));
    constexpr double kRounding = 1e-9;
    return known->second = std::all_of(places.begin(), places.end(), [&](double anywhere) {
      const double x = std::clamp(anywhere, sensor.low, sensor.high), cf = at(narrow, sensor, x);
      return cf <= 0.0 || cf <= at(wide, sensor, x) + kRounding;
    });
  }

  void collect(PerceptId id, std::set<std::uint32_t>& found) const {
    const Percept& percept = program.perception[id];
    for (const PerceptId child : percept.children) collect(child, found);
    if (percept.op == Percept::Op::kFits || percept.op == Percept::Op::kReads) found.insert(percept.reading);
    if (percept.op != Percept::Op::kFact) return;
    if (const auto at = definitions.place(percept.cell)) found.insert(readings[*at].begin(), readings[*at].end());
  }

  /// The readings on which the fact depends. Facts stand after those that define them.
  const std::set<std::uint32_t>& readings_of(CellId fact) {
    const std::size_t at = definitions.place(fact).value();
    while (readings.size() <= at) {
      std::set<std::uint32_t> found;
      collect(program.perception.perceived[readings.size()].percept, found);
      readings.push_back(std::move(found));
    }
    return readings[at];
  }

  const Program& program;
  Definitions definitions;
  std::uint64_t work = 0;   // so far; above kMostWork nothing is compared any more
  std::map<std::tuple<const Definition*, const Definition*, double>, Best> compared;   // looked up, never iterated
  std::map<std::tuple<const Definition*, const Definition*, double>, bool> exclusives;  // looked up, never iterated
  std::map<std::pair<const Definition*, const Definition*>, bool> followed;             // looked up, never iterated
  std::map<std::tuple<std::uint32_t, std::uint32_t, bool, std::uint32_t, bool>, bool> below;   // by sensor and two prototypes
  std::map<std::pair<std::uint32_t, std::uint32_t>, Curve> curves;   // by sensor and prototype
  std::vector<std::set<std::uint32_t>> readings;   // by perceived fact; filled when somebody asks
  // Perceived facts, as far as `sharing_before` has come. A reading is one text, so facts that are each just another of its texts exclude each other.
  struct Sharers {
    std::vector<std::size_t> texts, others;                       // which are one text of the reading, and all else
    std::map<std::string, std::vector<std::size_t>> of_text;      // of `texts`
  };
  std::map<std::uint32_t, Sharers> made_of;   // by reading
};

Confusions::Confusions(const Program& program) : impl_(std::make_unique<Impl>(program)) {}
Confusions::~Confusions() = default;

Confusion Confusions::between(CellId first, CellId second, double least) {
  const Best& best = impl_->most(impl_->definitions.of(first, false), impl_->definitions.of(second, false), least);
  return {first, second, best.degree, best.where};
}

Surest Confusions::surest(CellId fact, double enough) {
  const std::uint64_t before = std::exchange(impl_->work, 0);   // some 500 at most: as many as the `and`s of the definition
  Best best = impl_->most(impl_->definitions.of(fact, false).terms, Disjunction(1), {.enough = enough});
  impl_->work = before;
  return {best.degree, std::move(best.where)};
}

bool Confusions::special_case(CellId narrow, CellId wide, double seen) {
  if (impl_->definitions.built_on(narrow, wide)) return true;
  if (!impl_->follows(impl_->definitions.of(narrow, false), impl_->definitions.of(wide, false))) return false;
  return impl_->most(impl_->definitions.of(wide, false), impl_->definitions.of(narrow, true), seen).degree > seen;
}

bool Confusions::exclusive(CellId first, CellId second, double limit) {
  Definitions& definitions = impl_->definitions;
  return definitions.place(first) && definitions.place(second) && impl_->exclusive(definitions.of(first, false), definitions.of(second, false), limit);
}

bool Confusions::tired() const { return impl_->work > kMostWork; }

bool Confusions::looked_into(CellId fact) {
  return !impl_->definitions.of(fact, false).cut;
}

bool Confusions::share_readings(CellId first, CellId second) const {
  const std::set<std::uint32_t>& a = impl_->readings_of(first);
  const std::set<std::uint32_t>& b = impl_->readings_of(second);
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t reading) { return b.contains(reading); });
}

bool Confusions::reads_number(CellId fact) const {
  const std::set<std::uint32_t>& readings = impl_->readings_of(fact);
  return std::any_of(readings.begin(), readings.end(), [&](std::uint32_t reading) { return !impl_->program.perception.sensor_of(reading).text; });
}

std::vector<std::size_t> Confusions::sharing_before(std::size_t perceived) {
  const program::Perception& perception = impl_->program.perception;
  const program::Percept& definition = perception[perception.perceived[perceived].percept];
  std::vector<std::size_t> sharing;
  const auto share_with = [&](const std::vector<std::size_t>& facts) { sharing.insert(sharing.end(), facts.begin(), facts.end()); };
  for (const std::uint32_t reading : impl_->readings_of(perception.perceived[perceived].fact)) {
    Impl::Sharers& sharers = impl_->made_of[reading];
    share_with(sharers.others);
    if (definition.op == program::Percept::Op::kReads) {
      std::vector<std::size_t>& same = sharers.of_text[definition.text];
      share_with(same);
      same.push_back(perceived);
      sharers.texts.push_back(perceived);
    } else {
      share_with(sharers.texts);
      sharers.others.push_back(perceived);
    }
  }
  source::sort_unique(sharing);
  return sharing;
}

}  // namespace kb::analysis
