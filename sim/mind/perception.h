// The simulator's own plain perception: turns sensor readings into the facts of the standard library. It knows the floor only by
// what the robot has sensed: readings, and the memories of the tags it has passed.
//
//   Line          four of five line sensors dark over 5 cm of way            Obst    the range finders ahead
//   Track.mark    any line sensor dark     Track.dist  walls on both sides
//   Track.azimuth compass and odometry work, on a road that the memory described, or if nothing else was followed
//   landmarks, Safe, Closed[d], CrossBy[k]    the memory of the tag ahead
//   In[d]         the arm on whose road that tag lies, if by the compass the robot heads for the crossing;
//                 without a tag, or with one of another arm: by the road that it came on, if that ends here
//   Due           by odometry and compass the road ends here, according to the memory of its first landmark
//   Carried       the compass turned and the wheels did not, or the road runs otherwise than the memory says
//   MoveBy[k]     the memory, for the exit taken                Turned  faces back along its road, or has made half a turn
//   Trapped, NoWay    reported by the controller that crosses a hall
//   Blind[s]      line or ranges are silent or stuck; a sign was read, and its stop line did not come
//   Touched       the bumper
// In a hall only `open` can be followed, which needs odometry and range finders; elsewhere `open` cannot be followed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <waymark/controllers/lifted.h>
#include <waymark/controllers/liveness.h>
#include <waymark/controllers/obstacle_sight.h>
#include <waymark/controllers/reckoning.h>
#include <waymark/controllers/senses.h>
#include <waymark/controllers/stop_line.h>
#include "sim/mind/knowledge.h"
#include "sim/mind/road_ahead.h"
#include "sim/robot/sensors.h"
#include "sim/robot_body.h"

namespace kb::sim {

inline constexpr float kSure = 0.9f;

class Perception {
 public:
  /// `body` says where the line sensors sit, and how broad paint is.
  explicit Perception(const FactCells& cells, const mts::Body& body = kRobot) : cells_(&cells), body_(body), line_(body) {}

  /// Every control period, before the controllers. `measured`: the darknesses were computed from a measured line, and may stay
  /// the same for metres although the sensor works.
  void hear(const mts::Senses& senses, const TagHeard& tag, float dt_s, bool measured = false);
  /// A strategy begins to drive (or nothing does). `resumes`: it continues a manoeuvre that an obstacle or a halt had interrupted.
  void begin(const Strategy* strategy, bool resumes = false);
  /// True once if the robot was carried since the strategy began, or the controller was not told all of its road: it must then start afresh.
  [[nodiscard]] bool begins_anew() { return std::exchange(anew_, false); }
  /// The task of a strategy that begins.
  [[nodiscard]] mts::Task task_for(const Strategy& strategy) const;
  /// What the driving controller reports about itself.
  void tell(mts::Plight plight, bool lost) {
    plight_ = plight;
    if (lost && doing_ != nullptr && doing_->doing == Doing::kMove && doing_->method == "azimuth") road_.give_up();
  }
  /// Called every tick before `write`. `rests`: no mission is in hand. See note [at rest].
  void rest(bool rests, float dt_s);
  /// Whether the robot is never carried between two missions: then it keeps its place on a road, or in a crossing.
  void keep_place(bool keeps) { keeps_place_ = keeps; }
  /// An operator places it `along_m` from the landmark of `memory` on the road that leaves by `exit`, in the middle, facing away from it.
  void put(std::shared_ptr<const Memory> memory, std::uint32_t exit, double along_m);
  [[nodiscard]] bool rests() const { return rest_s_ > 0.0f; }
  /// Whether its road leads across a hall, and it is not in a crossing.
  [[nodiscard]] bool in_hall() const;
  /// The road that it is on, by the memory of the road's first landmark; null if unknown.
  [[nodiscard]] const Memory::Exit* road() const { return road_.exit(); }
  /// Whether it is past the stop line of a crossing and not out of it yet: the sign of its exit may have been read already, but not its line.
  [[nodiscard]] bool in_crossing() const { return phase_ == Phase::kInside || crosses_; }
  /// Where it is on that road; nothing in a crossing, or if the road is unknown. On the way round an obstacle at the way out, the road of the exit.
  [[nodiscard]] std::optional<MapPlace> on_road() const { return in_crossing() && !out_awaited_ ? std::nullopt : road_.where(reckoning_.at); }
  /// The end by which it entered the road that it is on; in a crossing, that of the road by which it came, until it is out. Nothing if unknown.
  [[nodiscard]] std::optional<RoadEnd> came_by() const;
  /// How fast it may drive where it is, m/s: see note [where a limit holds]. Infinity if there is no limit.
  [[nodiscard]] float limit_m_s(const SpeedLimits& limits) const;
  /// Writes the facts of a tick. Anything seen since the last tick counts, however briefly.
  void write(std::span<float> facts);
  /// For the sensors `tag` and `memory` of a knowledge base: the landmark's name, and `cross mark`, `move dist`; null: nothing.
  [[nodiscard]] const std::string* tag_text() const;
  [[nodiscard]] const std::string* memory_text();

