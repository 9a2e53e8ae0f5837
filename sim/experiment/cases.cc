#include "sim/experiment/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/robot/body.h"
#include "sim/world/geometry.h"

namespace kb::sim::experiment {
namespace {

// m, times the size of the robot, as all lengths drawn here are; times grow with the root of the size: see controllers/similarity.h.
constexpr double kEarly = 0.3;            // behind a stop line: a robot there is on the road to the crossing at its end
constexpr double kBarrier = 0.2;          // its radius
constexpr double kSignRead = 0.5;         // before a stop line: nearer to it the sign there may already be read

/// Draws what goes wrong and writes it into the case.
class Drawer {
 public:
  Drawer(const CaseGround& ground, Case& out, Random& random)
      : labyrinth_(ground.labyrinth), as_(ground.size), route_(ground.route), start_(ground.start), out_(out), random_(random) {}

  void draw(Class what) {
    const int count = random_.chance(0.4f) ? 2 : 1;
    for (int i = 0; i < count; ++i) {
      if (what == Class::kRoute) draw_route();
      if (what == Class::kBetween) draw_between();
      if (what == Class::kPlace) draw_place();
    }
  }

 private:
  void draw_route() {
    const float dice = random_.unit();
    if (dice < 0.55f) close_for_good();
    else if (dice < 0.75f) close_for_a_while();
    else unsafe();
  }
  void draw_between() {
    const float dice = random_.unit();
    if (dice < 0.55f) obstacle();
    else if (dice < 0.70f) walker();
    else if (dice < 0.85f) power();
    else twice();
  }
  void draw_place() {
    const float dice = random_.unit();
    const std::vector<std::size_t> marked = marked_legs();
    const bool wears = !marked.empty();
    if (dice < 0.25f && wears) worn(marked[below(marked.size())]);
    else if (dice < 0.45f) tag(leg(), false);
    else if (dice < 0.65f) tag(leg(), true);
    else if (dice < 0.80f && wears) worn_and_unreadable(marked[below(marked.size())]);
    else kidnap();
  }

