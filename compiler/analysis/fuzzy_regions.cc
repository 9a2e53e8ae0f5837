#include "compiler/analysis/fuzzy_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "compiler/source/numbers.h"
#include "compiler/source/texts.h"

namespace kb::analysis {
namespace {

using fuzzy::Node;

constexpr std::size_t kMostSteps = 20'000;    // of one search; each looks at all rules of an output
constexpr std::size_t kMostGaps = 256;        // of one output; only the first few are shown, but neighbours are joined before
constexpr double kNearly = 1e-9;

std::vector<std::uint8_t> states_at(const fuzzy::Input& input, double x) {
  using fuzzy::ShapeKind;
  std::vector<std::uint8_t> states;
  for (const fuzzy::Term& term : input.terms) {
    const double degree = fuzzy::mu(term.shape, x);
    const ShapeKind kind = term.shape.kind;
    const bool smooth = kind != ShapeKind::kTriangle && kind != ShapeKind::kTrapezoid && kind != ShapeKind::kRamp;
    const double nearly = smooth ? 1e-38 : kNearly;
    states.push_back(degree <= nearly ? 0 : degree >= 1.0 - (smooth ? 1e-16 : kNearly) ? 2 : 1);
  }
  return states;
}

std::vector<Piece> cut(const fuzzy::Input& input) {
  std::vector<double> corners;
  for (const fuzzy::Term& term : input.terms) add_corners(term.shape, corners);
  for (double& x : corners) {
    if (input.circular && x > -1e300 && x < 1e300) x = fuzzy::wrapped(x, input.low, input.high - input.low);
  }
  std::erase_if(corners, [&](double x) { return !(x > input.low && x < input.high); });
  corners.insert(corners.end(), {input.low, input.high});
  source::sort_unique(corners);

  std::vector<Piece> pieces;
  std::map<std::vector<std::uint8_t>, std::size_t> known;
  const auto add = [&](Stretch stretch) {
    std::vector<std::uint8_t> states = states_at(input, stretch.middle());
    const auto [piece, fresh] = known.try_emplace(states, pieces.size());
    if (fresh) pieces.push_back({{}, std::move(states)});
    pieces[piece->second].at.push_back(stretch);
  };
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) add({corners[i], corners[i + 1]});
  for (const double corner : corners) add({corner, corner});
  return pieces;
}

/// A number within the stretch, about its middle, of as few digits as that takes. The terms must be as they are in all of the piece: smooth
/// ones have no corners, so a stretch of theirs is known at its middle only.
double round_middle(const Stretch& stretch, const fuzzy::Input& input, const Piece& piece) {
  for (int digits = 2; digits < 17; ++digits) {
    double rounded = 0.0;
    if (!source::read_number(fmt::format("{:.{}g}", stretch.middle(), digits), rounded)) continue;
    if (stretch.low < rounded && rounded < stretch.high && states_at(input, rounded) == piece.states) return rounded;
  }
  return stretch.middle();
}

std::string unit_text(const fuzzy::Input& input) { return input.unit.empty() ? "" : " " + input.unit; }

// Neighbours are joined; where two intervals meet and their common end is not there, they stay apart.
std::vector<Stretch> joined(std::vector<Stretch> all) {
  std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  std::vector<Stretch> out;
  bool open = false;   // whether the end of the last one is not there
  for (const Stretch& one : all) {
    const bool point = one.low == one.high;
    if (!out.empty() && out.back().high == one.low && (point || !open)) out.back().high = one.high;
    else out.push_back(one);
    open = !point;
  }
  return out;
}

}  // namespace

void add_corners(const fuzzy::Shape& shape, std::vector<double>& to) {
  using fuzzy::ShapeKind;
  constexpr double kGone = 13.2;   // in spreads: beyond it a Gaussian is 0 in float
  const auto& p = shape.p;
  switch (shape.kind) {
    case ShapeKind::kTriangle: to.insert(to.end(), p.begin(), p.begin() + 3); break;
    case ShapeKind::kTrapezoid: to.insert(to.end(), p.begin(), p.end()); break;
    case ShapeKind::kRamp: to.insert(to.end(), p.begin(), p.begin() + 2); break;
    case ShapeKind::kGaussian: to.insert(to.end(), {p[0], p[1], p[0] - kGone * p[2], p[1] + kGone * p[3]}); break;
    case ShapeKind::kSingleton:
    case ShapeKind::kBell: to.push_back(p[0]); break;
    case ShapeKind::kSigmoid: break;
  }
}

