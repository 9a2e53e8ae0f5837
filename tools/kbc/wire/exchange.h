// A knowledge base at the wheel of any robot: lines with senses in, lines with wheel speeds out.
//
// note [when the mind ticks]
// The mind ticks at multiples of `dt`. The tick of a time takes place when the first line comes that is later, before that line is
// heard: with the senses of the line before, and the buttons and facts of all lines since the last tick, this one among them. Where a host
// is slower than `dt` there is one tick for a line, and it is as long as what has passed since the last one.
//
// note [a host that was away]
// A line that comes more than `pause` after the one before brings senses that are fresh, but what perception, controllers and rules
// remember is old, and nobody who stands beside the robot expects it to set off. So it stands (`waits`), hears its senses and does not tick, until a
// button is pressed that was not pressed in the line before. The simulator does the same after a power cut. Which button it was the mind says: the
// wheels stand until it has heard it, since `Abort` is one. That one is heard as a fact as well, other facts are not.
//
// note [a clock that leaps]
// A line whose `t` lies far ahead comes after a pause, as far as anybody can know. If the next one goes on from before it, that one `t` was wrong, and
// there was no pause. A line that is not later than the one before is refused; if it lies more than a pause back, and the next one goes on from there,
// the clock was set back, and it is as after a pause. What ticks here has a clock of its own, which is never set back.
//
// note [another mind between two lines]
// Who deals out missions (an order of a fleet's master) gives the exchange another knowledge base between two lines, presses buttons of his own, and
// holds the robot: it stands as in a pause, but goes on by itself when it is let go. Perception and controllers notice nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
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

namespace kb::wire {

inline constexpr std::int64_t kPauseUs = 500'000;   ///< the usual pause: see note [a host that was away]

struct ExchangeOptions {
  std::uint32_t dt_us = 100'000;
  std::int64_t pause_us = kPauseUs;
  /// Told of each tick, as `kbc run --trace` writes it too, and of the facts that it was told.
  std::function<void(const program::Tick& tick, std::string_view json, std::span<const float> facts)> on_tick{};
};

class Exchange {
 public:
  /// All must outlive it. `robot`: its body, its range finders and how crossings can be driven; nothing else of it counts.
  Exchange(const sim::Knowledge& knowledge, const sim::Labyrinth& labyrinth, const sim::Scenario& robot, ExchangeOptions options);

  /// The answer to one line, without line break. `number`: which line it is, from 1. Never throws for what stands in a line.
  [[nodiscard]] std::string answer(std::string_view text, std::uint64_t number);
  /// Another knowledge base from the next tick on: see sim::can_take, which must hold for it and the first one; see note [another mind between two lines].
  /// It must outlive the exchange, as the first one must; those between need not.
  void take(const sim::Knowledge& next);
  /// A button of the program's own, on the next tick.
  void press(program::CellId fact) { pressed_.push_back(fact); }
  /// From the next line on it stands and the mind does not tick, until it is let go.
  void hold(bool holds) { holds_ = holds; }
  /// Whether nobody carries the robot between two missions: see sim::Perception::keep_place.
  void keep_place(bool keeps) { driver_.keep_place(keeps); }
  /// The robot stands on the road that leaves `landmark` by `exit`, `along_m` of the floor from it, facing away from it. They are on the floor.
  void put(std::string_view landmark, std::string_view exit, double along_m);
  [[nodiscard]] const sim::Driver& driver() const { return driver_; }
  /// It stands until a button is pressed: see note [a host that was away].
  [[nodiscard]] bool waits() const { return clock_.waits; }
  /// What the host is to do besides driving, in each answer from the next one on.
  void set_actions(std::vector<Action> actions) { actions_ = std::move(actions); }
  /// The line that was answered last, as far as it was understood; nothing: it was not.
  [[nodiscard]] const std::optional<Line>& line() const { return line_; }
  /// When that line came, by the host's clock, had it never been set back; as long as that may be a wrong `t`, when the line before came.
  [[nodiscard]] std::int64_t now_us() const { return leapt_from_ ? leapt_from_->t_us : clock_.t_us; }
  /// s from the line before it to that one; of the first one, and of one after a pause, a period of control.
  [[nodiscard]] float period_s() const { return period_s_; }
  /// What the wheels were told in answer to that line.
  [[nodiscard]] mts::Motion wheels() const { return wheels_; }
  /// What was wrong with that line. Such a line changes nothing but that the wheels stand.
  [[nodiscard]] const std::optional<Mistake>& mistake() const { return mistake_; }
  /// What is to be told of the clock with that line, which was understood.
  [[nodiscard]] const std::optional<Mistake>& warning() const { return warning_; }

 private:
  /// When it is, and what follows from that.
  struct Clock {
    std::int64_t t_us = 0, next_us = 0;      // of the line before; of the next tick
    std::optional<std::int64_t> ticked_us;   // the last tick; nothing: none since it waited
    bool waits = false;
    bool wakes = false;                      // a button has ended its waiting, and the mind has not heard it yet
  };

  [[nodiscard]] std::optional<Mistake> take(std::string_view text, Answer& answer);
  [[nodiscard]] std::optional<Mistake> follow_clock(const Line& line, bool& set_back);
  void hear_buttons(bool away);
  [[nodiscard]] std::optional<Mistake> look_up(const Line& line);
  [[nodiscard]] std::optional<Mistake> look_up_tag(const Tag& tag);
  [[nodiscard]] std::optional<Mistake> look_up_fact(const Name& name, std::string_view field, program::CellId& cell) const;
  [[nodiscard]] bool rests() const { return clock_.waits || holds_; }
  [[nodiscard]] bool stands() const { return rests() || clock_.wakes; }
  void forget_said() { pressed_.clear(), told_.clear(); }
  void tick_before(std::int64_t t_us, Answer& answer);
  void tell(Answer& answer) const;

  const sim::Knowledge* knowledge_;
  const program::CellId abort_;                      // kNone: there is no such button; facts are the same in all knowledge bases that are taken
  const sim::Labyrinth& labyrinth_;
  ExchangeOptions options_;
  sim::Floor floor_;
  mts::Body body_;
  sim::Driver driver_;
  trace::CellNames names_;
  std::optional<Mistake> mistake_, warning_;
  std::optional<Line> line_;
  std::vector<Action> actions_;

  // Of the line that is read, looked up.
  sim::TagHeard tag_;
  std::vector<program::CellId> buttons_;
  std::vector<std::pair<program::CellId, std::optional<float>>> said_;

  // See note [a clock that leaps].
  Clock clock_;
  std::optional<Clock> leapt_from_;                  // before the last line, if that came after a pause
  std::optional<std::int64_t> refused_us_;           // `t` of the last line, if it was not later than the one before
  std::int64_t offset_us_ = 0;                       // of our own clock, to the host's
  int pauses_ = 0;                                   // before each of so many lines, up to the last one

  float period_s_ = 0.0f;
  mts::Motion wheels_;
  bool began_ = false, holds_ = false;
  std::vector<program::CellId> held_;                // pressed in the line before
  std::vector<program::CellId> pressed_;             // since the last tick
  std::map<program::CellId, float> told_;            // what the host says
};

}  // namespace kb::wire
