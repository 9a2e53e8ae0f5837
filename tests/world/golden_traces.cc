#include "tests/world/golden_traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tests/world/record.h"
#include "tests/world/scenario.h"

namespace kb::world {
namespace {

/// Long enough for the robot to give up, search and report; short enough for a file that a person can read.
constexpr int kPatienceTicks = 360;

constexpr std::string_view kControls = R"(
control Move.mark         = follow_line(speed: 0.4 m/s)
control Move.dist         = keep_wall(distance: 0.3 m, speed: 0.3 m/s)
control Move.azimuth      = hold_heading(speed: 0.3 m/s)
control Cross[t, mark]    = turn_on_line(turn: t)
control Cross[t, dist]    = turn_by_walls(turn: t)
control Cross[t, azimuth] = turn_by_compass(turn: t)
control Avoid             = keep_wall(side: right, distance: 0.2 m, speed: 0.2 m/s)
control Search            = look_round()
control Stop              = stand()
)";

constexpr std::string_view kLamp = R"(# The threshold of an event is 0.75, and 0.50 while the fact is attended to.
levels watch > control
set event = 0.75, attention = 0.25

fact      Lamp
fact      Heed                    # attention is asked for
satellite Heeding of Lamp
strategy  Look

rule heed at watch
    when Heed
    then +Heeding

rule unheed at watch
    when not Heed
    then -Heeding

rule notice at watch
    when event Lamp
    then +sat Look

rule lose at watch
    when lost Lamp
    then -sat Look

control Look = look_at()
)";

struct LampTick { float heed, lamp; };

/// Attention takes effect on the tick after it was asked for: each part begins with one tick of darkness.
std::vector<LampTick> lamp_ticks() {
  constexpr float kOff = -1.0f, kOn = 1.0f;
  return {
      // One event, at 0.8; with attention one, at 0.6.
      {kOff, 0.0f}, {kOff, 0.4f}, {kOff, 0.6f}, {kOff, 0.8f},
      {kOff, 0.0f}, {kOn, 0.0f}, {kOn, 0.4f}, {kOn, 0.6f}, {kOn, 0.8f},
      // Attention that comes while it stands at 0.6: one event. Attention withdrawn: no loss.
      {kOff, 0.0f}, {kOff, 0.6f}, {kOff, 0.6f}, {kOn, 0.6f}, {kOn, 0.6f}, {kOn, 0.6f},
      {kOff, 0.6f}, {kOff, 0.6f},
      // Exactly 0.50 with attention, exactly 0.75 without: none.
      {kOn, 0.0f}, {kOn, 0.5f}, {kOn, 0.5f},
      {kOff, 0.0f}, {kOff, 0.75f}, {kOff, 0.75f},
      // Chatter round 0.75: one event; after it has fallen to 0.50, another one.
      {kOff, 0.74f}, {kOff, 0.76f}, {kOff, 0.74f}, {kOff, 0.76f}, {kOff, 0.5f}, {kOff, 0.76f},
  };
}

Finding lamp(const Setting& setting) {
  const auto knowledge = Knowledge::of_text(kLamp);
  const auto mind = make_mind(setting.mind, *knowledge);
  Recording recording{knowledge, {}, {}};
  std::vector<std::uint64_t> events;
  for (const LampTick& now : lamp_ticks()) {
    std::vector<float> facts(knowledge->program().facts);
    facts[program::index(knowledge->cell("Heed"))] = now.heed;
    facts[program::index(knowledge->cell("Lamp"))] = now.lamp;
    const program::Tick tick = mind->tick(facts, 100'000);
    recording.rows.push_back({tick.time_us, facts});
    recording.ticks.push_back(tick);
    if (std::count(tick.events.begin(), tick.events.end(), knowledge->cell("Lamp")) > 0) events.push_back(tick.number);
  }
  if (setting.recording) *setting.recording = recording;
  return expect(events == std::vector<std::uint64_t>{4, 8, 14, 25, 29},
                fmt::format("events at ticks {}", fmt::join(events, ", ")));
}

/// One of the scenarios, by name.
std::function<Finding(const Setting&)> scenario(std::string_view name) {
  for (const Scenario& candidate : all_scenarios()) {
    if (candidate.name == name) return candidate.run;
  }
  throw std::out_of_range("no scenario " + std::string(name));
}

}  // namespace

std::vector<GoldenTrace> golden_traces() {
  return {
      {"01_a_detour_over_two_landmarks_rejoins_the_route",
       "M1-M2 is closed: the way round by V1 and V2 rejoins the route at M3, and M2, "
       "which is skipped, offers no second exit on the way.",
       scenario("a_skipped_goal_offers_no_exit_on_the_way_round")},
      {"02_an_obstacle_inside_a_crossing_without_end_is_reported",
       "An obstacle inside the crossing of LM2 does not end: after 20 s the robot stands and "
       "reports; when it is gone the manoeuvre goes on and the exit line still counts.",
       [](const Setting& setting) { return obstacle_in_a_crossing_without_end(setting, kPatienceTicks); }},
      {"03_the_marking_is_lost_and_found",
       "The marking of LM2-LM3 is lost: walls, then compass, then a halt, then the marking again; "
       "the goal and the awaited line stay.",
       scenario("when_the_marking_is_lost_walls_then_compass_serve")},
      {"04_a_dead_end_is_left_by_turning_back",
       "The route goes into the dead end LM1 and out again: the manoeuvre is `back`, and no "
       "unused exit leaks into the next crossing.",
       scenario("the_way_leads_out_of_a_dead_end")},
      {"05_abort_inside_a_crossing_is_the_state_of_start_up",
       "Abort inside the crossing of LM3: every satellite returns to its initial value, and the next command runs.",
       scenario("abort_inside_a_crossing_then_another_mission")},
      {"06_a_command_during_a_mission_is_ignored",
       "Both commands are pressed again and again during the mission: no rule fires that would not fire without them.",
       scenario("a_command_during_a_mission_changes_nothing")},
      {"07_an_unknown_place_is_never_crossed_blindly",
       "LM2 is never surer than 0.3 and the road of arrival is unknown: the robot stops at the line, "
       "searches, reports; when it can see again, it goes on.",
       [](const Setting& setting) { return weak_sign_and_unknown_arrival(setting, kPatienceTicks); }},
      {"08_of_two_landmarks_that_look_alike_the_awaited_one_counts",
       "Each landmark (0.85) looks like another one of the map (0.80): only the awaited one moves "
       "the route, and only once.",
       scenario("of_two_landmarks_that_look_alike_only_the_awaited_counts")},
      {"09_a_later_landmark_in_view_moves_nothing",
       "LM7 seems to be in view from LM5 on: nothing fires; when it becomes the goal, it is still recognised.",
       scenario("a_later_landmark_in_view_moves_nothing")},
      {"10_attention_lowers_the_threshold_of_an_event",
       "Events of a fact with and without attention, at the thresholds, when attention comes and goes, and "
       "under chatter.",
       lamp},
  };
}

GoldenFiles record(const GoldenTrace& golden, MindKind mind) {
  Recording recording;
  const Finding found = golden.run({mind, &recording});
  if (!found.empty()) throw std::runtime_error(golden.folder + ": " + found);
  const std::string& text = recording.knowledge->text();
  const bool controlled = text.find("\ncontrol ") != std::string::npos;
  return {fmt::format("# {}\n{}{}", golden.says, text, controlled ? "" : kControls), facts_csv(recording),
          trace_jsonl(recording), fmt::format("{}\n", golden.says)};
}

}  // namespace kb::world
