// A knowledge base at the wheel of any robot: lines with senses in, lines with wheel speeds out.
//
// note [when the mind ticks]
// The mind ticks at multiples of `dt`. A tick takes place when the first later line comes, before that line is heard: with the senses and
// readings of the line before, and the buttons and facts of all lines since the last tick, including this one. If a host is slower than `dt`, there is one
// tick for each line, as long as the time since the last one.
//
// note [a host that was away]
// A line more than `pause` after the one before brings fresh senses, but perception, controllers and rules remember old ones, and people
// beside the robot do not expect it to set off. So it stands (`waits`), hears its senses and does not tick, until a button is pressed that
// was not pressed in the line before. The simulator does the same after a power cut. The mind must learn which button it was before the
// wheels turn, since `Abort` is a button too. While it waits, `Abort` given as a fact is heard as well; other facts are not.
//
// note [a refused line that stops]
// A line that cannot be used changes nothing, since nobody knows which part of it is wrong. But a person who presses `Abort` while the lines
// are refused, for the sign of a neighbour or a compass that is out of order, must not have pressed in vain. So `Abort` and `Pause` of such a
// line count on the next tick, as if the next line that is understood had named them. `Abort` ends a waiting as well.
//
// note [a clock that leaps]
// A line whose `t` lies far ahead is taken to come after a pause. A line not later than the one before is refused. If the line after
// that continues from it, by at most `pause`, time goes on there: either the far `t` alone was wrong and there was no pause, if it is at
// most a pause after the line before the leap, or the clock was set back, if it lies more than a pause back, which is treated as a pause. One line
// alone proves nothing: it may have been sent before the pause and have come late, and the wheels must not turn on senses that old. The
// exchange ticks by a clock of its own, which is never set back.
//
// note [a line that comes twice]
// Some links deliver a line twice. The same bytes as in the line before are answered as that was, and change nothing. A third time they are
// refused, as not later: a host that hangs and repeats itself must not drive.
//
// note [another mind between two lines]
// The source of missions (orders of a fleet's master) gives the exchange another knowledge base between two lines, presses its own buttons,
// and can hold the robot: it then stands as in a pause, but goes on by itself when released. Perception and controllers notice nothing.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/mind/driver.h"
#include "sim/scenario/scenario.h"
#include "sim/world/floor.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/wire/answer.h"
#include "tools/kbc/wire/line.h"
#include "tools/kbc/wire/near_zero.h"
#include "tools/kbc/wire/own_sensors.h"

namespace kb::wire {

inline constexpr std::int64_t kPauseUs = 500'000;   ///< the default pause: see note [a host that was away]

struct ExchangeOptions {
  std::uint32_t dt_us = 100'000;
  std::int64_t pause_us = kPauseUs;
  bool has_master = false;   ///< a fleet's master hears what the robot says of itself and of its actions
  /// Called with each tick, its line as `kbc run --trace` writes it, and the facts that it was given.
  std::function<void(const program::Tick& tick, std::string_view json, std::span<const float> facts)> on_tick{};
};

class Exchange {
 public:
  /// All must outlive it. Only the body, the range finders and the methods of crossings of `robot` are used.
  Exchange(const sim::Knowledge& knowledge, const sim::Labyrinth& labyrinth, const sim::Scenario& robot, ExchangeOptions options);

  /// The answer to one line, without line break. `number`: the number of the line, from 1. Never throws because of its contents. A line longer
  /// than `kLongestLine` is a mistake, so its beginning is enough. See note [a line that comes twice].
  [[nodiscard]] std::string answer(std::string_view text, std::uint64_t number);
  /// Takes another knowledge base from the next tick on: see sim::can_take, which must hold for it and the first one; see
  /// note [another mind between two lines]. It must outlive the exchange, and so must the first one; those between need not.
  void take(const sim::Knowledge& next);
  /// Presses a button of the program's own on the next tick.
  void press(program::CellId fact) { pressed_.push_back(fact); }
  /// Holds the robot from the next line on, or releases it. While held it stands, and the mind does not tick. Released, it stands until the
  /// mind has ticked, since what it did before need no longer be right.
  void hold(bool holds) {
    clock_.wakes = clock_.wakes || (holds_ && !holds);
    holds_ = holds;
  }
  /// Whether the robot is never carried between two missions: see sim::Driver::keep_place.
  void keep_place(bool keeps) { driver_.keep_place(keeps); }
  /// The robot may be anywhere, since the last line: see sim::Driver::forget_place.
  void forget_place() { driver_.forget_place(); }
  /// Puts the robot on the road that leaves `landmark` by `exit`, `along_m` of the floor from it, facing away. Both must exist on the floor.
  void put(std::string_view landmark, std::string_view exit, double along_m);
  [[nodiscard]] const sim::Driver& driver() const { return driver_; }
  /// Whether it stands until a button is pressed: see note [a host that was away].
  [[nodiscard]] bool waits() const { return clock_.waits; }
  /// What the host is to do besides driving, in each answer from the next one on.
  void set_actions(std::vector<vda5050::HostAction> actions);
  /// The line answered last; nothing if it was not understood, or came for the second time.
  [[nodiscard]] const std::optional<Line>& line() const { return line_; }
  /// The time of that line by the host's clock, as if that had never been set back; that of the line before while its `t` may be wrong.
  [[nodiscard]] std::int64_t now_us() const { return leapt_from_ ? leapt_from_->t_us : clock_.t_us; }
  /// Seconds from the line before to that one; for the first line, and after a pause, one control period.
  [[nodiscard]] float period_s() const { return period_s_; }
  /// The wheel speeds in the answer to that line.
  [[nodiscard]] mts::Motion wheels() const { return wheels_; }
  /// The mistake in that line. Such a line changes nothing, except that the wheels stand; but see note [a refused line that stops].
  [[nodiscard]] const std::optional<Mistake>& mistake() const { return mistake_; }
  /// A warning with that line, which was understood: about the clock, or, once for each name, of something that is not meant so or that
  /// nobody hears.
  [[nodiscard]] const std::optional<Mistake>& warning() const { return warning_; }

