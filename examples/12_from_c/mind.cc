// The one file of C++ in a program in C: the compiled mind behind functions that C can call.
#include "mind.h"

#include "bumper.kb.h"

namespace {

template <class A, class B>
constexpr bool same(A a, B b) { return static_cast<unsigned>(a) == static_cast<unsigned>(b); }
static_assert(same(MIND_BUTTON, bumper::Fact::Button) && same(MIND_WALL, bumper::Fact::Wall) && bumper::Knowledge::kShape.facts == 2);
static_assert(same(MIND_DRIVE_AHEAD, bumper::Strategy::Drive_ahead) && same(MIND_DRIVE_BACK, bumper::Strategy::Drive_back));
static_assert(same(MIND_NOTHING, bumper::Knowledge::kShape.strategies), "mind.h has as many strategies as the knowledge base");

bumper::Mind mind;
bumper::Facts facts;

}  // namespace

void mind_set(mind_fact fact, float certainty) { facts.set(static_cast<bumper::Fact>(fact), certainty); }

mind_strategy mind_tick(std::uint32_t ms) {
  const auto decision = mind.tick(facts, mts::milliseconds(ms));
  return decision.drives() ? static_cast<mind_strategy>(decision.strategy()) : MIND_NOTHING;
}

float mind_speed() {
  const mts::ControlLine* line = bumper::control_line(mind.decision());
  return line != nullptr ? line->arguments[0].number : 0.0f;
}

bool mind_stuck() { return mind.high(bumper::Satellite::Stuck); }

const char* mind_name(mind_strategy strategy) { return strategy == MIND_NOTHING ? "nothing" : bumper::name(static_cast<bumper::Strategy>(strategy)); }
