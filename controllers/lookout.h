// From the sensors of a robot to the facts of a mind that uses the standard library. It is to perception what `Pilot` is to the wheels:
//
//   mts::Pilot pilot(body);
//   mts::Lookout<errand::Knowledge> lookout(body, errand::landmarks(), errand::find_road);
//   for (;;) {                                                    // each period, 5 to 20 ms
//     lookout.write(facts);                                       // what was perceived since the last tick
//     facts.Go = button;                                          // what only the program knows, after `write`
//     const auto decision = mind.tick(facts, dt);
//     pilot.choose(errand::control_line(decision), errand::road_of_leg(mind));
//     wheels(pilot.step(senses, dt_s));
//     lookout.step(pilot, {.landmark = tag, .exit = side}, dt_s);
//   }
//
// Facts are written by their names, those that the knowledge base has:
//
//   Line          most of a stop line's breadth under the row        Touched        the bumper
//   Obst          something ahead, or on the track                   Blind[s]       line or ranges silent or stuck; no line after a sign
//   Track.mark    paint      Track.dist  walls at both sides         Track.azimuth  compass and odometry, on a known road
//   landmarks, In[d]    the sign ahead; In by the road that ends here if the sign does not say so
//   Safe, Closed[d], CrossBy[k]    the sign ahead                    MoveBy[k]      the map, for the road of the leg
//   Due           the road ends here, by the map                     Turned         faces back along its road
//   Carried       compass and wheels, or compass and map, disagree   Trapped, NoWay the controller that crosses a hall
//
// The drivers of `kbc sim` and `kbc drive` are a lookout and a pilot too.
#pragma once

#include <cstddef>
#include <cstdint>

#include "road_watch.h"

namespace mts {

/// What a reader of tags, or whatever knows places, says now. Texts are read within the call. A landmark that the knowledge base has not got
/// counts as none.
struct Sign {
  const char* landmark = nullptr;   ///< "LM5"; null or "": it reads nothing
  const char* exit = nullptr;       ///< the side of the landmark on whose road the sign lies: "W"; null or "": unknown; then the road tells it, or the compass
  bool safe = true;                 ///< the crossing may be entered
  const char* closed = "";          ///< sides whose roads must not be taken: "E" or "E S"
  const char* cross_by = "mark";    ///< how the crossing can be driven: "mark azimuth"
  bool reader = true;               ///< false: the reader itself is silent, so nothing is known
};

/// The facts that a lookout writes, and the groups of such.
inline constexpr const char* kPerceivedFacts[] = {"Line", "Obst", "Touched", "Due", "Turned", "Carried", "Trapped", "NoWay", "Safe"};
inline constexpr const char* kPerceivedGroups[] = {"Track", "MoveBy", "Blind", "In", "Closed", "CrossBy"};

/// The facts of a compiled knowledge base by their numbers, and its map. A program that knows its knowledge base only at run time gives Lookout
/// a class like this of its own.
template <class Knowledge>
struct FactNames {
  using Facts = typename Knowledge::Facts;
  using Fact = typename Knowledge::Fact;
  /// The road that leaves a landmark by one of its sides; null: there is none.
  using FindRoad = const MapRoad* (*)(const char* landmark, const char* exit);

  [[nodiscard]] static constexpr std::uint32_t count() noexcept { return Knowledge::kShape.facts; }
  /// Text that stays where it is.
  [[nodiscard]] static const char* name_of(std::uint32_t fact) noexcept { return name(static_cast<Fact>(fact)); }
  [[nodiscard]] static float get(const Facts& facts, std::uint32_t fact) noexcept { return facts.get(static_cast<Fact>(fact)); }
  static void set(Facts& facts, std::uint32_t fact, float certainty) noexcept { facts.set(static_cast<Fact>(fact), certainty); }
};

/// No heap; memory as RoadWatch and 80 bytes. One object belongs to one thread at a time; it may be copied.
template <class Knowledge, class Names = FactNames<Knowledge>>
class Lookout {
 public:
  using Facts = typename Names::Facts;
  using FindRoad = typename Names::FindRoad;

