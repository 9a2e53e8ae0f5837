// A plant that was imported from a layout: what its nodes and edges are on the map that `kbc import` makes.
#include "tools/kbc/layout_plant.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "tools/kbc/layout_file.h"

namespace kb::cli {
namespace {

using vda5050::Visit;
using Way = std::vector<Visit>;

// Dock and dock/2 at one spot; `fast` runs over 7; two ways lead from Shelf to 7. 7 cannot be a name, and the name that it gets is an id already.
constexpr std::string_view kHall = R"({"layouts": [{"layoutId": "Hall",
  "nodes": [
    {"nodeId": "Dock",   "mapId": "hall-1", "nodePosition": {"x": 0, "y": 0}},
    {"nodeId": "dock/2", "nodePosition": {"x": 0, "y": 0}},
    {"nodeId": "7",      "mapId": "hall-1", "nodePosition": {"x": 4, "y": 0}},
    {"nodeId": "LM7",    "nodePosition": {"x": 4, "y": -4}},
    {"nodeId": "Shelf",  "nodePosition": {"x": 10, "y": 0}}],
  "edges": [
    {"edgeId": "hop",  "startNodeId": "Dock",   "endNodeId": "dock/2"},
    {"edgeId": "in",   "startNodeId": "Dock",   "endNodeId": "7"},
    {"edgeId": "fast", "startNodeId": "dock/2", "endNodeId": "Shelf"},
    {"edgeId": "near", "startNodeId": "Shelf",  "endNodeId": "7"},
    {"edgeId": "far",  "startNodeId": "Shelf",  "endNodeId": "7", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "trajectory":
      {"degree": 1, "knotVector": [0, 0, 0.3, 0.7, 1, 1],
       "controlPoints": [{"x": 10, "y": 0}, {"x": 10, "y": 4}, {"x": 4, "y": 4}, {"x": 4, "y": 0}]}}]},
    {"edgeId": "loop", "startNodeId": "Shelf",  "endNodeId": "Shelf", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "trajectory":
      {"degree": 1, "knotVector": [0, 0, 0.5, 1, 1], "controlPoints": [{"x": 10, "y": 0}, {"x": 12, "y": 3}, {"x": 10, "y": 0}]}}]},
    {"edgeId": "down", "startNodeId": "7",      "endNodeId": "LM7"}]}]})";

/// What `kbc import` makes of the hall, `changed` as somebody wishes, and the hall's master before it.
class Hall {
 public:
  using Change = std::string (*)(std::string map);
  explicit Hall(Change changed = nullptr) {
    diagnostics::ErrorLines lines(sources_, said_);
    diagnostics::Diagnostics messages(sources_, lines);
    layout::Adaptations adaptations;
    LayoutImport how{"lif", {}, {}};
    auto map = read_layout(how, sources_, sources_.add("hall.json", std::string(kHall)), adaptations, messages, session_);
    if (!map) throw std::runtime_error(said_);
    const std::string text = layout::write_map(*map, how.wording);
    compiled_ = session_.compile_text("hall.kb", changed == nullptr ? text : changed(text));
    floor_ = sim::lay_out(compiled_->model, {}, messages);
    if (!floor_) throw std::runtime_error(said_);
    plant.emplace(std::move(*map), *floor_, "hall-1", true, "LM");
  }
  /// What is said against the floor; empty: nothing.
  std::string fault() {
    diagnostics::ErrorLines lines(sources_, said_);
    diagnostics::Diagnostics messages(sources_, lines);
    const bool fits = plant->is_on_floor(messages);
    EXPECT_EQ(fits, !messages.failed());
    return said_;
  }
  std::optional<LayoutPlant> plant;

 private:
  Session session_{{.library = KB_PROJECT_ROOT "/stdlib_rules"}};
  source::Sources sources_;
  std::string said_;
  std::unique_ptr<driver::Compilation> compiled_;
  std::optional<sim::Labyrinth> floor_;
};

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::runtime_error(fmt::format("`{}` is not in\n{}", old, text));
  return text.replace(at, old.size(), by);
}

