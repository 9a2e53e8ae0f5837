#include "sim/robot/body.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr int kVelocityRounds = 4, kPositionRounds = 2;   // of Box2D's solver: a single moving body against walls needs few

// Box2D computes in float, whose resolution grows coarser with the distance from its origin: half a kilometre away it is already 1/16 of
// the way that a slow robot drives in one step. So the origin begins near the floor, on a whole kilometre, and follows the robot.
constexpr double kOriginStep = 1000.0;   // m
constexpr float kComesAfter = 64.0f;     // m: the origin follows a robot that is farther away; on small maps it never moves

double origin(double low_m, double high_m) { return kOriginStep * std::round(0.5 * (low_m + high_m) / kOriginStep); }

/// The nearest thing that a ray meets.
class NearestHit final : public b2RayCastCallback {
 public:
  explicit NearestHit(const b2Body* robot) : robot_(robot) {}
  float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float fraction) override {
    if (fixture->GetBody() == robot_) return -1.0f;
    nearest = fraction;
    return fraction;
  }
  float nearest = 1.0f;

 private:
  const b2Body* robot_;
};

}  // namespace

struct Arena::World final : public b2ContactListener {
  explicit World(Spot origin_at) : zero(origin_at) {}

  Spot zero;                         // of Box2D's coordinates
  b2World world{b2Vec2_zero};
  b2Body* robot = nullptr;
  double radius_m = 0.0;             // of the robot
  std::vector<Obstacle> obstacles;
  std::vector<b2Body*> bodies;       // of the obstacles
  std::vector<Spot> moves;           // velocities of the obstacles in this step, m/s: to Box2D they stand, each step elsewhere
  std::vector<Hit> hits;
  int touches = 0;

  [[nodiscard]] b2Vec2 vec(Spot at) const { return {static_cast<float>(at.x_m - zero.x_m), static_cast<float>(at.y_m - zero.y_m)}; }
  void follow_robot() {
    const b2Vec2 at = robot->GetPosition();
    if (std::max(std::abs(at.x), std::abs(at.y)) < kComesAfter) return;
    const b2Vec2 there{std::round(at.x), std::round(at.y)};
    world.ShiftOrigin(there);
    zero = spot(there);
  }
  [[nodiscard]] Spot spot(b2Vec2 v) const { return zero + Spot{static_cast<double>(v.x), static_cast<double>(v.y)}; }

  void BeginContact(b2Contact* contact) override {
    ++touches;
    const b2Body* other = contact->GetFixtureA()->GetBody() == robot ? contact->GetFixtureB()->GetBody() : contact->GetFixtureA()->GetBody();
    const auto found = std::find(bodies.begin(), bodies.end(), other);
    const auto place = static_cast<std::size_t>(found - bodies.begin());
    const bool wall = found == bodies.end();
    b2WorldManifold touch;
    contact->GetWorldManifold(&touch);
    const b2Vec2 outwards = contact->GetFixtureA()->GetBody() == robot ? touch.normal : -touch.normal;
    const b2Vec2 own = robot->GetLinearVelocity();
    const Spot theirs = wall ? Spot{} : moves[place];
    const Spot closing = Spot{static_cast<double>(own.x), static_cast<double>(own.y)} - theirs;
    const double speed_m_s = std::max(dot(closing, {static_cast<double>(outwards.x), static_cast<double>(outwards.y)}), 0.0);
    meet(wall ? std::string("a wall") : obstacles[place].name, speed_m_s);
  }
  void EndContact(b2Contact*) override { --touches; }
  /// Where two walls meet, the robot touches both in one step: that is one hit.
  void meet(std::string what, double speed_m_s) {
    const auto same = std::find_if(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.what == what; });
    if (same == hits.end()) hits.push_back({std::move(what), spot(robot->GetPosition()), speed_m_s});
    else same->speed_m_s = std::max(same->speed_m_s, speed_m_s);
  }
};

