// The judge sees the truth: where the robot really is, what it hit, and whether it knows where it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/source/source.h"
#include "sim/mind/knowledge.h"
#include "sim/robot/body.h"
#include "sim/world/floor.h"

namespace kb::sim {

/// m, times the floor's size: a robot this near is at a landmark, and a believed place this near is right.
inline constexpr double kAtLandmark = 1.3;

/// Where something is on the floor.
struct Whereabouts {
  CrossingId crossing = CrossingId::kNone;   ///< inside this crossing
  RoadId road = RoadId::kNone;               ///< or on this road
  double along_m = 0.0;                      ///< from the stop line of the road's first landmark
  double aside_m = 0.0;                      ///< from the middle of the road
};
[[nodiscard]] Whereabouts locate(const Labyrinth& labyrinth, Spot spot);
/// Whether a robot at `spot` is at the landmark: within `kAtLandmark`, or farther if the stop line in that direction lies farther out.
[[nodiscard]] bool is_at(const Labyrinth& labyrinth, CrossingId crossing, Spot spot);

/// How a drive ended, and what happened in it.
struct Summary {
  enum class Outcome : std::uint8_t {
    kArrived,         ///< the mission ended, at the landmark where it had to
    kAstray,          ///< the mission ended, and the robot is somewhere else
    kAborted,
    kGivenUp,         ///< a rule ended the mission before it had come to its last landmark
    kStopped,         ///< it stands and has reported why
    kStuck,           ///< it stands and has not reported why
    kTimeUp,          ///< time was up while it still drove
    kNeverStarted,
  } outcome = Outcome::kNeverStarted;
  std::string landmark;                      ///< kArrived, kAstray: the last one of the route; kGivenUp: the one it was on the way to
  std::vector<std::string> reports;          ///< `Help.lost`: reported when it ended
  std::vector<std::string> outputs;          ///< the satellites declared `output` that were high when it ended; none of a driver of another program
  std::string running;                       ///< the strategy that drove when it ended; empty: none
  double time_s = 0.0;                       ///< from the first press of a command that was obeyed until the end
  double last_moved_s = 0.0;                 ///< when its wheels last turned, counted as time_s; the rest of that it stood and waited
  double length_m = 0.0;                     ///< driven, in truth
  std::vector<std::string> way;              ///< `LM5.W`: the crossings left, and by which exit
  struct Contact { double t_s = 0.0; std::string what; Spot at; double speed_m_s = 0.0; };   ///< the speed at which they came together
  std::vector<Contact> collisions;           ///< what the robot ran into, or what ran into it while it drove
  std::vector<Contact> standing_contacts;    ///< what ran into it while it stood
  double touched_s = 0.0;                    ///< how long it touched something, driving or standing
  struct Approach { double gap_m = 0.0; double t_s = 0.0; std::string what; };
  std::optional<Approach> closest;           ///< the least gap to an obstacle of the scenario; nothing if none stood
  struct Fault {
    enum class Ban : std::uint8_t { kClosedRoad, kUnsafeCrossing } broken{};
    std::string what;                        ///< `took the closed road LM7.E`, closed since before it entered the crossing; `entered LM3, which was not safe`
  };
  std::vector<Fault> faults;
  struct Missed { std::string what; source::Span at; };
  std::vector<Missed> missed;                ///< events of the scenario that never happened, and where they are written
  double unaware_s = 0.0;                    ///< how long it drove elsewhere than it believed, without reporting it
  int mistaken_crossings = 0;                ///< crossings that it drove over while taking them for others
  std::uint64_t ticks = 0;

  /// Whether it took a crossing for another and drove over it, drove elsewhere than it believed for longer than any road takes, or
  /// wrongly believes it has arrived.
  [[nodiscard]] bool lost_unaware() const;
  /// The greatest speed at which the robot and something else came together; 0 if nothing did.
  [[nodiscard]] double impact_m_s() const;
};
/// `arrived at LM15`, `believes to be at LM15, and is not`, `stopped: Help.blocked`, ...
[[nodiscard]] std::string describe(const Summary& summary);

class Judge {
 public:
  explicit Judge(const Labyrinth& labyrinth) : labyrinth_(labyrinth) {}

  /// What the mind believes after a tick.
  struct Belief {
    const Leg* leg = nullptr;       ///< the current one
    const Strategy* strategy = nullptr;
    bool reports = false;           ///< some `Help` is high
    bool driving = false;           ///< a strategy runs that follows a road or a crossing
    std::optional<Spot> place{};    ///< for a helm that reckons in coordinates instead of legs: where it believes it is
  };
  void look(const Pose& pose, const Floor& floor, const Belief& belief, double dt_s);
  void hit(const Hit& hit, double t_s, bool stood);
  /// Called after each step of the body: notices what stands near it, and whether it touches something.
  void feel(const Arena& arena, double t_s, double dt_s);
  [[nodiscard]] const Whereabouts& where() const { return where_; }
  /// The robot was carried away: that way is not counted, and the next look finds where it is.
  void carried(const Pose& pose);

  Summary summary;

 private:
  void follow_crossings(const Floor& floor);
  void enter(CrossingId crossing, const Floor& floor);
  [[nodiscard]] bool believes_rightly(const Leg& leg) const;
  void fault(Summary::Fault::Ban broken, std::string what);

  const Labyrinth& labyrinth_;
  Whereabouts where_;
  Spot last_;
  bool looked_ = false;
  CrossingId mistaken_ = CrossingId::kNone;  // the crossing that it drives over and takes for another
  CrossingId inside_ = CrossingId::kNone;    // the crossing that it is in, or was in last
  std::vector<RoadId> closed_;               // those of its roads that were closed when it came in: nobody tells it what happens meanwhile
  const Leg* leg_ = nullptr;
  const Leg* leg_before_ = nullptr;
};

}  // namespace kb::sim
