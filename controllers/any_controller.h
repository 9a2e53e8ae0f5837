// A controller chosen by name at run time, in a fixed amount of memory.
//
//   const mts::ControllerEntry* entry = mts::find_controller(name);
//   if (entry == nullptr) ...                                    // there is none of that name
//   mts::AnyController drive;
//   drive.choose(entry->id, body);
//   if (drive.set_word("side", "right") != mts::Setting::kSet) ...
//   if (drive.set("distance", 0.2f) != mts::Setting::kSet) ...
//   drive.start(task, senses);
//   for (;;) wheels(drive.step(senses, dt_s));
#pragma once

#include <new>

#include "registry.h"

namespace mts {

enum class Setting : std::uint8_t {
  kSet,
  kUnknown,      ///< the controller has no such parameter
  kOutside,      ///< below `lowest` or above `highest` for its body, between two words, or NaN; nothing was set
};

/// One of all controllers; `stand` until one is chosen. As large as the largest of them, at most 6,000 bytes; no heap. It may be copied: the
/// copy goes on from the same state, with the same `Host::self`. One object belongs to one thread at a time.
class AnyController {
 public:
  AnyController() noexcept : stand_{} {}

  /// Switches to another controller, for this body; parameters set earlier are lost. Each has its default, or if the body does not allow
  /// that (see `lowest` and `highest`) the value nearest to it. Call `start` before `step`.
  /// `host` serves controllers that need a planner or rules. Without it they stand, and `plight()` reports kNoWay. It is copied; what its
  /// `self` points to must live as long as this controller is stepped.
  void choose(ControllerId id, const Body& body = {}, const Host& host = {}) noexcept {
    id_ = id;
    turn_set_ = false;
    timeless_ = 0;
    visit(*this, [&]<class Chosen>(Chosen& controller) {
      new (&controller) Chosen{};
      if constexpr (requires { controller.body; }) controller.body = body;
      if constexpr (requires { controller.host; }) controller.host = host;
    });
    for_each_parameter(id, [&](const Parameter& parameter) {
      const float allowed = clamped(parameter.preset, lowest(parameter, body), highest(parameter, body));
      if (allowed != parameter.preset) static_cast<void>(set(parameter.name, allowed));
    });
  }

  [[nodiscard]] ControllerId id() const noexcept { return id_; }

  /// Sets a parameter that takes a word, such as `left`. `kOutside` if it has no such word, or takes a number. An empty word, which a `control`
  /// line without one has, leaves it as it is.
  [[nodiscard]] Setting set_word(const char* name, const char* word) noexcept {
    const Parameter* parameter = find_parameter(id_, name);
    if (parameter == nullptr) return Setting::kUnknown;
    return word[0] == '\0' ? Setting::kSet : set(name, number_of_word(*parameter, word));
  }
  /// Sets a parameter, in the unit the registry gives; a word is the number from `number_of_word`. Call it before `start`. If you
  /// set parameters while the controller drives, some take effect at once (most speeds), others at the next `start`.
  [[nodiscard]] Setting set(const char* name, float value) noexcept {
    const Parameter* parameter = find_parameter(id_, name);
    if (parameter == nullptr) return Setting::kUnknown;
    if (!(value >= lowest(*parameter, body()) && value <= highest(*parameter, body()))) return Setting::kOutside;
    if (parameter->values != Values::kNumber && value != static_cast<float>(static_cast<int>(value))) return Setting::kOutside;   // between two words, or two whole numbers
    if (parameter->values == Values::kTurn) {
      turn_ = static_cast<Turn>(static_cast<int>(value));
      turn_set_ = true;
      return Setting::kSet;
    }
    const auto in = [&](auto& gains, const auto& table) {
      for (const auto& gain : table) {
        if (same_text(gain.parameter.name, name)) gain.set(gains, value);
      }
    };
    switch (id_) {
      case ControllerId::kStand: break;
      case ControllerId::kFollowLine: in(follow_line_.gains, kFollowLineGains); break;
      case ControllerId::kKeepWall: in(keep_wall_.gains, kKeepWallGains); break;
      case ControllerId::kHoldHeading: in(hold_heading_.gains, kHoldHeadingGains); break;
      case ControllerId::kTurnOnLine: in(turn_on_line_.gains, kCrossingGains); break;
      case ControllerId::kTurnByWalls: in(turn_by_walls_.gains, kCrossingGains); break;
      case ControllerId::kTurnByCompass: in(turn_by_compass_.gains, kCrossingGains); break;
      case ControllerId::kRoundObstacle: in(round_obstacle_.gains, kRoundObstacleGains); break;
      case ControllerId::kTurnRound: in(turn_round_.gains, kTurnRoundGains); break;
      case ControllerId::kLookRound: in(look_round_.gains, kLookRoundGains); break;
      case ControllerId::kBug: in(bug_.gains, kBugGains); break;
      case ControllerId::kPotential: in(potential_.gains, kPotentialGains); break;
      case ControllerId::kFollowRules: break;
      case ControllerId::kNeuralMap: in(follow_plan_.gains, kNeuralMapGains); break;
      case ControllerId::kGenetic: in(follow_plan_.gains, kGeneticGains); break;
    }
    return Setting::kSet;
  }