TEST(LayoutPlant, NodesAreTheLandmarksOfTheImportWhateverTheirIdsLookLike) {
  const Hall hall;
  EXPECT_EQ(hall.plant->landmark_of("Shelf"), "Shelf");
  EXPECT_EQ(hall.plant->landmark_of("7"), "LM7_2");
  EXPECT_EQ(hall.plant->landmark_of("LM7"), "LM7");
  EXPECT_EQ(hall.plant->node_at("LM7_2"), "7");
  EXPECT_EQ(hall.plant->node_at("LM7"), "LM7");
}

TEST(LayoutPlant, NodesAtOneSpotAreOneLandmarkAndTheFirstAnswersForIt) {
  const Hall hall;
  EXPECT_EQ(hall.plant->landmark_of("Dock"), "Dock");
  EXPECT_EQ(hall.plant->landmark_of("dock/2"), "Dock");
  EXPECT_EQ(hall.plant->node_at("Dock"), "Dock");
  EXPECT_EQ(hall.plant->way("hop", "Dock", "dock/2"), Way{});
}

// RoadPlant would take the landmark that an unknown id looks like.
TEST(LayoutPlant, AnIdThatTheLayoutHasNotIsNoLandmarkOfTheLayout) {
  const Hall hall;
  EXPECT_EQ(hall.plant->landmark_of("LM7_2"), std::nullopt);
  EXPECT_EQ(hall.plant->landmark_of("Dock/"), std::nullopt);
  EXPECT_EQ(hall.plant->way("in", "Dock", "LM7_2"), std::nullopt);
}

TEST(LayoutPlant, AnEdgeOverANodeGoesByItsLandmark) {
  const Hall hall;
  const Way over{{"Dock", "E"}, {"LM7_2", "E"}};
  EXPECT_EQ(hall.plant->way("fast", "dock/2", "Shelf"), over);
  EXPECT_EQ(hall.plant->way("fast", "Dock", "Shelf"), over);   // the same place by its other name
}

TEST(LayoutPlant, OfTwoEdgesBetweenTwoNodesTheIdSaysWhich) {
  const Hall hall;
  EXPECT_EQ(hall.plant->way("near", "Shelf", "7"), (Way{{"Shelf", "W"}}));
  EXPECT_EQ(hall.plant->way("far", "Shelf", "7"), (Way{{"Shelf", "N"}}));
}

TEST(LayoutPlant, AnEdgeOfNoSuchIdOrThatLeadsElsewhereIsNone) {
  const Hall hall;
  EXPECT_EQ(hall.plant->way("nearest", "Shelf", "7"), std::nullopt);
  EXPECT_EQ(hall.plant->way("", "Shelf", "7"), std::nullopt);
  EXPECT_EQ(hall.plant->way("in", "7", "Dock"), std::nullopt);
  EXPECT_EQ(hall.plant->way("near", "Shelf", "LM7"), std::nullopt);
  EXPECT_EQ(hall.plant->way("loop", "Shelf", "Shelf"), std::nullopt);
}

TEST(LayoutPlant, PositionsAreThoseOfTheLayout) {
  const Hall hall;
  const auto at = hall.plant->pose({{"LM7"}});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x_m, 4.0, 1e-9);
  EXPECT_NEAR(at->y_m, -4.0, 1e-9);
  const auto place = hall.plant->place_of("7");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->x_m, 4.0);
  EXPECT_EQ(place->y_m, 0.0) << "not that of the landmark `LM7`";
  EXPECT_FALSE(hall.plant->place_of("8"));
  EXPECT_EQ(hall.plant->map_id(), "hall-1");
}

TEST(LayoutPlant, ARobotOnARoadIsSoFarFromItsLandmarkAndFacesAlongIt) {
  const Hall hall;
  const vda5050::Whereabouts where{{"LM7_2", "E"}, 1.5, false};
  const auto at = hall.plant->pose(where);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x_m, 5.5, 1e-9);
  EXPECT_NEAR(at->y_m, 0.0, 1e-9);
  EXPECT_NEAR(std::abs(at->theta_rad), 3.14159, 1e-4);
}