FuzzyRegions::FuzzyRegions(const fuzzy::Controller& controller) : c_(controller) {
  for (const fuzzy::Input& input : c_.inputs) pieces_.push_back(cut(input));
  set_.assign(c_.slots, fuzzy::kNone);
  for (const fuzzy::Degree& degree : c_.degrees) {
    Known all{true, false, true, false};
    for (const Piece& piece : pieces_[degree.input]) {
      const std::uint8_t state = piece.states[degree.term];
      all.surely_above = all.surely_above && state > 0;
      all.maybe_above = all.maybe_above || state > 0;
      all.surely_one = all.surely_one && state == 2;
      all.maybe_one = all.maybe_one || state == 2;
    }
    unset_.push_back(all);
  }
}

// Recursion as deep as conditions nest.
FuzzyRegions::Known FuzzyRegions::known(std::uint32_t id) const {
  const Node& node = c_.nodes[id];
  if (node.op == Node::Op::kDegree) {
    const fuzzy::Degree& degree = c_.degrees[node.degree];
    const std::uint32_t piece = set_[degree.slot];
    if (piece == fuzzy::kNone) return unset_[node.degree];
    const std::uint8_t state = pieces_[degree.input][piece].states[degree.term];
    return {state > 0, state > 0, state == 2, state == 2};
  }
  const Known a = known(node.left);
  switch (node.op) {
    case Node::Op::kNot: return {!a.maybe_one, !a.surely_one, !a.maybe_above, !a.surely_above};
    case Node::Op::kAnd: {
      const Known b = known(node.right);
      return {a.surely_above && b.surely_above, a.maybe_above && b.maybe_above, a.surely_one && b.surely_one, a.maybe_one && b.maybe_one};
    }
    case Node::Op::kOr: {
      const Known b = known(node.right);
      return {a.surely_above || b.surely_above, a.maybe_above || b.maybe_above, a.surely_one || b.surely_one, a.maybe_one || b.maybe_one};
    }
    default: return a;
  }
}

FuzzyRegions::Known FuzzyRegions::known_rule(const fuzzy::Rule& rule) const {
  Known all = known(rule.condition);
  for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) {
    const Known own = known(c_.nests[nest].condition);
    all.surely_above = all.surely_above && own.surely_above;
    all.maybe_above = all.maybe_above && own.maybe_above;
  }
  return all;
}

// An input that the condition asks for and that is not set yet; kNone if there is none. Recursion as deep as conditions nest.
std::uint32_t FuzzyRegions::open_slot(std::uint32_t id) const {
  const Node& node = c_.nodes[id];
  if (node.op == Node::Op::kDegree) {
    const std::uint32_t slot = c_.degrees[node.degree].slot;
    return set_[slot] == fuzzy::kNone ? slot : fuzzy::kNone;
  }
  const std::uint32_t left = open_slot(node.left);
  const bool pair = node.op == Node::Op::kAnd || node.op == Node::Op::kOr;
  return left != fuzzy::kNone || !pair ? left : open_slot(node.right);
}

std::uint32_t FuzzyRegions::open_slot(const fuzzy::Rule& rule) const {
  std::uint32_t found = open_slot(rule.condition);
  for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) {
    const std::uint32_t outer = open_slot(c_.nests[nest].condition);
    if (outer != fuzzy::kNone) found = outer;
  }
  return found;
}

bool FuzzyRegions::spend() {
  gave_up_ = gave_up_ || ++steps_ > kMostSteps;
  return !gave_up_;
}

bool FuzzyRegions::none_fires(const std::vector<std::uint32_t>& writers) const {
  return std::none_of(writers.begin(), writers.end(), [&](std::uint32_t r) { return known_rule(c_.rules[r]).maybe_above; });
}

// What is set, without the slots on which the result does not depend.
Region FuzzyRegions::widest(const std::vector<std::uint32_t>& writers) {
  const std::vector<std::uint32_t> before = set_;
  Region region;
  for (std::uint32_t& piece : set_) {
    const std::uint32_t was = piece;
    piece = fuzzy::kNone;
    if (!none_fires(writers)) piece = was;
    region.pieces.emplace_back(piece == fuzzy::kNone ? 0 : 1, piece);
  }
  set_ = before;
  return region;
}