  /// `body`: the pilot's. `landmarks`: of the generated header of the map; only these can be read from signs. `find_road`: of the same header; null:
  /// the first crossing of a mission counts as one of roads at right angles. Looks up names: O(facts).
  explicit Lookout(const Body& body, const FactRuns& landmarks, FindRoad find_road = nullptr, Names names = {}) noexcept
      : names_(names), watch_(body, find("Carried") != kNone), landmarks_(landmarks), find_road_(find_road) {
    for (std::size_t i = 0; i < kGroups; ++i) groups_[i] = find_group(kPerceivedGroups[i]);
    for (std::size_t i = 0; i < kSingles; ++i) singles_[i] = find(kPerceivedFacts[i]);
  }

  /// Each period, after the pilot's `step`. `measured`: the darknesses were computed from a measured line, and may stay the same for metres although
  /// the sensor works. A robot that was carried, or to which nothing was told for two seconds, has its pilot forget
  /// the place. O(range finders times pieces of the road); O(facts) where another sign is read.
  void step(Pilot& pilot, const Sign& sign, float dt_s, bool measured = false) noexcept {
    const SignRead* const read = take(sign);
    reader_ = sign.reader;
    watch_.step(pilot, read, dt_s, measured);
    if (!find_road_) return;
    if (approaches()) tell_arrival(pilot, watch_.sign().landmark, side_from());
    tell_way_back(pilot);
    if (!watch_.moves() || pilot.place().road() != nullptr) return;
    if (const MapRoad* road = way_out()) pilot.learn_road(*road);
  }
  /// Before each tick: writes the facts that the knowledge base has. Others keep their values.
  void write(Facts& facts) noexcept {
    write_singles(facts);
    write_sign(facts);
    write_group(facts, kTrack, [&](const char* by) { return watch_.track(by); });
    const MapRoad* const out = way_out();
    const char* const move_by = out != nullptr ? out->by : watch_.move_by();
    write_group(facts, kMoveBy, [&](const char* by) { return move_by[0] == '\0' ? 0.0f : RoadWatch::sure(same_text(by, move_by)); });
    write_group(facts, kBlind, [&](const char* sense) { return same_text(sense, "line") ? watch_.line_blind() : same_text(sense, "ranges") ? watch_.ranges_blind() : 0.0f; });
    watch_.forget_moments();
  }
  /// Whether the robot is never carried between two missions: then it keeps its place on its road when nothing was told to it for two seconds.
  void keep_place(bool keeps) noexcept { watch_.keep_place(keeps); }
  /// The robot may be anywhere: it is driven or carried by hand. Only the sign that it reads now still counts. To be called each period meanwhile.
  void forget_place(Pilot& pilot) noexcept { watch_.forget(pilot); }
  /// Whether the knowledge base has this landmark.
  [[nodiscard]] bool knows(const char* landmark) const noexcept { return find_landmark(landmark) != kNone; }
  [[nodiscard]] const RoadWatch& watch() const noexcept { return watch_; }

 private:
  using Index = std::uint32_t;
  static constexpr Index kNone = 0xFFFFFFFFu;
  struct Group {
    Index first = 0, count = 0;
    std::uint8_t prefix = 0;   ///< letters before the name of a member: 3 in "In.N"
  };
  enum GroupId : std::size_t { kTrack, kMoveBy, kBlind, kIn, kClosed, kCrossBy, kGroups };   // of kPerceivedGroups, in this order
  enum SingleId : std::size_t { kLine, kObst, kTouched, kDue, kTurned, kCarried, kTrapped, kNoWay, kSafe, kSingles };   // of kPerceivedFacts
  static_assert(sizeof kPerceivedGroups / sizeof kPerceivedGroups[0] == kGroups && sizeof kPerceivedFacts / sizeof kPerceivedFacts[0] == kSingles);

