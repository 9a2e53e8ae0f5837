// A robot on a floor, for the tests of the controllers: a differential drive with lagging wheels, and sensors with noise. It
// shares no code with the controllers but the contract (senses.h) and the sizes (body.h).
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <waymark/controllers/body.h>

namespace mts::plant {

struct Point { double x = 0.0, y = 0.0; };
struct Segment { Point from, to; };
struct Stroke { Segment along; double width = 0.0; };

/// What stands on the floor and what is painted on it.
struct Floor {
  std::vector<Segment> walls;
  std::vector<Stroke> paint;
  void add_path(const std::vector<Point>& points, double width);
  void add_walls(const std::vector<Point>& points);
  void add_box(Point low, Point high);
};

/// Standard deviations; the systematic parts are drawn once for a run, uniformly within +-.
struct Noise {
  double line = 0.0;            ///< of darkness
  double range_m = 0.0;
  double compass_rad = 0.0, compass_bias_rad = 0.0;
  double speed_m_s = 0.0;       ///< of odometry
  double wheel_scale = 0.0;     ///< systematic: odometry counts so much too much or too little
  double slip = 0.0;            ///< systematic: the left wheel gives so much more or less than is asked for
  double delay_s = 0.0;         ///< of all sensors
};
/// None, what is usual, and what is bad.
[[nodiscard]] Noise noise_of_level(int level);

double distance_to(const Segment& segment, Point p);

class Plant {
 public:
  Plant(Floor floor, const Noise& noise, std::uint64_t seed);

  void place(double x, double y, double heading_rad);
  /// Whatever stood on the floor is gone.
  void remove_walls() { floor_.walls.clear(); }
  /// Lets the wheels turn for `dt_s` as they are told.
  void drive(const Motion& motion, double dt_s);
  [[nodiscard]] Senses sense();

  double x = 0.0, y = 0.0, heading = 0.0;
  double left_m_s = 0.0, right_m_s = 0.0;
  bool touched = false;          ///< has been, at any time
  double nearest_m = 1e9;        ///< the smallest distance to a wall so far, from the robot's edge
  [[nodiscard]] Point row() const;   ///< the middle of the line sensors
  Body body;

 private:
  struct Moment { double t, x, y, heading, odo_x, odo_y, odo_turned, speed; };
  [[nodiscard]] Moment past() const;
  [[nodiscard]] double range(const Moment& at, double angle) const;
  [[nodiscard]] double darkness(Point p) const;
  [[nodiscard]] double normal(double sigma);
  [[nodiscard]] double uniform(double half);

  Floor floor_;
  Noise noise_;
  std::mt19937_64 dice_;
  double left_scale_ = 1.0, right_scale_ = 1.0, bias_ = 0.0, slip_ = 1.0;
  double t_ = 0.0, odo_x_ = 0.0, odo_y_ = 0.0, odo_turned_ = 0.0;
  std::vector<Moment> history_;
};

// --- floors ---------------------------------------------------------------------------------------------------------

/// Straight pieces from `from` on, each bend rounded with `radius` (0: a corner): the points of the middle line.
[[nodiscard]] std::vector<Point> middle_line(Point from, const std::vector<Piece>& pieces, double radius);
/// The same, `aside` to the left: a bend that would be rounded to less than nothing is a corner.
[[nodiscard]] std::vector<Point> parallel_line(Point from, const std::vector<Piece>& pieces, double radius, double aside);
/// To the left of a line of points, from its nearest part.
[[nodiscard]] double left_of(const std::vector<Point>& line, Point p);

/// A crossing about (0, 0): roads to some of east, north, west, south (bits 0 to 3), each with paint and walls.
struct CrossingPlan {
  unsigned roads = 15;
  double span = 0.7;       ///< between stop lines
  double width = 0.6;      ///< of the roads
  bool lines = true, walls = true;
  double slant_rad = 0.0;  ///< all of it turned
};
[[nodiscard]] Floor crossing_floor(const CrossingPlan& plan);

}  // namespace mts::plant
