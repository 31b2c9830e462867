// ini/home_planes.ini on half a minute in the simulated home: every output that shows a map shows walls and tables.
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <cmath>
#include <set>

#include "../MapFolder.h"
#include "TrueWalls.h"

namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::testing::sourceFile;

class LandmarkOutputs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<omnimapper::testing::ScratchFolder>();
    const auto ended = graphslam({"-i", sourceFile("ini/home_planes.ini"), "-r",
                                  sourceFile("rawlogs/home_30s/home_30s.rawlog"), "-o", file("")});
    ASSERT_TRUE(endedWith(ExitCode::ok, ended));
    said_ = ended.out;
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  static std::string file(const std::string& name) { return *scratch_ / "map/" + name; }

  static std::unique_ptr<omnimapper::testing::ScratchFolder> scratch_;
  static std::string said_;
};
std::string LandmarkOutputs::said_;
std::unique_ptr<omnimapper::testing::ScratchFolder> LandmarkOutputs::scratch_;

TEST_F(LandmarkOutputs, TheFloorPlanHasTheWallsWhereTheyAre) {
  const auto plan = json::parse(readFile(file("floorplan.geojson")));
  const auto world_from_map = omnimapper::geometry::toMrpt(
      omnimapper::eval::readTum(sourceFile("rawlogs/home_30s/truth.tum")).front().world_from_body);
  const auto walls = trueWalls("rawlogs/home_30s");
  const std::set<std::string> furniture{"table", "counter", "cabinet", "seat", "bed"};
  std::size_t long_walls = 0, tops = 0, floors = 0;
  for (const auto& feature : plan["features"]) {
    const auto& properties = feature["properties"];
    const std::string label = properties.value("label", ""), type = feature["geometry"]["type"];
    tops += furniture.count(label) > 0 && type == "Polygon";
    floors += label == "floor" && type == "Polygon";
    if (label != "wall" || properties["measurements"] < 10) continue;
    const auto ends = endsOf(feature["geometry"]);
    const auto along = [&](int axis) { return ends[1][axis].get<double>() - ends[0][axis].get<double>(); };
    if (std::hypot(along(0), along(1)) < 1.2) continue;  // may be furniture, whose planes are not in the truth
    ++long_walls;
    const double off = endsFromWalls(ends, world_from_map, walls);
    EXPECT_LT(off, 0.08) << feature["id"];
  }
  EXPECT_GE(long_walls, 5U) << "each wall is drawn once, and furniture is not drawn as wall";
  EXPECT_GT(tops, 0U);
  EXPECT_GT(floors, 0U);
  EXPECT_EQ(plan["features"].back()["properties"]["feature"], "trajectory");
}

TEST_F(LandmarkOutputs, TheSummaryCountsThemByLabel) {
  std::map<std::string, std::size_t> in_plan;
  const auto plan = json::parse(readFile(file("floorplan.geojson")));
  for (const auto& feature : plan["features"]) {
    if (feature["properties"].contains("label")) ++in_plan[feature["properties"]["label"]];
  }
  const auto landmarks = json::parse(readFile(file("summary.json")))["landmarks"];
  EXPECT_EQ(landmarks, json(in_plan));
  const std::string walls = "landmarks         " + landmarks["wall"].dump() + " wall, ";
  EXPECT_NE(said_.find(walls), std::string::npos) << said_;
}

TEST_F(LandmarkOutputs, TheSceneHasTheirSurfaces) {
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(file("scene.3Dscene")));
  const auto landmarks = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName("landmarks"));
  ASSERT_TRUE(landmarks);
  std::size_t surfaces = 0;
  auto box = mrpt::math::TBoundingBox::PlusMinusInfinity();
  for (const auto& object : *landmarks) {
    const auto& landmark = dynamic_cast<const mrpt::opengl::CSetOfObjects&>(*object);
    const auto first = landmark.getByClass<mrpt::opengl::CSetOfTriangles>(0);
    if (!first || first->getColor_u8().A >= 128) continue;
    ++surfaces;
    box = box.unionWith(first->getBoundingBox());
  }
  EXPECT_GT(surfaces, 10U);
  EXPECT_GT(box.max.x - box.min.x, 5) << "rooms";
  EXPECT_LT(box.max.x - box.min.x, 25);
  EXPECT_LT(box.max.z - box.min.z, 3);
}

TEST_F(LandmarkOutputs, TheMeshHasAsManyFacesAsItSays) {
  const std::string mesh = readFile(file("landmarks.ply"));
  const auto after = [&](const std::string& words) {
    return std::stoul(mesh.substr(mesh.find(words) + words.size(), 9));
  };
  const std::size_t start = mesh.find("end_header\n") + 11;
  EXPECT_GT(after("element face "), 50U);
  EXPECT_EQ(mesh.size(), start + 15 * after("element vertex ") + 13 * after("element face "));
}

TEST_F(LandmarkOutputs, TheReportListsAndDrawsThem) {
  const std::string report = readFile(file("report.html"));
  const std::size_t table = report.find("id=\"landmarks\"");
  ASSERT_NE(table, std::string::npos);
  const std::string rows = report.substr(table, report.find("</table>", table) - table);
  for (const char* part : {"wall</td><td>plane", "cabinet</td><td>plane", "kinect ", "laser "})
    EXPECT_NE(rows.find(part), std::string::npos) << part;
  for (const char* part : {"Landmarks by the sensors that saw them", "kinect and laser", "laser only", "kinect only",
                           "Landmarks measured from each key frame", "class=\"landmarks "})
    EXPECT_NE(report.find(part), std::string::npos) << part;
  mrpt::img::CImage picture;
  EXPECT_TRUE(picture.loadFromFile(file("map.png")));
}

}  // namespace