// Recursion as deep as there are inputs.
void FuzzyRegions::search_gaps(const std::vector<std::uint32_t>& writers, std::vector<Region>& found) {
  if (found.size() == kMostGaps || !spend()) return;
  const fuzzy::Rule* undecided = nullptr;
  for (const std::uint32_t r : writers) {
    const Known rule = known_rule(c_.rules[r]);
    if (rule.surely_above) return;
    if (rule.maybe_above && undecided == nullptr) undecided = &c_.rules[r];
  }
  if (undecided == nullptr) {
    Region region = widest(writers);
    if (std::find(found.begin(), found.end(), region) == found.end()) found.push_back(std::move(region));
    return;
  }
  const std::uint32_t slot = open_slot(*undecided);
  if (slot == fuzzy::kNone) return;
  for (std::uint32_t piece = 0; piece < pieces_of(slot).size(); ++piece) {
    set_[slot] = piece;
    search_gaps(writers, found);
  }
  set_[slot] = fuzzy::kNone;
}

// Two regions that differ in one slot are one.
void FuzzyRegions::join(std::vector<Region>& regions) const {
  const auto try_to = [&](Region& a, const Region& b) {
    std::uint32_t other = fuzzy::kNone;
    for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
      if (a.pieces[slot] == b.pieces[slot]) continue;
      if (other != fuzzy::kNone) return false;
      other = slot;
    }
    if (other == fuzzy::kNone) return true;
    std::vector<std::uint32_t> both;
    std::set_union(a.pieces[other].begin(), a.pieces[other].end(), b.pieces[other].begin(), b.pieces[other].end(), std::back_inserter(both));
    const bool any = a.pieces[other].empty() || b.pieces[other].empty() || both.size() == pieces_of(other).size();
    a.pieces[other] = any ? std::vector<std::uint32_t>{} : std::move(both);
    return true;
  };
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      for (std::size_t k = regions.size(); k-- > i + 1;) {
        if (!try_to(regions[i], regions[k])) continue;
        regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(k));
        again = true;
      }
    }
  }
}

bool FuzzyRegions::search_fire(const fuzzy::Rule& rule) {
  if (!spend()) return true;
  const Known now = known_rule(rule);
  if (now.surely_above || !now.maybe_above) return now.surely_above;
  const std::uint32_t slot = open_slot(rule);
  for (std::uint32_t piece = 0; piece < pieces_of(slot).size(); ++piece) {
    set_[slot] = piece;
    if (search_fire(rule)) return true;
  }
  set_[slot] = fuzzy::kNone;
  return false;
}

std::vector<Region> FuzzyRegions::gaps(std::uint32_t output) {
  std::vector<std::uint32_t> writers;
  for (std::uint32_t r = 0; r < c_.rules.size(); ++r) {
    for (const fuzzy::Consequent& consequent : c_.rules[r].consequents) {
      if (consequent.output == output) writers.push_back(r);
    }
  }
  steps_ = 0;
  set_.assign(c_.slots, fuzzy::kNone);
  std::vector<Region> found;
  search_gaps(writers, found);
  join(found);
  return found;
}

bool FuzzyRegions::fires(std::uint32_t rule) {
  steps_ = 0;
  set_.assign(c_.slots, fuzzy::kNone);
  return search_fire(c_.rules[rule]);
}

std::string FuzzyRegions::text(const Region& region) const {
  constexpr std::size_t kMostStretches = 4;
  std::string out;
  for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
    if (region.pieces[slot].empty()) continue;
    const std::string unit = unit_text(c_.inputs[input_of_slot(c_, slot)]);
    std::vector<Stretch> all;
    for (const std::uint32_t piece : region.pieces[slot]) all.insert(all.end(), pieces_of(slot)[piece].at.begin(), pieces_of(slot)[piece].at.end());
    all = joined(std::move(all));
    fmt::format_to(std::back_inserter(out), "{}`{}`", out.empty() ? "" : " and ", slot_name(c_, slot));
    for (std::size_t i = 0; i < std::min(all.size(), kMostStretches); ++i) {
      const bool point = all[i].low == all[i].high, lies = !point && (i == 0 || all[i - 1].low == all[i - 1].high);
      out += i == 0 ? " " : " or ";
      out += point ? fmt::format("is {}{}", all[i].low, unit) : fmt::format("{}between {} and {}{}", lies ? "lies " : "", all[i].low, all[i].high, unit);
    }
    if (all.size() > kMostStretches) out += " or elsewhere";
  }
  return out.empty() ? "the inputs are what they may" : out;
}

std::string FuzzyRegions::witness(const Region& region) const {
  std::string out;
  for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
    if (region.pieces[slot].empty()) continue;
    const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
    const Piece& piece = pieces_of(slot)[region.pieces[slot].front()];
    fmt::format_to(std::back_inserter(out), "{}{} = {}{}", out.empty() ? "" : ", ", slot_name(c_, slot), round_middle(piece.at.front(), input, piece), unit_text(input));
  }
  return out;
}

}  // namespace kb::analysis