  // ---- words
  [[nodiscard]] std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.next() % n); }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * static_cast<double>(random_.unit()); }
  /// A length and a time that were drawn for a robot of size 1, as they are written.
  [[nodiscard]] double m(double length_m) const { return length_m * static_cast<double>(as_.of("m")); }
  [[nodiscard]] double s(double time_s) const { return time_s * static_cast<double>(as_.of("s")); }
  [[nodiscard]] std::size_t leg() { return below(route_.exits.size()); }
  /// The legs along painted lines: no other road has a marking to wear off.
  [[nodiscard]] std::vector<std::size_t> marked_legs() const {
    std::vector<std::size_t> marked;
    for (std::size_t i = 0; i < route_.exits.size(); ++i) {
      if (road(i).method == "mark") marked.push_back(i);
    }
    return marked;
  }
  [[nodiscard]] const Road& road(std::size_t leg) const { return labyrinth_[route_.exits[leg]->road]; }
  /// Rounded down to whole centimetres, as it is written.
  [[nodiscard]] double length_m(std::size_t leg) const { return std::floor((road(leg).ends_m - road(leg).begins_m) * 100.0) / 100.0; }
  /// The end of a stretch as it is written: on a floor of any size it is not rounded beyond the end of the road.
  [[nodiscard]] double end_m(std::size_t leg, double to_m) const {
    return std::min(m(to_m), std::floor(m(road(leg).ends_m - road(leg).begins_m) * 100.0) / 100.0);
  }
  [[nodiscard]] std::string exit(std::size_t leg) const {
    return fmt::format("{}.{}", labyrinth_[route_.crossings[leg]].name, route_.exits[leg]->name);
  }
  /// The arm on which the leg arrives.
  [[nodiscard]] std::string approach(std::size_t leg) const {
    const Arm& arm = *route_.exits[leg];
    return fmt::format("{}.{}", labyrinth_[route_.crossings[leg + 1]].name, arm.forward ? road(leg).approach : road(leg).exit);
  }
  /// The trigger for when the robot is on the way to the crossing that the leg leaves.
  [[nodiscard]] std::string on_the_way_to(std::size_t leg) const {
    if (leg == 0) return "time = 0.5";
    return fmt::format("road = \"{}\", metres = {}", exit(leg - 1), m(kEarly));
  }
  void kind(std::string_view word) { out_.kinds += fmt::format("{}{}", out_.kinds.empty() ? "" : "+", word); }
  void event(std::string_view when, std::string_view what) { out_.scenario += fmt::format("\n[[event]]\nwhen = {{ {} }}\n{}\n", when, what); }
  /// Whether the goal can still be reached if this road is closed for good as well.
  [[nodiscard]] bool can_do_without(RoadId road_id) const {
    Bans bans = out_.bans;
    bans.roads.push_back(road_id);
    return shortest_way(labyrinth_, route_.crossings.front(), route_.crossings.back(), bans).has_value();
  }

  // ---- class 1
  void close_for_good() {
    const std::size_t leg_of = leg();
    const RoadId id = route_.exits[leg_of]->road;
    if (!can_do_without(id)) return close_for_a_while();
    out_.bans.roads.push_back(id);
    event("time = 0", fmt::format("close = \"{}\"", exit(leg_of)));
    barrier(leg_of, "time = 0", "");
    kind("closed");
  }
  void close_for_a_while() {
    const std::size_t leg_of = leg();
    const std::string time = fmt::format("for = {:.1f}", s(between(20.0, 60.0)));
    event(on_the_way_to(leg_of), fmt::format("close = \"{}\"\n{}", exit(leg_of), time));
    barrier(leg_of, on_the_way_to(leg_of), time);
    kind("closed_a_while");
  }
  /// Puts an obstacle across the closed road, unless the robot starts where it would stand.
  void barrier(std::size_t leg_of, std::string_view when, std::string_view time) {
    const double at_m = 0.5 * length_m(leg_of), room_m = kBarrier + static_cast<double>(kRobotRadius) + 0.1;
    ++things_;
    if (route_.exits[leg_of]->road == start_.arm->road && std::abs(at_m - kStartBefore) < room_m) return;
    event(when, fmt::format("obstacle = \"barrier {}\"\nroad = \"{}\"\nmetres = {:.2f}\nradius = {}\n{}", things_, exit(leg_of), m(at_m), m(kBarrier), time));
  }
  void unsafe() {
    const std::size_t leg_of = leg();
    event(on_the_way_to(leg_of), fmt::format("unsafe = \"{}\"\nfor = {:.1f}", labyrinth_[route_.crossings[leg_of]].name, s(between(15.0, 60.0))));
    kind("unsafe");
  }

  // ---- class 2
  void obstacle() {
    const std::size_t leg_of = leg();
    const double at_m = between(0.7, length_m(leg_of) - 0.4), radius_m = between(0.05, 0.09), aside_m = between(-0.12, 0.12);
    const RoadId id = route_.exits[leg_of]->road;
    const bool walled = labyrinth_[id].method == "dist";
    const bool stays = random_.chance(0.4f) && (!walled || can_do_without(id));
    if (stays && walled) out_.bans.roads.push_back(id);
    const std::string when = fmt::format("road = \"{}\", metres = {:.2f}", exit(leg_of), m(std::max(0.05, at_m - between(0.6, 1.2))));
    event(when, fmt::format("obstacle = \"crate {}\"\nroad = \"{}\"\nmetres = {:.2f}\naside = {:.2f}\nradius = {:.2f}{}", ++things_, exit(leg_of), m(at_m), m(aside_m),
                            m(radius_m), stays ? "" : fmt::format("\nfor = {:.1f}", s(between(5.0, 40.0)))));
    kind(stays ? "obstacle_stays" : "obstacle");
  }
  /// Somebody stands in the way and after a while walks off the road.
  void walker() {
    const std::size_t leg_of = leg();
    if (road(leg_of).method == "dist") return obstacle();
    const double at_m = between(0.8, length_m(leg_of) - 0.4), side = random_.chance(0.5f) ? 1.0 : -1.0;
    const std::string when = fmt::format("road = \"{}\", metres = {:.2f}", exit(leg_of), m(std::max(0.05, at_m - 0.9)));
    const std::string name = fmt::format("somebody {}", ++things_), place = fmt::format("road = \"{}\"\nmetres = {:.2f}", exit(leg_of), m(at_m));
    const double stays_s = between(1.0, 10.0);
    event(when, fmt::format("obstacle = \"{}\"\n{}\naside = {:.1f}\nradius = {}\nfor = {:.1f}", name, place, m(0.1 * side), m(0.12), s(stays_s + 4.0)));
    event(fmt::format("{}, delay = {:.1f}", when, s(stays_s)), fmt::format("move = \"{}\"\n{}\naside = {:.1f}\nwithin = {:.1f}", name, place, m(0.9 * side), s(3.0)));
    kind("walker");
  }
  /// A trigger somewhere on the route: along a road, or in a crossing. Not where the robot may have arrived: there the command would start
  /// another mission.
  [[nodiscard]] std::string anywhere() {
    const std::size_t leg_of = leg();
    if (random_.chance(0.3f)) return fmt::format("crossing = \"{}\"", labyrinth_[route_.crossings[leg_of]].name);
    const double most_m = leg_of + 1 < route_.exits.size() ? length_m(leg_of) : length_m(leg_of) - kSignRead;
    return fmt::format("road = \"{}\", metres = {:.2f}", exit(leg_of), m(std::min(between(0.1, length_m(leg_of) - 0.1), most_m)));
  }
  void power() {
    const std::string when = anywhere();
    const double off_s = between(2.0, 10.0);
    event(when, fmt::format("power = \"off\"\nfor = {:.1f}", s(off_s)));
    event(fmt::format("{}, delay = {:.1f}", when, s(off_s + 2.0)), "press = \"Go\"");
    kind("power");
  }
  void twice() {
    event(anywhere(), "press = \"Go\"");
    kind("twice");
  }

  // ---- class 3
  void worn(std::size_t leg_of) {
    double from_m = between(0.0, 0.5 * length_m(leg_of)), to_m = std::min(length_m(leg_of), from_m + between(0.3, 1.5));
    event("time = 0", fmt::format("wear = \"{}\"\nfrom = {:.2f}\nto = {:.2f}", exit(leg_of), m(from_m), end_m(leg_of, to_m)));
    kind("worn");
  }
  void tag(std::size_t leg_of, bool wrong) {
    const std::size_t other = below(labyrinth_.crossings.size());
    const CrossingId there = route_.crossings[leg_of + 1];
    const bool ahead = leg_of + 2 < route_.crossings.size() && random_.chance(0.25f);
    const std::string& name = ahead ? labyrinth_[route_.crossings[leg_of + 2]].name : labyrinth_.crossings[other == at(there) ? (other + 1) % labyrinth_.crossings.size() : other].name;
    event("time = 0", fmt::format("tag = \"{}\"\nreads = \"{}\"", approach(leg_of), wrong ? name : "nothing"));
    kind(wrong ? "tag_wrong" : "tag_unreadable");
  }
  void worn_and_unreadable(std::size_t leg_of) {
    event("time = 0", fmt::format("wear = \"{}\"\nfrom = 0.0\nto = {:.2f}", exit(leg_of), end_m(leg_of, length_m(leg_of))));
    tag(leg_of, random_.chance(0.3f));
    kind("worn");
  }
  void kidnap() {
    const std::size_t leg_of = leg();
    const std::string when = fmt::format("road = \"{}\", metres = {:.2f}", exit(leg_of), m(between(0.2, length_m(leg_of) - 0.2)));
    const RoadId to = random_.chance(0.4f) ? route_.exits[leg_of]->road : static_cast<RoadId>(below(labyrinth_.roads.size()));
    const Road& there = labyrinth_[to];
    const bool forward = random_.chance(0.5f);
    event(when, fmt::format("kidnap = {{ road = \"{}.{}\", metres = {:.2f} }}", labyrinth_[forward ? there.from : there.to].name, forward ? there.exit : there.approach,
                            m(between(0.2, there.ends_m - there.begins_m - 0.2))));
    kind(to == route_.exits[leg_of]->road ? "carried_on_road" : "carried");
  }

  const Labyrinth& labyrinth_;
  const mts::Similarity as_;
  const RoutePlan& route_;
  const Labyrinth::End start_;
  Case& out_;
  Random& random_;
  int things_ = 0;
};

