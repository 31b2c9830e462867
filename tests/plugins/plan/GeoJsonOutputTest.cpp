// Checks floorplan.geojson against the rules of RFC 7946.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>
#include <omnimapper/testing/ShapedRun.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "plan/GeoJsonOutput.h"

namespace geo_json_output_test {
namespace {

using namespace shaped_run;
using nlohmann::json;
using omnimapper::testing::ScratchFolder;

json floorPlanOf(const mapper::View& view, const plugins::GeoJsonOptions& options = {}) {
  ScratchFolder folder;
  plugins::GeoJsonOutput(options, contextFor(folder.path())).finish(view);
  return json::parse(contentOf(folder / "floorplan.geojson"));
}

json featureOf(const json& collection, const std::string& id) {
  for (const auto& feature : collection["features"])
    if (feature["id"] == id) return feature;
  ADD_FAILURE() << "no feature " << id;
  return nullptr;
}

void expectPosition(const json& position) {
  ASSERT_EQ(position.size(), 2u);
  for (const auto& number : position) ASSERT_TRUE(number.is_number()) << "JSON has no NaN: it would be null";
}

void expectLine(const json& line) {
  EXPECT_GE(line.size(), 2u);
  for (const auto& position : line) expectPosition(position);
}

// Section 3.1.6: a ring is closed and has at least four positions; an exterior ring is counter-clockwise.
void expectPolygon(const json& polygon) {
  ASSERT_EQ(polygon.size(), 1u);
  const auto& ring = polygon[0];
  ASSERT_GE(ring.size(), 4u);
  EXPECT_EQ(ring.front(), ring.back());
  double doubled = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    expectPosition(ring[i]);
    doubled += ring[i - 1][0].get<double>() * ring[i][1].get<double>() -
               ring[i][0].get<double>() * ring[i - 1][1].get<double>();
  }
  EXPECT_GT(doubled, 0) << "counter-clockwise";
}

void expectGeometry(const json& geometry) {
  const std::string type = geometry["type"];
  if (type == "GeometryCollection") {
    for (const auto& part : geometry["geometries"]) expectGeometry(part);
    return;
  }
  const auto& coordinates = geometry["coordinates"];
  if (type == "Point") return expectPosition(coordinates);
  if (type == "LineString") return expectLine(coordinates);
  if (type == "Polygon") return expectPolygon(coordinates);
  ASSERT_EQ(type.rfind("Multi", 0), 0u) << type;
  for (const auto& part : coordinates) expectGeometry({{"type", type.substr(5)}, {"coordinates", part}});
}

void expectRfc7946(const json& collection) {
  EXPECT_EQ(collection["type"], "FeatureCollection");
  EXPECT_FALSE(collection.contains("crs"));
  EXPECT_FALSE(collection.contains("coordinates"));
  std::set<std::string> ids;
  for (const auto& feature : collection["features"]) {
    EXPECT_EQ(feature["type"], "Feature");
    EXPECT_TRUE(feature["properties"].is_object());
    EXPECT_TRUE(ids.insert(feature["id"]).second) << feature["id"];
    expectGeometry(feature["geometry"]);
  }
}

TEST(GeoJsonOutput, aMapIsAFeatureCollectionOfItsLandmarksAndItsTrajectory) {
  const RunRecord run = shapedRun();
  const json plan = floorPlanOf(run.view());
  expectRfc7946(plan);
  EXPECT_EQ(plan["features"].size(), 6u);
  EXPECT_EQ(plan["name"], "box <world>");
  const json wall = featureOf(plan, "0:0"), line = featureOf(plan, "0:1"), table = featureOf(plan, "0:2");
  EXPECT_EQ(wall["geometry"]["type"], "LineString");
  EXPECT_EQ(wall["geometry"]["coordinates"].size(), 2u);
  EXPECT_EQ(line["geometry"]["coordinates"], json::parse("[[3.0, -1.0], [3.0, 2.0]]"));
  EXPECT_EQ(table["geometry"]["type"], "Polygon");
  EXPECT_EQ(table["geometry"]["coordinates"][0].size(), 7u);
  EXPECT_EQ(featureOf(plan, "session 0")["geometry"]["coordinates"].size(), 3u);
}

TEST(GeoJsonOutput, propertiesAreNumbersWhereTheyAreNumbers) {
  const RunRecord run = shapedRun();
  const json plan = floorPlanOf(run.view());
  const json wall = featureOf(plan, "0:0")["properties"];
  EXPECT_EQ(wall["label"], "wall");
  EXPECT_EQ(wall["state"], "present");
  EXPECT_EQ(wall["measurements"], 10);
  EXPECT_EQ(wall["area_m2"], 8);
  EXPECT_EQ(wall["seen_by_laser"], 9);
  EXPECT_EQ(wall["bottom_m"], 0);
  EXPECT_EQ(wall["top_m"], 2);
  EXPECT_EQ(wall["first_seen"], "2001-09-09T01:46:40.000Z");
  EXPECT_EQ(featureOf(plan, "0:2")["properties"]["top"], "oak <old>");
}

TEST(GeoJsonOutput, whatMovedIsItsWayWithTheTimes) {
  const RunRecord run = shapedRun();
  const json chair = featureOf(floorPlanOf(run.view()), "0:4");
  EXPECT_EQ(chair["geometry"], json::parse(R"({"type": "LineString", "coordinates": [[2.5, 0.0], [2.5, 0.8]]})"));
  EXPECT_EQ(chair["properties"]["state"], "moved");
  EXPECT_EQ(chair["properties"]["times"], json::parse(R"(["2001-09-09T01:46:40.000Z", "2001-09-09T01:46:42.000Z"])"));
}

TEST(GeoJsonOutput, severalPartsAreOneGeometryAndWhatIsNoneFromAboveIsLeftOut) {
  RunRecord run = boxRun();
  map::LandmarkShape shelf = table();
  shelf.surfaces.push_back(shelf.surfaces.front());
  for (auto& corner : shelf.surfaces.back().vertices) corner.x() += 5;
  shelf.points = {{0, 0, 0}, {1, 1, 0}};
  add(run, "shelf", shelf);
  map::LandmarkShape speck;
  speck.surfaces = {{{{0, 0, 0}, {1e-4, 0, 0}, {0, 1e-4, 0}}}};
  add(run, "speck", speck);
  add(run, "nothing", {});
  const json plan = floorPlanOf(run.view());
  expectRfc7946(plan);
  ASSERT_EQ(plan["features"].size(), 1u);
  const auto& parts = plan["features"][0]["geometry"]["geometries"];
  EXPECT_EQ(parts[0]["type"], "MultiPolygon");
  EXPECT_EQ(parts[1]["type"], "MultiPoint");
}

TEST(GeoJsonOutput, theWayIsLeftOutOnRequest) {
  plugins::GeoJsonOptions options;
  options.trajectory = false;
  const RunRecord run = shapedRun();
  EXPECT_EQ(floorPlanOf(run.view(), options)["features"].size(), 5u);
}

TEST(GeoJsonOutput, anEmptyMapIsAnEmptyCollection) {
  const json plan = floorPlanOf(RunRecord().view());
  expectRfc7946(plan);
  EXPECT_TRUE(plan["features"].empty());
}

// One metre at the equator: along it to the east, and along the meridian with its radius of curvature there.
TEST(GeoJsonOutput, whereTheMapKnowsItsPlaceItIsLongitudeAndLatitude) {
  constexpr double kRadius = 6378137, kSquaredEccentricity = 6.69437999014e-3, kDegree = M_PI / 180;
  RunRecord run = shapedRun();
  // The map's x axis points to the north, and its origin is 10 m north of the origin of the east-north-up frame.
  const auto map_from_enu = run.graph.addVariable(graph::se2(), graph::toValue(geometry::Se2{-10, 0, -M_PI / 2}));
  run.map.layers.set("someone else's", std::make_shared<const map::RawLayer>(1, "bytes"));
  run.map.layers.set(mapper::PlaceOnEarth{map_from_enu, {0, 20, 100}});
  const json plan = floorPlanOf(run.view());
  expectRfc7946(plan);
  const json line = featureOf(plan, "0:1")["geometry"]["coordinates"];  // from (3, -1) to (3, 2)
  const double east = 1 / (kRadius * kDegree), north = 1 / (kRadius * (1 - kSquaredEccentricity) * kDegree);
  // 1 m is right to 1e-8 deg, and the origin is 100 m up, which shrinks angles by 1.6e-5.
  EXPECT_NEAR(line[0][0], 20 + 1 * east, 2e-8);
  EXPECT_NEAR(line[0][1], 13 * north, 2e-8);
  EXPECT_NEAR(line[1][0], 20 - 2 * east, 2e-8);
  EXPECT_NEAR(line[1][1], 13 * north, 2e-8);

  plugins::GeoJsonOptions options;
  options.metres = true;
  EXPECT_EQ(featureOf(floorPlanOf(run.view(), options), "0:1")["geometry"]["coordinates"][0][0], 3);
}

TEST(GeoJsonOutput, aPlaceWhoseVariableIsGoneIsNone) {
  RunRecord run = shapedRun();
  run.map.layers.set(mapper::PlaceOnEarth{{7, 7}, {0, 20, 100}});
  EXPECT_EQ(featureOf(floorPlanOf(run.view()), "0:1")["geometry"]["coordinates"][0][0], 3);
}

TEST(GeoJsonOutput, theGpsPluginGivesThePlace) {
  omnimapper::testing::SimulatedLogOptions options;
  options.lasers.clear();
  options.gps.on = true;
  const omnimapper::testing::SimulatedLog log(options);
  const auto engine = omnimapper::testing::makeEngine(
      "[mapper]\npose_plugins = odometry\nmeasurement_plugins = gps\n"
      "[odometry]\nclass = OdometryPlugin\n[gps]\nclass = GpsPlugin\n");
  omnimapper::testing::run(*engine, log.observations());
  const json plan = floorPlanOf(engine->view());
  expectRfc7946(plan);
  ASSERT_EQ(plan["features"].size(), 1u);
  mrpt::obs::CObservationGPS::Ptr first;
  for (const auto& observation : log.observations()) {
    first = std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(observation);
    if (first) break;
  }
  const auto& fix = first->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
  const auto& start = plan["features"][0]["geometry"]["coordinates"][0];
  constexpr double kMetreOrTwo = 2e-5;  // [deg]
  EXPECT_NEAR(start[0], fix.longitude_degrees, kMetreOrTwo);
  EXPECT_NEAR(start[1], fix.latitude_degrees, kMetreOrTwo);
}

}  // namespace
}  // namespace geo_json_output_test