TEST(LayoutPlant, ARobotStandsOnTheRoadThatItFacesAlong) {
  const Hall hall;
  const auto at = [&](double x_m, double y_m, double theta_rad) -> std::string {
    const auto standing = hall.plant->standing_at({x_m, y_m, theta_rad});
    if (!standing) return "";
    EXPECT_TRUE(standing->on.outwards);
    return standing->on.road.landmark + "." + standing->on.road.exit + ">" + standing->ahead;
  };
  EXPECT_EQ(at(6.0, 0.1, 0.3), "LM7_2.E>Shelf");
  EXPECT_EQ(at(6.0, 0.1, 3.0), "Shelf.W>LM7_2");
  EXPECT_EQ(at(7.0, 3.9, 3.1), "Shelf.N>LM7_2") << "the long way";
  EXPECT_EQ(at(7.0, 3.9, 0.0), "") << "against its direction";
  EXPECT_EQ(at(6.0, 0.1, 1.5), "") << "across";
  EXPECT_EQ(at(6.0, 0.6, 0.0), "") << "beside it";
  EXPECT_EQ(at(4.1, 0.0, 0.0), "") << "in the crossing";
  EXPECT_NEAR(hall.plant->standing_at({6.0, 0.1, 3.0})->on.along_m, 4.0, 1e-9);
}

TEST(LayoutPlant, OnlyARoadForBothWaysLeadsBack) {
  const Hall hall;
  EXPECT_TRUE(hall.plant->leads_back({"LM7_2", "E"}));
  EXPECT_TRUE(hall.plant->leads_back({"Shelf", "W"}));
  EXPECT_FALSE(hall.plant->leads_back({"Dock", "E"}));
  EXPECT_FALSE(hall.plant->leads_back({"Shelf", "N"}));
  EXPECT_FALSE(hall.plant->leads_back({"Shelf", "S"})) << "there is no such road";
}

TEST(LayoutPlant, LandmarksThatWereAddedToTheMapAreCalledByTheirNames) {
  Hall hall([](std::string map) { return replaced(map, "road ", "landmark Charger at (0, 4)\nroad Dock.N -- Charger.S by mark\nroad "); });
  EXPECT_EQ(hall.fault(), "");
  EXPECT_EQ(hall.plant->landmark_of("Charger"), "Charger");
  EXPECT_EQ(hall.plant->node_at("Charger"), "Charger");
  EXPECT_EQ(hall.plant->way("any", "dock/2", "Charger"), (Way{{"Dock", "N"}}));
}

TEST(LayoutPlant, AMapThatIsWhatTheImportMadeFitsIt) {
  EXPECT_EQ(Hall().fault(), "");
}

TEST(LayoutPlant, AMapWithoutALandmarkOfTheLayoutDoesNotFitIt) {
  Hall hall([](std::string map) {
    map = replaced(map, "landmark LM7 ", "landmark Pit ");
    return replaced(map, "LM7.N", "Pit.N");
  });
  const std::string fault = hall.fault();
  EXPECT_NE(fault.find("node `LM7` is its landmark `LM7`, which it has not"), std::string::npos) << fault;
}

TEST(LayoutPlant, AMapWhoseRoadLeadsTheOtherWayDoesNotFitIt) {
  Hall hall([](std::string map) { return replaced(map, "road Dock.E -> LM7_2.W", "road LM7_2.W -> Dock.E"); });
  const std::string fault = hall.fault();
  EXPECT_NE(fault.find("edge `in` leaves its landmark `Dock` by `E` for `LM7_2`, where it has no road"), std::string::npos) << fault;
}

TEST(LayoutPlant, ThePlantsMapIsThatOnWhichAllNodesAreThatSayOne) {
  layout::Layout layout;
  EXPECT_EQ(map_of(layout), "");
  for (const char* map : {"", "one", "", "one"}) layout.places.push_back({"", "", {}, {}, {}, map});
  EXPECT_EQ(map_of(layout), "one");
  layout.places.push_back({"", "", {}, {}, {}, "two"});
  EXPECT_EQ(map_of(layout), "");
}

}  // namespace
}  // namespace kb::cli