  [[nodiscard]] const char* name_of(Index fact) const noexcept { return names_.name_of(fact); }
  [[nodiscard]] Index find(const char* text) const noexcept {
    for (Index f = 0; f < names_.count(); ++f) {
      if (same_text(name_of(f), text)) return f;
    }
    return kNone;
  }
  [[nodiscard]] Index find_landmark(const char* text) const noexcept {
    for (std::size_t i = 0; i < landmarks_.count; ++i) {
      for (Index k = 0; k < landmarks_.runs[i].count; ++k) {
        if (same_text(name_of(landmarks_.runs[i].first + k), text)) return landmarks_.runs[i].first + k;
      }
    }
    return kNone;
  }
  /// The letters of `group` and its point, if `text` is that of a member; 0 otherwise.
  [[nodiscard]] static std::uint8_t prefix_of(const char* text, const char* group) noexcept {
    std::uint8_t i = 0;
    for (; group[i] != '\0'; ++i) {
      if (text[i] != group[i]) return 0;
    }
    return text[i] == '.' ? static_cast<std::uint8_t>(i + 1) : std::uint8_t{0};
  }
  [[nodiscard]] Group find_group(const char* group) const noexcept {
    Group found;
    for (Index f = 0; f < names_.count(); ++f) {
      const std::uint8_t prefix = prefix_of(name_of(f), group);
      if (prefix == 0) continue;
      if (found.count == 0) found = {f, 0, prefix};
      ++found.count;   // members stand beside each other
    }
    return found;
  }
  [[nodiscard]] const char* member(GroupId group, Index i) const noexcept { return name_of(groups_[group].first + i) + groups_[group].prefix; }
  /// The knowledge base's own text of a member's name; "" if it has none such.
  [[nodiscard]] const char* find_member(GroupId group, const char* text) const noexcept {
    for (Index i = 0; text != nullptr && i < groups_[group].count; ++i) {
      if (same_text(member(group, i), text)) return member(group, i);
    }
    return "";
  }

  void put(Facts& facts, Index fact, float certainty) const noexcept {
    if (fact == kNone || names_.get(facts, fact) == certainty) return;   // what does not change costs the mind nothing
    names_.set(facts, fact, certainty);
  }
  template <class Certainty>
  void write_group(Facts& facts, GroupId group, Certainty&& certainty) const noexcept {
    for (Index i = 0; i < groups_[group].count; ++i) put(facts, groups_[group].first + i, certainty(member(group, i)));
  }
  void write_singles(Facts& facts) const noexcept {
    const float values[kSingles] = {watch_.line(),    watch_.obstacle(), watch_.touched(), watch_.due(), watch_.turned(), watch_.carried(),
                                    watch_.trapped(), watch_.no_way(),   0.0f};
    for (std::size_t i = 0; i < kSafe; ++i) put(facts, singles_[i], values[i]);
  }
  void write_sign(Facts& facts) noexcept {
    const SignRead& sign = watch_.sign();
    const Index landmark = watch_.landmark()[0] == '\0' ? kNone : sign.fact;
    const float nothing = reader_ ? -RoadWatch::kSure : 0.0f;
    if (nothing_ != nothing) {
      for (std::size_t i = 0; i < landmarks_.count; ++i) {
        for (Index k = 0; k < landmarks_.runs[i].count; ++k) put(facts, landmarks_.runs[i].first + k, nothing);
      }
    } else if (written_ != landmark) {
      put(facts, written_, nothing);
    }
    put(facts, landmark, watch_.landmark_certainty());
    written_ = landmark;
    nothing_ = nothing;
    put(facts, singles_[kSafe], approaches() ? RoadWatch::sure(sign.safe) : 0.0f);
    const char* const in = side_from();
    write_group(facts, kIn, [&](const char* side) { return in[0] == '\0' ? 0.0f : RoadWatch::sure(same_text(side, in)); });
    write_bits(facts, kClosed, approaches(), sign.closed);
    write_bits(facts, kCrossBy, approaches(), sign.cross_by);
  }
  void write_bits(Facts& facts, GroupId group, bool known, std::uint64_t bits) const noexcept {
    for (Index i = 0; i < groups_[group].count; ++i) put(facts, groups_[group].first + i, known && i < 64 ? RoadWatch::sure((bits >> (i & 63u) & 1u) != 0) : 0.0f);
  }