  /// Begins the task from where the senses say that the robot is; both are copied. Called again it begins afresh, and what was `set` stays.
  void start(const Task& task, const Senses& senses) noexcept {
    Task mine = task;
    if (turn_set_) mine.turn = turn_;
    visit(*this, [&](auto& controller) { controller.start(mine, senses); });
  }
  /// What the wheels are to do until the next step. `dt_s`: seconds since the last one, usually 0.005 to 0.02; more than half a second counts as
  /// half, NaN, negative ones and less than a microsecond as 0 (see `sane_period`). Call `start` before: without it the answer
  /// is a motion that `braked` allows, but serves no purpose. If 50 periods in a row count as 0, the clock stands, and so does the robot. Cost: some hundred to some ten thousand floating-point operations; what `host`
  /// needs comes on top.
  [[nodiscard]] Motion step(const Senses& senses, float dt_s) noexcept {
    Motion motion;
    visit(*this, [&](auto& controller) { motion = controller.step(senses, dt_s); });
    timeless_ = sane_period(dt_s) > 0.0f ? std::uint8_t{0} : timeless_ < kMostTimeless ? static_cast<std::uint8_t>(timeless_ + 1) : kMostTimeless;
    return timeless_ < kMostTimeless ? motion : Motion{};
  }
  /// Whether the controller has reached its end; the robot then stands.
  [[nodiscard]] bool done() const noexcept {
    return ask(false, [](const auto& controller) { return controller.done(); });
  }
  /// Whether it has lost what it follows; the robot then stands.
  [[nodiscard]] bool lost() const noexcept {
    return ask(false, [](const auto& controller) -> decltype(controller.lost()) { return controller.lost(); });
  }
  /// Why it fails to cross a hall; kNone while it gets on, and for controllers that do not cross halls.
  [[nodiscard]] Plight plight() const noexcept {
    return ask(Plight::kNone, [](const auto& controller) -> decltype(controller.plight()) { return controller.plight(); });
  }

 private:
  [[nodiscard]] Body body() const noexcept {
    return ask(Body{}, [](const auto& controller) -> decltype(controller.body) { return controller.body; });
  }

  /// The controller's answer to a question; `answer` if it cannot be asked that.
  template <class Answer, class Question>
  [[nodiscard]] Answer ask(Answer answer, Question question) const noexcept {
    visit(*this, [&](const auto& controller) {
      if constexpr (requires { question(controller); }) answer = question(controller);
    });
    return answer;
  }

  template <class Self, class Use>
  static void visit(Self& self, Use&& use) noexcept {
    switch (self.id_) {
      case ControllerId::kStand: return use(self.stand_);
      case ControllerId::kFollowLine: return use(self.follow_line_);
      case ControllerId::kKeepWall: return use(self.keep_wall_);
      case ControllerId::kHoldHeading: return use(self.hold_heading_);
      case ControllerId::kTurnOnLine: return use(self.turn_on_line_);
      case ControllerId::kTurnByWalls: return use(self.turn_by_walls_);
      case ControllerId::kTurnByCompass: return use(self.turn_by_compass_);
      case ControllerId::kRoundObstacle: return use(self.round_obstacle_);
      case ControllerId::kTurnRound: return use(self.turn_round_);
      case ControllerId::kLookRound: return use(self.look_round_);
      case ControllerId::kBug: return use(self.bug_);
      case ControllerId::kPotential: return use(self.potential_);
      case ControllerId::kFollowRules: return use(self.follow_rules_);
      case ControllerId::kNeuralMap:
      case ControllerId::kGenetic: return use(self.follow_plan_);
    }
  }

  ControllerId id_ = ControllerId::kStand;
  Turn turn_ = Turn::kForward;
  bool turn_set_ = false;
  static constexpr std::uint8_t kMostTimeless = 50;
  std::uint8_t timeless_ = 0;   ///< periods in a row
  // All members are trivially copyable, so the union is too, and none needs to be destroyed.
  union {
    Stand stand_;
    FollowLine follow_line_;
    KeepWall keep_wall_;
    HoldHeading hold_heading_;
    TurnOnLine turn_on_line_;
    TurnByWalls turn_by_walls_;
    TurnByCompass turn_by_compass_;
    RoundObstacle round_obstacle_;
    TurnRound turn_round_;
    LookRound look_round_;
    Bug bug_;
    Potential potential_;
    FollowRules follow_rules_;
    FollowPlan follow_plan_;
  };
};
static_assert(sizeof(AnyController) <= 6000);

}  // namespace mts