 private:
  enum class Phase : std::uint8_t { kOnRoad, kApproach, kInside, kLeaving };
  static constexpr std::uint32_t kNoExit = 0xFFFFFFFFu;
  static constexpr float kRoadOff = 0.35f;             // m: farther than this from its middle the road cannot be found
  static constexpr float kReadingLasts = 0.25f;        // s: a reading of a sign fails now and then
  static constexpr float kAside = 0.12f;               // m: farther than this from the middle of a road it has not come back to it
  static constexpr float kAcross = 1.3f;               // rad: turned farther than this it does not drive along a road

  void hear_tag(const TagHeard& tag, float dt_s);
  void hear_line(float dt_s);
  void hear_carried(float dt_s);
  void forget_place();
  void hear_pushed();
  void hear_told();
  void hear_blindness(float dt_s, bool measured);
  void hear_way_without_line(float way_m);
  [[nodiscard]] bool line_missed() const;
  [[nodiscard]] bool compass_leads() const;
  void enter(const Strategy& strategy, bool resumes);
  void set_out();
  [[nodiscard]] std::uint32_t exit_for(const Strategy& strategy) const;
  [[nodiscard]] std::uint32_t leaves_by() const;
  [[nodiscard]] mts::Surroundings surroundings() const;
  [[nodiscard]] float obstacle_certainty() const;
  [[nodiscard]] bool on_track() const;
  void avoid();
  void leave_for_road();
  [[nodiscard]] bool at_way_out() const;
  [[nodiscard]] bool passes_line_out() const;
  [[nodiscard]] bool near_line_behind() const;
  [[nodiscard]] bool back_on_road() const;
  [[nodiscard]] bool line_counts() const;
  [[nodiscard]] bool due() const;
  [[nodiscard]] bool turned_away_from_sign() const;
  [[nodiscard]] bool rounds_to_end() const;
  [[nodiscard]] std::optional<float> way_back_rad() const;
  [[nodiscard]] bool before_middle() const;
  [[nodiscard]] bool come_about() const;
  [[nodiscard]] const std::string* arrival() const;
  void write_landmark(std::span<float> facts) const;
  void write_memory(std::span<float> facts) const;
  void write_tracks(std::span<float> facts) const;
  void put(std::span<float> facts, FactIndex fact, float value) const {
    if (fact != kNoFact) facts[fact] = value;
  }

  const FactCells* cells_;
  mts::Body body_;
  mts::Senses senses_;
  mts::Reckoning reckoning_;
  bool reckons_ = false;
  const Strategy* doing_ = nullptr;
  const Strategy* drove_ = nullptr;          // the last strategy that moves or crosses; one that goes round something, or stands, interrupts it

  // The tag: which landmark it is at, and how.
  bool tag_alive_ = false;
  std::shared_ptr<const Memory> memory_;
  std::uint32_t arm_ = 0, exit_ = kNoExit;   // of the memory: the arm whose road it came on, the exit by which it leaves
  Phase phase_ = Phase::kOnRoad;
  float since_m_ = 0.0f, unread_s_ = 0.0f;   // since the last reading
  float sign_s_ = 0.0f;                      // since the first one, of the same landmark
  float to_line_out_m_ = 0.0f;               // how far it has yet to drive in the crossing
  bool out_told_ = true;                     // the line out of the crossing that it entered last has been seen
  bool crosses_ = false;                     // it has entered a crossing, and has not set out from it yet
  bool met_line_ = false, waits_at_line_ = false, begins_on_road_ = false;   // see note [an order begins at the line]

  RoadAhead road_;                           // as the memory described it when it was entered
  bool guided_ = false;                      // it said nothing, and line or walls were followed: see note [no compass on an untold road]

  // Senses that do not see: see note [a sense that is stuck] in controllers/liveness.h.
  mts::Liveness<mts::kLineSensors> line_sight_;
  mts::Liveness<mts::kRangeFinders> range_sight_;
  bool front_unknown_ = false;
  float turned_rad_ = 0.0f;
  float without_line_m_ = 0.0f;              // since the sign

  // Driving round something: see note [an obstacle on the track].
  bool avoids_ = false;
  bool rounding_ = false;                    // since it began to, and until it follows the road again
  bool avoids_line_ = false;                 // its road had a line when it began to
  bool out_awaited_ = false;                 // see note [an obstacle behind the line out]
  bool pushed_ = false, strayed_ = false;    // see note [pushed aside]
  float clear_s_ = 0.0f;                     // since it was last seen on the track
  float beside_m_ = 0.0f;                    // how far it has yet to follow the road to be in its middle again
  mts::Place avoid_;                         // the track, where it began to

  // Momentary things.
  mts::StopLine line_;
  bool line_seen_ = false;
  mts::ObstacleSight obstacle_sight_;
  bool touched_ = false;
  mts::Lifted lifted_;
  float carried_s_ = 0.0f;                   // how much longer it is reported
  float rest_s_ = 0.0f;                      // without a mission
  bool keeps_place_ = false;
  bool anew_ = false;                        // it was carried since the strategy began, or there is more to tell of its road
  std::size_t told_to_ = 0;                  // the piece of its road on which it is to be told more
  bool set_down_ = false;                    // it was carried, and has not yet entered a crossing since
  float round_rad_ = 0.0f, last_heading_rad_ = 0.0f;
  std::string memory_text_;
  mts::Plight plight_ = mts::Plight::kNone;
};

}  // namespace kb::sim
