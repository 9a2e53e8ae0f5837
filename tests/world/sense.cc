#include "tests/world/sense.h"

namespace kb::world {
namespace {

void read_memory(const World& world, LandmarkId here, Readings& now) {
  const Landmark& landmark = world.map[here];
  now.safe = landmark.safe ? kSure : kSureNot;
  for (Method m : kMethods) {
    if (landmark.cross_by.contains(m)) now.cross_by[index(m)] = kSure;
  }
  for (Direction d : kDirections) {
    if (const auto edge = world.map.leaving(here, d)) {
      now.closed[index(d)] = world.map.road(*edge).closed ? kSure : kSureNot;
    }
  }
}

void see_tracks(MethodSet tracks, Readings& now) {
  for (Method m : kMethods) now.track[index(m)] = tracks.contains(m) ? kSure : kSureNot;
}

void sense_on_road(const World& world, const OnRoad& here, Readings& now) {
  const Edge& edge = world.map[here.edge];
  const Road& road = world.map.road(here.edge);
  const bool sign = here.s_m >= road.length_m - kSignBefore;
  const bool entry = here.s_m >= road.length_m - kLineWidth;
  const bool leaving = here.s_m <= kLineWidth;
  if (sign) {
    now.landmark[index(edge.to)] = kSure;
  } else if (here.s_m <= kSignBehind) {
    now.landmark[index(edge.from)] = kSure;
  }
  if (entry || leaving) now.line = kSure;
  const bool arrival_visible = world.arrival_seen == ArrivalSeen::kBoth ||
                               (world.arrival_seen == ArrivalSeen::kAtSign) == !entry;
  if (sign && arrival_visible) now.in[index(edge.approach)] = kSure;
  see_tracks(world.aside ? MethodSet{} : road.tracks, now);
  if (sign && (entry || world.memory_read == MemoryRead::kFromSign)) read_memory(world, edge.to, now);
  if (leaving) now.move_by[index(road.by)] = kSure;
}

void sense_in_crossing(const World& world, const InCrossing& here, Readings& now) {
  const bool entry = here.p_m < kLineWidth;
  const bool leaving = here.p_m >= kCrossingLength - kLineWidth;
  now.landmark[index(here.landmark)] = kSure;
  if (entry || leaving) now.line = kSure;
  see_tracks({Method::kMark}, now);
  if (entry) read_memory(world, here.landmark, now);
  if (leaving && here.exit) now.move_by[index(world.map.road(*here.exit).by)] = kSure;
}

}  // namespace

Readings sense(const World& world) {
  Readings now;
  now.landmark.assign(world.map.landmarks.size(), -1.0f);
  now.turned = world.turned ? 1.0f : -1.0f;
  if (world.obstacle_within(kObstacleSeen, true)) now.obstacle = kSure;
  if (const OnRoad* road = world.on_road()) {
    sense_on_road(world, *road, now);
  } else {
    sense_in_crossing(world, *world.in_crossing(), now);
  }
  return now;
}

}  // namespace kb::world
