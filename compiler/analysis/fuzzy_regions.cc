#include "compiler/analysis/fuzzy_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace kb::analysis {
namespace {

using fuzzy::Node;

constexpr std::size_t kMostSteps = 20'000;    // of one search; each looks at all rules of an output
constexpr double kNearly = 1e-9;

// The places on the line where the state of a shape changes.
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

std::vector<Piece> cut(const fuzzy::Input& input) {
  std::vector<double> corners;
  for (const fuzzy::Term& term : input.terms) add_corners(term.shape, corners);
  for (double& x : corners) {
    if (input.circular && x > -1e300 && x < 1e300) x = fuzzy::wrapped(x, input.low, input.high - input.low);
  }
  std::erase_if(corners, [&](double x) { return !(x > input.low && x < input.high); });
  corners.insert(corners.end(), {input.low, input.high});
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());

  std::vector<Piece> pieces;
  const auto add = [&](double low, double high) {
    Piece piece{low, high, {}};
    for (const fuzzy::Term& term : input.terms) {
      const double degree = fuzzy::mu(term.shape, piece.witness());
      const bool smooth = term.shape.kind != fuzzy::ShapeKind::kTriangle && term.shape.kind != fuzzy::ShapeKind::kTrapezoid &&
                          term.shape.kind != fuzzy::ShapeKind::kRamp;
      const double nearly = smooth ? 1e-38 : kNearly;
      piece.states.push_back(degree <= nearly ? 0 : degree >= 1.0 - (smooth ? 1e-16 : kNearly) ? 2 : 1);
    }
    pieces.push_back(std::move(piece));
  };
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) add(corners[i], corners[i + 1]);   // wide pieces first, because they are better examples
  for (const double corner : corners) add(corner, corner);
  // One piece for each combination of states of the terms.
  std::vector<Piece> different;
  std::set<std::vector<std::uint8_t>> seen;
  for (Piece& piece : pieces) {
    if (seen.insert(piece.states).second) different.push_back(std::move(piece));
  }
  return different;
}

std::string unit_text(const fuzzy::Input& input) { return input.unit.empty() ? "" : " " + input.unit; }

}  // namespace

FuzzyRegions::FuzzyRegions(const fuzzy::Controller& controller) : c_(controller) {
  for (const fuzzy::Input& input : c_.inputs) pieces_.push_back(cut(input));
  set_.pieces.assign(c_.slots, fuzzy::kNone);
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
    const std::uint32_t piece = set_.pieces[degree.slot];
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
    return set_.pieces[slot] == fuzzy::kNone ? slot : fuzzy::kNone;
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

// Recursion as deep as there are inputs.
bool FuzzyRegions::search_gap(const std::vector<std::uint32_t>& writers) {
  if (!spend()) return false;
  const fuzzy::Rule* undecided = nullptr;
  for (const std::uint32_t r : writers) {
    const Known rule = known_rule(c_.rules[r]);
    if (rule.surely_above) return false;
    if (rule.maybe_above && undecided == nullptr) undecided = &c_.rules[r];
  }
  if (undecided == nullptr) return true;
  const std::uint32_t slot = open_slot(*undecided);
  if (slot == fuzzy::kNone) return false;
  for (std::uint32_t piece = 0; piece < pieces_of(slot).size(); ++piece) {
    set_.pieces[slot] = piece;
    if (search_gap(writers)) return true;
  }
  set_.pieces[slot] = fuzzy::kNone;
  return false;
}

bool FuzzyRegions::search_fire(const fuzzy::Rule& rule) {
  if (!spend()) return true;
  const Known now = known_rule(rule);
  if (now.surely_above || !now.maybe_above) return now.surely_above;
  const std::uint32_t slot = open_slot(rule);
  for (std::uint32_t piece = 0; piece < pieces_of(slot).size(); ++piece) {
    set_.pieces[slot] = piece;
    if (search_fire(rule)) return true;
  }
  set_.pieces[slot] = fuzzy::kNone;
  return false;
}

std::optional<Region> FuzzyRegions::gap(std::uint32_t output) {
  std::vector<std::uint32_t> writers;
  for (std::uint32_t r = 0; r < c_.rules.size(); ++r) {
    for (const fuzzy::Consequent& consequent : c_.rules[r].consequents) {
      if (consequent.output == output) writers.push_back(r);
    }
  }
  steps_ = 0;
  set_.pieces.assign(c_.slots, fuzzy::kNone);
  if (!search_gap(writers)) return std::nullopt;
  // A result that was found without an input does not depend on it.
  for (std::uint32_t& piece : set_.pieces) {
    const std::uint32_t was = piece;
    piece = fuzzy::kNone;
    if (!none_fires(writers)) piece = was;
  }
  return set_;
}

bool FuzzyRegions::fires(std::uint32_t rule) {
  steps_ = 0;
  set_.pieces.assign(c_.slots, fuzzy::kNone);
  return search_fire(c_.rules[rule]);
}

std::string FuzzyRegions::text(const Region& region) const {
  std::string out;
  for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
    if (region.pieces[slot] == fuzzy::kNone) continue;
    const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
    const Piece& piece = pieces_of(slot)[region.pieces[slot]];
    const std::string place = piece.low == piece.high ? fmt::format("is {}{}", piece.low, unit_text(input))
                                                      : fmt::format("lies between {} and {}{}", piece.low, piece.high, unit_text(input));
    fmt::format_to(std::back_inserter(out), "{}`{}` {}", out.empty() ? "" : " and ", slot_name(c_, slot), place);
  }
  return out.empty() ? "the inputs are what they may" : out;
}

std::string FuzzyRegions::witness(const Region& region) const {
  std::string out;
  for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
    if (region.pieces[slot] == fuzzy::kNone) continue;
    const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
    fmt::format_to(std::back_inserter(out), "{}{} = {}{}", out.empty() ? "" : ", ", slot_name(c_, slot),
                   pieces_of(slot)[region.pieces[slot]].witness(), unit_text(input));
  }
  return out;
}

}  // namespace kb::analysis