  void tell_arrival(Pilot& pilot, const char* landmark, const char* side) noexcept {
    if (landmark == to_ && side == from_) return;
    to_ = landmark;
    from_ = side;
    pilot.arrives_from(side[0] == '\0' ? nullptr : find_road_(landmark, side));
  }
  void tell_way_back(Pilot& pilot) noexcept {
    const MapRoad* const road = pilot.place().road();
    if (road == there_) return;
    there_ = road;
    pilot.can_turn_back(road == nullptr ? nullptr : find_road_(road->to, road->approach));
  }
  /// The road on which the sign lies that the robot leaves behind; null: it leaves none behind, or not known.
  [[nodiscard]] const MapRoad* way_out() const noexcept {
    if (!find_road_ || watch_.at() != RoadWatch::At::kLeaving || watch_.sign().landmark[0] == '\0' || watch_.sign().exit[0] == '\0') return nullptr;
    return find_road_(watch_.sign().landmark, watch_.sign().exit);
  }
  [[nodiscard]] bool approaches() const noexcept { return watch_.at() == RoadWatch::At::kApproach; }
  /// The side from which the robot comes to a crossing; "" if it does not, or nobody knows.
  [[nodiscard]] const char* side_from() const noexcept { return approaches() && watch_.arrives_by()[0] == '\0' ? side_behind() : watch_.arrives_by(); }
  /// The side of the landmark from which the robot came to the sign, by its compass; "" if it has none, or none leads there.
  [[nodiscard]] const char* side_behind() const noexcept {
    const char* best = "";
    float came_rad = 0.0f, nearest_rad = 0.25f * kPi, side_rad = 0.0f;
    if (!watch_.came(came_rad)) return best;
    for (Index i = 0; i < groups_[kIn].count; ++i) {
      if (!compass_point(member(kIn, i), side_rad)) continue;
      const float off_rad = magnitude(wrapped_angle(came_rad + kPi - side_rad));
      if (off_rad < nearest_rad) nearest_rad = off_rad, best = member(kIn, i);
    }
    return best;
  }
  /// The sign in names of the knowledge base; null: nothing is read.
  [[nodiscard]] const SignRead* take(const Sign& sign) noexcept {
    if (sign.landmark == nullptr || sign.landmark[0] == '\0') return nullptr;
    if (read_.landmark[0] == '\0' || !same_text(read_.landmark, sign.landmark)) read_.fact = find_landmark(sign.landmark);
    read_.landmark = read_.fact == kNone ? "" : name_of(read_.fact);
    if (read_.fact == kNone) return nullptr;
    read_.exit = find_member(kIn, sign.exit);
    read_.exit_rad_known = compass_point(read_.exit, read_.exit_rad);
    read_.safe = sign.safe;
    read_.closed = words(kClosed, sign.closed);
    read_.cross_by = words(kCrossBy, sign.cross_by);
    return &read_;
  }
  /// Which members of a group a text names that has blanks between them.
  [[nodiscard]] std::uint64_t words(GroupId group, const char* text) const noexcept {
    std::uint64_t bits = 0;
    for (const char* word = text; word != nullptr && *word != '\0';) {
      std::size_t length = 0;
      while (word[length] != '\0' && word[length] != ' ') ++length;
      for (Index i = 0; i < groups_[group].count && i < 64; ++i) {
        const char* const is = member(group, i);
        std::size_t same = 0;
        while (same < length && is[same] == word[same]) ++same;
        if (same == length && is[length] == '\0') bits |= std::uint64_t{1} << i;
      }
      word += length;
      while (*word == ' ') ++word;
    }
    return bits;
  }
  /// The direction of a point of the compass: "N", "SE".
  [[nodiscard]] static bool compass_point(const char* text, float& direction_rad) noexcept {
    constexpr const char* kPoints[] = {"E", "NE", "N", "NW", "W", "SW", "S", "SE"};
    for (std::size_t i = 0; i < 8; ++i) {
      if (!same_text(kPoints[i], text)) continue;
      direction_rad = wrapped_angle(static_cast<float>(i) * 0.25f * kPi);
      return true;
    }
    return false;
  }

  [[no_unique_address]] Names names_;
  RoadWatch watch_;
  FactRuns landmarks_;
  FindRoad find_road_;
  const MapRoad* there_ = nullptr;               // the road whose way back the pilot was told
  const char *to_ = nullptr, *from_ = nullptr;   // the landmark, and the side from which the pilot was told that the robot comes to it
  Group groups_[kGroups];
  Index singles_[kSingles] = {};
  SignRead read_;
  Index written_ = kNone;   // the landmark
  float nothing_ = 0.0f;    // what the others were told to be
  bool reader_ = true;
};

}  // namespace mts