Arena::Arena(const Labyrinth& labyrinth, Pose start, double radius_m)
    : world_(std::make_unique<World>(Spot{origin(labyrinth.low.x_m, labyrinth.high.x_m), origin(labyrinth.low.y_m, labyrinth.high.y_m)})) {
  World& w = *world_;
  w.world.SetContactListener(&w);
  w.world.SetContinuousPhysics(false);   // nothing moves farther in a step than a quarter of its radius
  w.world.SetAllowSleeping(false);
  const b2BodyDef fixed;
  b2Body* walls = w.world.CreateBody(&fixed);
  for (const Picture::Wall& wall : labyrinth.walls) {
    b2EdgeShape edge;
    edge.SetTwoSided(w.vec(wall.from), w.vec(wall.to));
    walls->CreateFixture(&edge, 0.0f);
  }
  for (const Pillar& pillar : labyrinth.pillars) {
    b2CircleShape circle;
    circle.m_p = w.vec(pillar.at);
    circle.m_radius = static_cast<float>(pillar.radius_m);
    walls->CreateFixture(&circle, 0.0f);
  }
  b2BodyDef body;
  body.type = b2_dynamicBody;
  body.position = w.vec({start.x_m, start.y_m});
  body.angle = static_cast<float>(start.heading_rad);
  w.robot = w.world.CreateBody(&body);
  b2CircleShape circle;
  circle.m_radius = static_cast<float>(radius_m);
  w.radius_m = radius_m;
  b2FixtureDef fixture;
  fixture.shape = &circle;
  fixture.density = 100.0f;
  fixture.friction = 0.1f;
  w.robot->CreateFixture(&fixture);
}

Arena::~Arena() = default;
Arena::Arena(Arena&&) noexcept = default;

void Arena::push(double speed_m_s, double turn_rad_s, double dt_s) {
  World& w = *world_;
  const float angle = w.robot->GetAngle();
  w.robot->SetLinearVelocity({static_cast<float>(speed_m_s) * std::cos(angle), static_cast<float>(speed_m_s) * std::sin(angle)});
  w.robot->SetAngularVelocity(static_cast<float>(turn_rad_s));
  w.world.Step(static_cast<float>(dt_s), kVelocityRounds, kPositionRounds);
  std::fill(w.moves.begin(), w.moves.end(), Spot{});
  w.follow_robot();
}

Pose Arena::pose() const {
  const Spot at = world_->spot(world_->robot->GetPosition());
  return {at.x_m, at.y_m, wrap(static_cast<double>(world_->robot->GetAngle()))};
}

void Arena::put(Pose pose) {
  world_->robot->SetTransform(world_->vec({pose.x_m, pose.y_m}), static_cast<float>(pose.heading_rad));
  world_->robot->SetLinearVelocity(b2Vec2_zero);
  world_->robot->SetAngularVelocity(0.0f);
}

float Arena::ray(Spot from, Spot ahead, double most_m) const {
  NearestHit hit(world_->robot);
  world_->world.RayCast(&hit, world_->vec(from), world_->vec(from + most_m * ahead));
  return hit.nearest * static_cast<float>(most_m);
}

double Arena::radius_m() const { return world_->radius_m; }

bool Arena::touching() const { return world_->touches > 0; }

std::vector<Hit> Arena::take_hits() { return std::exchange(world_->hits, {}); }

void Arena::place_obstacle(const Obstacle& obstacle) {
  World& w = *world_;
  for (std::size_t i = 0; i < w.obstacles.size(); ++i) {
    if (w.obstacles[i].name != obstacle.name || w.obstacles[i].radius_m != obstacle.radius_m) continue;
    w.obstacles[i].at = obstacle.at;
    w.bodies[i]->SetTransform(w.vec(obstacle.at), 0.0f);
    return;
  }
  remove_obstacle(obstacle.name);
  b2BodyDef body;
  body.position = w.vec(obstacle.at);
  b2Body* made = w.world.CreateBody(&body);
  b2CircleShape circle;
  circle.m_radius = static_cast<float>(obstacle.radius_m);
  made->CreateFixture(&circle, 0.0f);
  w.obstacles.push_back(obstacle);
  w.bodies.push_back(made);
  w.moves.emplace_back();
}

void Arena::move_obstacle(const Obstacle& there, double dt_s) {
  World& w = *world_;
  for (std::size_t i = 0; i < w.obstacles.size(); ++i) {
    if (w.obstacles[i].name == there.name) w.moves[i] = (1.0 / dt_s) * (there.at - w.obstacles[i].at);
  }
  place_obstacle(there);
}

void Arena::remove_obstacle(const std::string& name) {
  World& w = *world_;
  for (std::size_t i = 0; i < w.obstacles.size(); ++i) {
    if (w.obstacles[i].name != name) continue;
    b2Body* body = w.bodies[i];
    w.obstacles.erase(w.obstacles.begin() + static_cast<std::ptrdiff_t>(i));
    w.bodies.erase(w.bodies.begin() + static_cast<std::ptrdiff_t>(i));
    w.moves.erase(w.moves.begin() + static_cast<std::ptrdiff_t>(i));
    w.world.DestroyBody(body);
    return;
  }
}

const std::vector<Obstacle>& Arena::obstacles() const { return world_->obstacles; }

}  // namespace kb::sim
