// Which planes of a fleet are kept, and which are made of others: see note [derived planes] in compiler/tables/fleet_derived.h.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/tables/fleet.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/program_builder.h"

namespace kb::tables {
namespace {

using namespace program::testing;
using PlaneKind = FleetPlane::Kind;

bool derives(const FleetForm& form, PlaneKind kind, std::uint32_t of) {
  return std::ranges::any_of(form.derived, [&](const FleetDerived& d) { return d.plane.kind == kind && d.plane.of == of; });
}
bool keeps(const FleetForm& form, PlaneKind kind, std::uint32_t of) {
  return std::ranges::any_of(form.planes, [&](const FleetPlane& p) { return p.kind == kind && p.of == of; });
}
FleetForm form_of(const ProgramBuilder& b) {
  const program::Program program = b.build();
  return build_fleet(program, build(program));
}

TEST(FleetPlanes, ARuleThatOnlyWaitsIsDisarmedWhereItsTimerIsOver) {
  ProgramBuilder b({"think", "control"});
  b.fact("Wall").satellite("Hit").satellite("Stuck").strategy("Go");
  b.when("hit", "think", seen("Wall"), {raise("Hit"), raise("sat Go")});
  b.when("stuck", "think", held(seen("Wall"), 1'000'000), {raise("Stuck")});
  const FleetForm form = form_of(b);
  EXPECT_TRUE(derives(form, PlaneKind::kDone, 1));
  EXPECT_FALSE(keeps(form, PlaneKind::kDone, 1));
  EXPECT_TRUE(keeps(form, PlaneKind::kTimerOver, 0));
  EXPECT_TRUE(derives(form, PlaneKind::kTimerOn, 0)) << "the timer waits where the fact is seen";
}

TEST(FleetPlanes, WhatThisTicksFactsSayIsKept) {
  ProgramBuilder b({"think", "control"});
  b.fact("Wall").satellite("Hit").strategy("Go");
  b.when("hit", "think", all({high("Wall"), high("sat Go")}), {raise("Hit")});
  b.when("go", "think", seen("Wall"), {raise("sat Go")});
  const FleetForm form = form_of(b);
  EXPECT_TRUE(keeps(form, PlaneKind::kDone, 0)) << "the next tick has other facts";
  EXPECT_FALSE(derives(form, PlaneKind::kDone, 0));
}

TEST(FleetPlanes, AStrategyIsActiveWhereItsSatelliteIsHighAndNoneBeforeIt) {
  ProgramBuilder b({"think", "control"});
  b.fact("Wall").strategy("Back").strategy("Go");
  b.when("back", "think", seen("Wall"), {raise("sat Back")});
  b.when("go", "think", lost("Wall"), {raise("sat Go"), lower("sat Back")});
  const FleetForm form = form_of(b);
  for (std::uint32_t strategy = 0; strategy < 2; ++strategy) {
    EXPECT_TRUE(derives(form, PlaneKind::kActive, strategy));
    EXPECT_FALSE(keeps(form, PlaneKind::kActive, strategy));
  }
}

TEST(FleetPlanes, PartsAreMadeOfPlanesAndOfPartsBeforeThem) {
  ProgramBuilder b({"think", "control"});
  b.fact("Wall");
  for (const char* name : {"A", "B", "C", "D", "E"}) b.strategy(name);
  b.when("go", "think", seen("Wall"), {raise("sat A"), raise("sat B"), raise("sat C"), raise("sat D"), raise("sat E")});
  const FleetForm form = form_of(b);
  ASSERT_FALSE(form.parts.empty());
  for (std::size_t i = 0; i < form.parts.size(); ++i) {
    EXPECT_LT(form.parts[i].a >> 1, form.planes.size() + i);
    EXPECT_LT(form.parts[i].b >> 1, form.planes.size() + i);
  }
  for (const FleetDerived& d : form.derived) EXPECT_LT(d.part, form.planes.size() + form.parts.size());
}

}  // namespace
}  // namespace kb::tables
