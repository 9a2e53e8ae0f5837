#include "tools/kbc/layout/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "compiler/diagnostics/consumers.h"
#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/curve.h"
#include "tools/kbc/layout/json.h"

namespace kb::layout {
namespace {

struct File {
  explicit File(std::string text) : id(sources.add("a.json", std::move(text))) {}
  source::Sources sources;
  source::FileId id;
  diagnostics::CountingConsumer counted;
  diagnostics::Diagnostics diagnostics{sources, counted};
};

TEST(Curve, ACircleIsMetExactlyByARationalSpline) {
  const double w = std::numbers::sqrt2 / 2.0;
  const Spline quarter{2, {0, 0, 0, 1, 1, 1}, {{2, 0}, {2, 2}, {0, 2}}, {1, w, 1}};
  ASSERT_TRUE(is_sound(quarter));
  const auto points = points_within(quarter);
  ASSERT_EQ(points.size(), 3u);
  for (const Point& p : points) EXPECT_NEAR(std::hypot(p.x_m, p.y_m), 2.0, 1e-12);
}

TEST(Curve, BezierCurvesMeetAtEachThirdPoint) {
  const auto points = points_within(bezier({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {2, -1}, {2, 0}}));
  ASSERT_EQ(points.size(), 7u);
  EXPECT_NEAR(points[3].x_m, 1.0, 1e-12);
  EXPECT_NEAR(points[3].y_m, 0.0, 1e-12);
  EXPECT_NEAR(points[1].x_m, 0.5, 1e-12);    // at half: (p0 + 3 p1 + 3 p2 + p3) / 8
  EXPECT_NEAR(points[1].y_m, 0.75, 1e-12);
}

TEST(Curve, ALongOneHasAsManyPiecesAsItNeeds) {
  const Point turn[] = {{0, 0}, {40.0 / 3, 0}, {40.0 / 3, 10}, {0, 10}};   // about half a circle
  std::vector<Point> chain = points_within(bezier({turn[0], turn[1], turn[2], turn[3]}));
  EXPECT_GT(chain.size(), 7u);
  EXPECT_LT(chain.size(), 63u);
  chain.insert(chain.begin(), turn[0]);
  chain.push_back(turn[3]);
  double off_m = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double u = i / 1000.0, v = 1.0 - u, b[] = {v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u};
    Point on;
    for (int k = 0; k < 4; ++k) on.x_m += b[k] * turn[k].x_m, on.y_m += b[k] * turn[k].y_m;
    double nearest_m = 1e9;
    for (std::size_t k = 1; k < chain.size(); ++k) nearest_m = std::min(nearest_m, nearest(on, chain[k - 1], chain[k]).distance_m);
    off_m = std::max(off_m, nearest_m);
  }
  EXPECT_LT(off_m, 0.062);
  EXPECT_EQ(points_within(bezier({{0, 0}, {1e5, 0}, {1e5, 1e5}, {0, 1e5}})).size(), 63u) << "but no more than a map should have";
}

TEST(Curve, APolygonKeepsItsCorners) {
  const auto points = points_within({1, {0, 0, 0.3, 0.6, 1, 1}, {{0, 0}, {1, 0}, {1, 1}, {2, 1}}, {1, 1, 1, 1}});
  EXPECT_EQ(points, (std::vector<Point>{{1, 0}, {1, 1}}));
}

TEST(Curve, WhatIsNoSplineIsSaidToBeNone) {
  EXPECT_FALSE(is_sound({2, {0, 0, 1, 1}, {{0, 0}, {1, 1}}, {1, 1}}));                      // fewer points than its degree needs
  EXPECT_FALSE(is_sound({1, {0, 1, 0, 1}, {{0, 0}, {1, 1}}, {1, 1}}));                      // knots that fall
  EXPECT_FALSE(is_sound({1, {0, 0, 1, 1}, {{0, 0}, {1, 1}}, {1, 0}}));                      // a weight of nothing
  EXPECT_FALSE(is_sound({0, {}, {}, {}}));
}

TEST(JsonPlaces, EachValueKnowsWhereItStands) {
  File file("\xEF\xBB\xBF{\"a\" : [ -1.5e3 ,\"x\\\"\\u00e4y\",null],\n \"b\":{\"c\":true}, \"d\":7}");
  const auto root = read_json(file.sources, file.id, file.diagnostics);
  ASSERT_TRUE(root);
  const auto text = [&](const Json& value) { return file.sources.text(value.span); };
  const Json* a = root->find("a");
  ASSERT_NE(a, nullptr);
  EXPECT_EQ(text(a->parts[0]), "-1.5e3");
  EXPECT_EQ(a->parts[0].number, -1500.0);
  EXPECT_EQ(text(a->parts[1]), "\"x\\\"\\u00e4y\"");
  EXPECT_EQ(a->parts[1].text, "x\"\u00e4y");
  EXPECT_EQ(text(a->parts[2]), "null");
  EXPECT_EQ(text(*root->find("b")->find("c")), "true");
  EXPECT_EQ(text(*root->find("d")), "7");
  EXPECT_EQ(root->find("e"), nullptr);
}

Layout star(const std::vector<double>& degrees_from_north) {
  Layout layout;
  layout.places.push_back({"middle", "", {0, 0}, {}});
  for (std::size_t i = 0; i < degrees_from_north.size(); ++i) {
    const double a = degrees_from_north[i] * std::numbers::pi / 180.0;
    layout.places.push_back({std::to_string(i), "", {10.0 * std::sin(a), 10.0 * std::cos(a)}, {}});
    layout.ways.push_back({"", "middle", std::to_string(i), {}, false, {}, {}});
  }
  return layout;
}

std::vector<std::string_view> exits(const std::vector<double>& degrees) {
  File file("");
  Adaptations adaptations;
  std::vector<std::string_view> sides;
  const auto roads = roads_of(star(degrees), adaptations, file.diagnostics);
  if (roads) for (const Road& road : *roads) sides.push_back(kSides[road.exit]);
  return sides;
}

/// Places on a grid of centimetres, and ways with up to three bends between them.
Layout random_layout(std::mt19937& random) {
  const auto centimetres = [&] { return static_cast<double>(static_cast<int>(random() % 10'000) - 5'000) / 100.0; };
  Layout layout;
  for (std::size_t i = 0; i < 2 + random() % 9; ++i) layout.places.push_back({"P" + std::to_string(i), "", {centimetres(), centimetres()}, {}});
  for (std::size_t i = 0; i < random() % 20; ++i) {
    const auto any = [&] { return layout.places[random() % layout.places.size()].id; };
    Way way{"way " + std::to_string(i), any(), any(), {}, false, {}, {}};
    for (std::size_t bends = random() % 4; bends > 0; --bends) way.through.push_back({centimetres(), centimetres()});
    way.limit_m_s = static_cast<double>(random() % 3) / 4.0;
    layout.ways.push_back(std::move(way));
  }
  return layout;
}

TEST(Lif, WhatIsWrittenIsReadAsItWas) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    const Layout layout = random_layout(random);
    File file(write_lif(layout, {.map = "Hall \"\xC3\xA4\"", .vehicle = "any\xFF", .timestamp = "1970-01-01T00:00:00Z"}));
    Adaptations adaptations;
    const auto read = read_lif(file.sources, file.id, {}, adaptations, file.diagnostics);
    ASSERT_TRUE(read);
    adaptations.report(file.diagnostics);
    EXPECT_EQ(file.diagnostics.warnings(), 0u);
    ASSERT_EQ(read->places.size(), layout.places.size());
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
      EXPECT_EQ(read->places[i].id, layout.places[i].id);
      EXPECT_EQ(read->places[i].at, layout.places[i].at);
    }
    ASSERT_EQ(read->ways.size(), layout.ways.size());
    for (std::size_t i = 0; i < layout.ways.size(); ++i) {
      const Way &now = read->ways[i], &was = layout.ways[i];
      EXPECT_EQ(std::tie(now.id, now.from, now.to, now.through, now.limit_m_s), std::tie(was.id, was.from, was.to, was.through, was.limit_m_s));
    }
  }
}

