// Names that emitted code has itself: names.kb beside this file. That it compiles is the most of the test.
#include <gtest/gtest.h>

// Macros that facts are called as.
#include <cerrno>
#include <cfenv>
#include <cfloat>
#include <cinttypes>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <cwchar>
#include <type_traits>

#include "names.kb.fleet.h"

namespace names {
namespace {

struct Wheels {
  template <class Inputs>
  void sense(Inputs& in) {
    if constexpr (requires { in.near; }) in.near = 1.0f;
  }
  template <class How>
  void Perception(const How&) { driven = 1; }
  template <class How>
  void senses(const How&) { driven = 2; }
  template <class How>
  void index(const How&) { driven = 3; }
  template <class How>
  void kAtoms(const How&) { driven = 4; }
  template <class How>
  void evaluate(const How&) { driven = 5; }
  template <class How>
  void sign_texts(const How&) { driven = 6; }
  void idle() { driven = 0; }
  int driven = -1;
};

TEST(Names, OfEmittedCodeItselfAreFreeInAKnowledgeBase) {
  names::Mind mind;
  names::Facts facts;
  for (const auto fact : {names::Fact::yes, names::Fact::kRules, names::Fact::Facts_Mind, names::Fact::NearGroup, names::Fact::KB_FLEET_WIDTH_}) {
    facts.set(fact, 1.0f);
  }
  facts.Near.Store_2 = 1.0f;
  facts.f = facts.certainty = 0.5f;
  const names::Facts other = facts;
  EXPECT_EQ(other.f, 0.5f);
  const auto decision = mind.tick(facts, mts::milliseconds(20));
  Wheels wheels;
  names::drive(decision, wheels);
  EXPECT_EQ(wheels.driven, 1);
  EXPECT_STREQ(name(decision.strategy()), "Controllers");
  EXPECT_STREQ(name(names::Fact::SIZE_MAX_), "SIZE_MAX");
  EXPECT_STREQ(name(names::Fact::EOF_), "EOF");
  EXPECT_STREQ(name(names::Fact::M_PI_), "M_PI");
  EXPECT_STREQ(name(names::Fact::EINTR_), "EINTR");
  EXPECT_STREQ(name(names::Fact::EAST), "EAST");
  EXPECT_STREQ(name(names::Fact::SIGN), "SIGN");
  EXPECT_STREQ(name(names::Fact::PRIORITY), "PRIORITY");
}

}  // namespace
}  // namespace names