/// The `[start]` table: the robot stands on the road of the arm `start` and heads for its crossing.
std::string start_of(const CaseGround& ground) {
  const Road& road = ground.labyrinth[ground.start.arm->road];
  const double road_m = road.ends_m - road.begins_m;
  const bool at_end = !ground.start.arm->forward;
  return fmt::format("[start]\nroad = \"{}.{}\"\nmetres = {:.2f}\n", ground.labyrinth[at_end ? road.from : road.to].name, at_end ? road.exit : road.approach,
                     (road_m - kStartBefore) * static_cast<double>(ground.size));
}

}  // namespace

bool are_kinds_of(Class what, std::string_view kinds) {
  while (!kinds.empty()) {
    const std::size_t plus = kinds.find('+');
    const std::string_view word = kinds.substr(0, plus);
    if (std::none_of(kKindWords.begin(), kKindWords.end(), [&](const KindWord& known) { return known.what == what && known.word == word; })) return false;
    if (plus == std::string_view::npos) return true;
    kinds.remove_prefix(plus + 1);
  }
  return what == Class::kNone;
}

Case draw_case(const CaseGround& ground, Class what, std::uint64_t seed, Random& random) {
  Case out;
  out.what = what;
  out.seed = seed;
  out.scenario = fmt::format("seed = {}\nlimit = {:.0f}\n\n{}\n[[event]]\nwhen = {{ time = 1 }}\npress = \"Go\"\n", seed, ground.limit_s * static_cast<double>(mts::Similarity(ground.size).of("s")), start_of(ground));
  Drawer(ground, out, random).draw(what);
  return out;
}

}  // namespace kb::sim::experiment