using Sides = std::vector<std::string_view>;

TEST(Sides, ARoadLeavesByTheSideItLeadsTo) {
  EXPECT_EQ(exits({0, 90, 180, 270}), (Sides{"N", "E", "S", "W"}));
  EXPECT_EQ(exits({44, 130, 226, 350}), (Sides{"NE", "SE", "SW", "N"}));
}

TEST(Sides, OfTwoThatLeadToOneSideTheNearerHasItAndTheirOrderStays) {
  EXPECT_EQ(exits({80, 92}), (Sides{"NE", "E"}));
  EXPECT_EQ(exits({350, 5, 180}), (Sides{"NW", "N", "S"}));
  EXPECT_EQ(exits({1, 2, 3, 4, 5, 6, 7, 8}).size(), 8u);
}

TEST(Sides, AreDifferentAndInTheOrderOfTheRoads) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> degrees;
    for (std::size_t i = 0; i < 1 + random() % 8; ++i) degrees.push_back(static_cast<double>(random() % 3'600) / 10.0);
    std::sort(degrees.begin(), degrees.end());
    const Sides sides = exits(degrees);
    ASSERT_EQ(sides.size(), degrees.size());
    std::size_t before = 0, turns = 0;
    for (std::size_t i = 0; i <= sides.size(); ++i) {   // once round, and no side twice
      const auto side = static_cast<std::size_t>(std::find(std::begin(kSides), std::end(kSides), sides[i % sides.size()]) - std::begin(kSides));
      if (i > 0 && side <= before) ++turns;
      before = side;
    }
    EXPECT_EQ(turns, 1u) << "round " << round;
  }
}