 private:
  /// The time, and state that depends on it.
  struct Clock {
    std::int64_t t_us = 0, next_us = 0;      // time of the line before; time of the next tick
    std::optional<std::int64_t> ticked_us;   // the last tick; nothing: none since it waited
    bool waits = false;
    bool wakes = false;                      // its waiting is over, or it was released, and the mind has not ticked yet
  };

  [[nodiscard]] std::optional<Mistake> take(std::string_view text, Answer& answer);
  [[nodiscard]] std::optional<Mistake> follow_clock(const Line& line, bool& set_back);
  void warn_of_what_is_odd(const Line& line);
  void warn_of_what_nobody_hears(const Line& line);
  [[nodiscard]] bool was_said(std::string what);
  void remember_given(const std::string& id);
  void count_from_near(Line& line);
  void hear_stops(std::string_view text);
  void hear_buttons(bool away);
  void hear_sensors(std::int64_t t_us);
  [[nodiscard]] std::optional<Mistake> look_up(const Line& line);
  [[nodiscard]] std::optional<Mistake> look_up_tag(const Tag& tag);
  [[nodiscard]] std::optional<Mistake> look_up_fact(const Name& name, std::string_view field, program::CellId& cell) const;
  [[nodiscard]] bool rests() const { return clock_.waits || holds_; }
  [[nodiscard]] bool stands() const { return rests() || clock_.wakes; }
  void forget_said() { pressed_.clear(), told_.clear(); }
  void tick_before(std::int64_t t_us, Answer& answer);
  void tell(Answer& answer) const;

  const sim::Knowledge* knowledge_;
  const program::CellId abort_, pause_;              // kNone: there is none; facts are the same in all knowledge bases taken
  const sim::Labyrinth& labyrinth_;
  ExchangeOptions options_;
  sim::Floor floor_;
  mts::Body body_;
  sim::Driver driver_;
  trace::CellNames names_;
  OwnSensors sensors_;
  std::optional<Mistake> mistake_, warning_;
  std::optional<Line> line_;
  std::vector<vda5050::HostAction> actions_;
  std::set<std::string, std::less<>> given_;         // the ids of actions that were in an answer, or that were warned of
  std::deque<std::string> given_in_turn_;            // the same, oldest first
  bool warned_of_master_ = false;
  std::set<std::string, std::less<>> said_once_;     // of what is odd
  std::string text_, answer_;                        // of the last line, if it was understood and has come once

  // The names of the present line, looked up.
  sim::TagHeard tag_;
  std::vector<program::CellId> buttons_;
  std::vector<std::pair<program::CellId, std::optional<float>>> said_;
  std::vector<OwnSensors::Heard> heard_;

  // See note [a clock that leaps].
  Clock clock_;
  std::optional<Clock> leapt_from_;                  // the clock before the last line that was understood, if that came after a pause
  std::optional<std::int64_t> refused_us_;           // `t` of the last line, if it was not later than the one before
  std::int64_t offset_us_ = 0;                       // from our own clock to the host's
  int pauses_ = 0;                                   // how many lines in a row, up to the last, came after a pause

  NearZero x_, y_;                                   // of odometry

  float period_s_ = 0.0f;
  mts::Motion wheels_;
  bool began_ = false, holds_ = false;
  std::vector<program::CellId> held_;                // pressed in the line before
  std::vector<program::CellId> pressed_;             // since the last tick
  std::vector<program::CellId> stops_;               // since the last line that was understood: see note [a refused line that stops]
  std::map<program::CellId, float> told_;            // facts given by the host
};

}  // namespace kb::wire