/// The ways of a layout as text, `A-B>` with what goes on, and bends as their number.
std::string ways_text(const Layout& layout) {
  std::string text;
  for (const Way& way : layout.ways) {
    text += (text.empty() ? "" : " ") + way.from + "-" + way.to + (way.through.empty() ? "" : std::to_string(way.through.size())) + (way.goes_on ? ">" : "");
  }
  return text;
}

Layout row_of_places() {
  Layout layout;
  for (const auto& [id, x, y] : {std::tuple("A", 0.0, 0.0), {"B", 4.0, 0.14}, {"C", 8.0, -0.16}, {"D", 12.0, 0.0}, {"D2", 12.0, 0.0}}) {
    layout.places.push_back({id, "", {x, y}, {}});
  }
  return layout;
}

Layout joined(const Layout& layout) {
  File file("");
  Adaptations adaptations;
  return joined(layout, adaptations, file.diagnostics).value();
}

/// The roads of one way from A to B, and of one back.
std::vector<Road> roads_there_and_back(const std::vector<Point>& there, const std::vector<Point>& back) {
  File file("");
  Adaptations adaptations;
  Layout layout{"", {{"A", "", {0.0, 0.0}, {}}, {"B", "", {10.0, 0.0}, {}}}, {{"", "A", "B", there, false, {}, {}}, {"", "B", "A", back, false, {}, {}}}};
  return roads_of(joined(layout), adaptations, file.diagnostics).value();
}

TEST(Roads, ThereAndBackAreOneToAMillimetre) {
  EXPECT_EQ(roads_there_and_back({{5, 0}}, {{5, 0.0008}}).size(), 1u);   // one bend is none, the other is one
  EXPECT_EQ(roads_there_and_back({{3, 1}, {5, 1}, {7, 1}}, {{7, 1}, {5, 1.0008}, {3, 1}}).size(), 1u);
  EXPECT_EQ(roads_there_and_back({{5, 0}}, {{5, 0.002}}).size(), 2u);
  EXPECT_EQ(roads_there_and_back({{3, 1}, {7, 1}}, {{7, -1}, {3, -1}}).size(), 2u);
  EXPECT_EQ(roads_there_and_back({{3, 1}, {7, 1}}, {{3, 1}, {7, 1}}).size(), 2u);   // the bends in another order
}

// Two places near one bend: each is where the way is nearest to it, there and back.
TEST(Joined, PlacesBesideABendComeInTheOrderOfTheWay) {
  Layout layout;
  for (const auto& [id, x, y] : {std::tuple("P", -5.0, 0.0), {"R", 0.0, -5.0}, {"B", 0.1, 0.05}, {"D", 0.05, -0.14}}) {
    layout.places.push_back({id, "", {x, y}, {}});
  }
  layout.ways = {{"", "P", "R", {{0, 0}}, false, {}, {}}, {"", "R", "P", {{0, 0}}, false, {}, {}}};
  EXPECT_EQ(ways_text(joined(layout)), "P-B> B-D> D-R R-D> D-B> B-P");
}

TEST(Joined, AWayLeadsToThePlacesThatItRunsOverToFifteenCentimetres) {
  Layout layout = row_of_places();
  layout.ways = {{"there", "A", "D", {}, false, {}, {}}, {"back", "D2", "A", {}, false, {}, {}}, {"", "A", "B", {}, false, {}, {}}};
  EXPECT_EQ(ways_text(joined(layout)), "A-B> B-D D-B> B-A A-B");
}

TEST(Joined, BendsStayButThoseAtThePlaces) {
  Layout layout = row_of_places();
  layout.ways = {{"", "A", "D", {{2, 3}, {4, 0.1}, {6, 3}, {8, -0.1}, {10, 3}}, false, {}, {}}};
  EXPECT_EQ(ways_text(joined(layout)), "A-B1> B-C1> C-D1");
}

TEST(Joined, OneSpotIsOnePlaceByTheNamesOfAll) {
  const Layout layout = joined(row_of_places());
  ASSERT_EQ(layout.places.size(), 4u);
  EXPECT_EQ(layout.places[3].also, std::vector<std::string>{"D2"});
}

TEST(Joined, OneSpotIsFiveCentimetresLarge) {
  Layout layout;
  for (const auto& [id, x, y] : {std::tuple("A", 0.0, 0.0), {"A2", -0.03, -0.03}, {"A3", 0.0499, 0.0}, {"B", 0.0, 0.051}, {"B2", -0.03, 0.07}, {"C", 1e300, 0.0}, {"C2", 1e300, 0.0}}) {
    layout.places.push_back({id, "", {x, y}, {}});
  }
  layout = joined(layout);
  ASSERT_EQ(layout.places.size(), 3u);
  EXPECT_EQ(layout.places[0].also, (std::vector<std::string>{"A2", "A3"}));
  EXPECT_EQ(layout.places[1].also, std::vector<std::string>{"B2"});
  EXPECT_EQ(layout.places[2].also, std::vector<std::string>{"C2"});
}

}  // namespace
}  // namespace kb::layout
