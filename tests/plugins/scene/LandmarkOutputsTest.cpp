// Tests how outputs show landmarks, whatever plugin they belong to.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CText.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/LevelFrame.h>
#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/derived/SceneLandmarks.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/LandmarkShape.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/ShapedRun.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "report/ReportOutput.h"
#include "run_files/SummaryOutput.h"
#include "scene/PointsOutput.h"
#include "scene/SceneOutput.h"

namespace landmark_outputs_test {
namespace {

using namespace shaped_run;
using omnimapper::testing::ScratchFolder;

TEST(LandmarkShapes, areThoseOfWhatIsThereAndOfWhatMovedButNotOfWhatWasMerged) {
  const RunRecord run = shapedRun();
  const auto shapes = derived::shapesOf(run.view());
  ASSERT_EQ(shapes.size(), 5u);
  EXPECT_EQ(shapes[0].landmark->id, (base::LandmarkId{0, 0}));
  EXPECT_FALSE(shapes[0].moved);
  EXPECT_TRUE(shapes[4].moved);
  EXPECT_DOUBLE_EQ(derived::areaOf(shapes[0].shape), 8);
  EXPECT_DOUBLE_EQ(derived::lengthOf(shapes[1].shape), 3);
  EXPECT_DOUBLE_EQ(derived::areaOf(shapes[2].shape), 0.75);
  EXPECT_DOUBLE_EQ(derived::boxOf(shapes[0].shape).max().z(), 2);
  EXPECT_TRUE(derived::boxOf({}).isEmpty());
  EXPECT_EQ(derived::sensorsText(shapes[0].shape.seen_by), "kinect and laser");
  EXPECT_EQ(derived::sensorsText(shapes[1].shape.seen_by), "laser only");
  EXPECT_EQ(derived::sensorsText(shapes[3].shape.seen_by), "");
}

// A box of 1 x 2 x 3 m, turned by 90 deg about z, and a mesh: what objects are made of.
TEST(LandmarkShapes, boxesAndMeshesHaveExtentsPlansAndTriangles) {
  map::LandmarkShape box, mesh;
  box.box = map::Box{{5, 6, 7}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ())), {1, 2, 3}};
  const auto extent = derived::boxOf(box);
  EXPECT_LT((extent.min() - Vector3d(4, 5.5, 5.5)).norm(), 1e-12) << extent.min().transpose();
  EXPECT_LT((extent.max() - Vector3d(6, 6.5, 8.5)).norm(), 1e-12) << extent.max().transpose();
  EXPECT_EQ(derived::referencePoint(box), Vector3d(5, 6, 7));
  double surface = 0;
  for (const auto& face : derived::facesOf(*box.box)) {
    const Vector3d outwards = geometry::areaVector(face);
    surface += outwards.norm();
    EXPECT_GT(outwards.dot(face.vertices.front() - box.box->middle), 0) << "counter-clockwise from outside";
  }
  EXPECT_NEAR(surface, 2 * (1 * 2 + 2 * 3 + 1 * 3), 1e-12);
  const auto plan = derived::fromAbove(box);
  ASSERT_EQ(plan.areas.size(), 1u);
  EXPECT_NEAR(derived::doubledArea(plan.areas[0]), 2 * 2, 1e-12);
  mesh.mesh = std::make_shared<const map::Mesh>(map::Mesh{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{{0, 1, 2}}}});
  EXPECT_EQ(derived::referencePoint(mesh), Vector3d(1, 1, 0));
  map::Map lying;
  lying.layers.set(map::Level{map::Level::Source::planes, Vector3d::UnitX(), Eigen::Matrix3d::Zero(), ""});
  const derived::LevelFrame level(lying);
  const auto turned = level(std::vector<derived::ShapedLandmark>{{nullptr, box}, {nullptr, mesh}});
  EXPECT_LT((derived::referencePoint(turned[0].shape) - level(Vector3d(5, 6, 7))).norm(), 1e-12);
  EXPECT_NEAR(derived::boxOf(turned[0].shape).sizes().z(), extent.sizes().x(), 1e-9) << "x of the map is up";
  EXPECT_LT((turned[1].shape.mesh->vertices[1] - level(Vector3d(3, 0, 0))).norm(), 1e-12);
  RunRecord run = shapedRun();
  const auto before = derived::landmarkTriangles(derived::shapesOf(run.view())).size();
  add(run, "thing", box);
  EXPECT_EQ(derived::landmarkTriangles(derived::shapesOf(run.view())).size(), before + 12);
  add(run, "thing", mesh);
  EXPECT_EQ(derived::landmarkTriangles(derived::shapesOf(run.view())).size(), before + 13);
}

TEST(LandmarkShapes, areCountedByLabelAndThoseWithNumbersByKind) {
  RunRecord run = shapedRun();
  map::LandmarkShape marker;
  for (const char* label : {"marker 3", "marker 12", "marker"}) {
    marker.label = label;
    add(run, "marker", marker);
  }
  add(run, "beacon", {});
  const std::map<std::string, std::size_t> expected{
      {"wall", 2}, {"table", 1}, {"floor", 1}, {"marker", 3}, {"beacon", 1}};
  EXPECT_EQ(mapper::countLandmarks(run.view()), expected) << "neither what has moved nor what was merged";
  const ScratchFolder folder;
  plugins::SummaryOutput({}, contextFor(folder.path())).finish(run.view());
  EXPECT_EQ(nlohmann::json::parse(contentOf(folder / "summary.json"))["landmarks"], nlohmann::json(expected));
}

TEST(LandmarkShapes, whatIsNotFiniteOrHasNoAreaIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  RunRecord run = boxRun();
  map::LandmarkShape shape;
  shape.surfaces = {
      {{{0, 0, 0}, {1, 0, nan}, {1, 1, 0}}}, {{{0, 0, 0}, {1, 0, 0}}}, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}};
  shape.lines = {{{0, 0, 0}, {infinity, 0, 0}}};
  shape.points = {{nan, 0, 0}, {1, 2, 3}};
  shape.point_stamps = {at(0), at(1)};
  shape.normal = Vector3d(0, 0, nan);
  shape.box = map::Box{{0, 0, nan}, Eigen::Quaterniond::Identity(), {1, 1, 1}};
  shape.mesh = std::make_shared<const map::Mesh>(map::Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 3}}}});
  add(run, "beacon", shape);
  run.map.landmarks.edit(add(run, "bare", {}))->payload = nullptr;
  const auto shapes = derived::shapesOf(run.view());
  ASSERT_EQ(shapes.size(), 2u);
  const auto& kept = shapes[0].shape;
  EXPECT_TRUE(kept.surfaces.empty());
  EXPECT_TRUE(kept.lines.empty());
  ASSERT_EQ(kept.points.size(), 1u);
  EXPECT_EQ(kept.point_stamps, std::vector<base::Stamp>{at(1)});
  EXPECT_FALSE(kept.normal);
  EXPECT_FALSE(kept.box);
  EXPECT_FALSE(kept.mesh) << "a corner is missing";
  EXPECT_EQ(kept.label, "beacon") << "its kind, if a payload has no label";
  EXPECT_FALSE(shapes[1].isSomewhere());
}

TEST(PlanShape, anUprightSurfaceIsTheLineItStandsOnAndALevelOneAnAreaCounterClockwise) {
  const auto of_wall = derived::fromAbove(wall());
  ASSERT_EQ(of_wall.lines.size(), 1u);
  EXPECT_TRUE(of_wall.areas.empty());
  const auto& [from, to] = of_wall.lines.front();
  EXPECT_NEAR(std::abs(from.x() - to.x()), 4, 1e-12);
  EXPECT_NEAR(from.y(), 2, 1e-12);
  EXPECT_NEAR(to.y(), 2, 1e-12);
  const auto of_table = derived::fromAbove(table());
  ASSERT_EQ(of_table.areas.size(), 1u);
  EXPECT_EQ(of_table.areas.front().size(), 6u);
  EXPECT_NEAR(derived::doubledArea(of_table.areas.front()), 1.5, 1e-12);
  map::LandmarkShape post;
  post.lines = {{{1, 1, 0}, {1, 1, 2}}};
  EXPECT_EQ(derived::fromAbove(post).points.size(), 1u);
}

TEST(PlanShape, dashesBeginAndEndALineAndAreAboutAsLongAsAsked) {
  const auto dashes = derived::dashesOf(1, 0.1);
  EXPECT_EQ(dashes.front().first, 0);
  EXPECT_NEAR(dashes.back().second, 1, 1e-12);
  EXPECT_NEAR(dashes.front().second, 0.1, 0.02);
  EXPECT_EQ(derived::dashesOf(0.05, 0.1).size(), 1u) << "a short line is one dash";
}

TEST(SceneOutput, everyLandmarkIsAnObjectWithItsName) {
  ScratchFolder folder;
  plugins::SceneOutput({}, contextFor(folder.path())).finish(shapedRun().view());
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder / "scene.3Dscene"));
  const auto landmarks = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName("landmarks"));
  ASSERT_TRUE(landmarks);
  EXPECT_EQ(landmarks->size(), 5u);
  const auto table = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(landmarks->getByName("table 0:2"));
  ASSERT_TRUE(table);
  const auto surface = table->getByClass<mrpt::opengl::CSetOfTriangles>(0);
  ASSERT_TRUE(surface);
  EXPECT_LT(surface->getColor_u8().A, 128) << "translucent";
  const auto box = surface->getBoundingBox();
  EXPECT_NEAR(box.min.y, -0.9, 1e-5);
  EXPECT_NEAR(box.max.x, 1, 1e-5);
  EXPECT_NEAR(box.max.z, 0.7, 1e-5);
  EXPECT_EQ(table->getByClass<mrpt::opengl::CText>()->getString(), "table 2");
  const auto chair = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(landmarks->getByName("chair 0:4"));
  EXPECT_EQ(chair->getByClass<mrpt::opengl::CText>()->getString(), "chair 4 (moved)");
}

TEST(SceneOutput, namesOfLandmarksAreLeftOutOnRequest) {
  ScratchFolder folder;
  plugins::SceneOptions options;
  options.names = false;
  plugins::SceneOutput(options, contextFor(folder.path())).finish(shapedRun().view());
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder / "scene.3Dscene"));
  const auto landmarks = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName("landmarks"));
  EXPECT_FALSE(landmarks->getByClass<mrpt::opengl::CText>());
}

struct Mesh {
  std::vector<Vector3d> vertices;
  std::vector<std::array<int, 3>> faces;
  double area = 0;
};

Mesh readMesh(const std::string& path) {
  const std::string bytes = contentOf(path);
  const std::size_t start = bytes.find("end_header\n") + 11;
  Mesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(numberAfter(bytes, "element vertex ")));
  mesh.faces.resize(static_cast<std::size_t>(numberAfter(bytes, "element face ")));
  EXPECT_EQ(bytes.size(), start + 15 * mesh.vertices.size() + 13 * mesh.faces.size());
  const char* at = bytes.data() + start;
  for (auto& vertex : mesh.vertices) {
    float xyz[3];
    std::memcpy(xyz, at, sizeof xyz);
    vertex = {xyz[0], xyz[1], xyz[2]};
    at += 15;
  }
  for (auto& face : mesh.faces) {
    EXPECT_EQ(*at, 3);
    std::memcpy(face.data(), at + 1, 12);
    at += 13;
    for (const int corner : face) EXPECT_LT(static_cast<std::size_t>(corner), mesh.vertices.size());
    const auto& a = mesh.vertices[face[0]];
    mesh.area += 0.5 * (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).norm();
  }
  return mesh;
}

TEST(PointsOutput, landmarksAreAMeshOfTheirOwn) {
  ScratchFolder folder;
  plugins::PointsOutput({}, contextFor(folder.path())).finish(shapedRun().view());
  const double strokes = 2 * 3 * 0.05;  // the laser's wall, as two crossed strips
  EXPECT_NEAR(readMesh(folder / "landmarks.ply").area, 8 + 0.75 + 12 + strokes, 1e-4) << "without what has moved";
  EXPECT_TRUE(std::filesystem::exists(folder / "points.ply"));
}

class LandmarkReport : public ::testing::Test {
 protected:
  LandmarkReport() {
    plugins::ReportOutput({}, contextFor(folder_.path())).finish(shapedRun().view());
    html_ = contentOf(folder_ / "report.html");
  }
  std::string between(const std::string& begin, const std::string& end) const {
    const std::size_t first = html_.find(begin);
    EXPECT_NE(first, std::string::npos) << begin;
    return html_.substr(first, html_.find(end, first) - first);
  }
  ScratchFolder folder_;
  std::string html_;
};

TEST_F(LandmarkReport, theTableStatesWhatEachIsAndWhichSensorsMeasuredIt) {
  const std::string landmarks = between("id=\"landmarks\"", "</table>");
  EXPECT_NE(landmarks.find("kinect 3, laser 9</td><td class=\"num\">0.0</td><td class=\"num\">2.0</td>"),
            std::string::npos)
      << landmarks;
  EXPECT_NE(landmarks.find("<td>plane</td><td class=\"num\">1.00</td><td class=\"num\">2.00</td><td class=\"num\">1.00"
                           "</td><td class=\"num\">8.00</td>"),
            std::string::npos)
      << "x, y, z of the middle, area";
  EXPECT_NE(landmarks.find("<td class=\"num\">3.00</td>"), std::string::npos);
  EXPECT_NE(landmarks.find("<td>moved</td>"), std::string::npos);
  EXPECT_NE(landmarks.find("top oak &lt;old&gt;"), std::string::npos);
  EXPECT_LT(landmarks.find(">0:4<"), landmarks.find(">0:0<")) << "those seen most often first";
  EXPECT_EQ(landmarks.find(">0:5<"), std::string::npos) << "merged";
}

TEST_F(LandmarkReport, theBarsCountTheSensors) {
  const std::string bars = between("Landmarks by the sensors", "</figure>");
  for (const char* sensors : {"kinect and laser", "kinect only", "laser only"})
    EXPECT_NE(bars.find(sensors), std::string::npos) << sensors;
}

TEST_F(LandmarkReport, theMapHasALayerForEachLabelAndFloorsAreHiddenAtFirst) {
  const std::string map = between("<svg id=\"map\"", "</svg>");
  EXPECT_NE(map.find("wall 0:0: 10 measurements\narea_m2 8.000"), std::string::npos);
  EXPECT_NE(map.find("table 0:2"), std::string::npos);
  EXPECT_NE(map.find("chair 0:4 (moved)"), std::string::npos);
  const std::size_t floor = map.find("floor 0:3"), group = map.rfind("<g class=\"landmarks ", floor);
  EXPECT_LT(map.find("display:none", group), floor);
}

TEST_F(LandmarkReport, thePictureShowsWallsAndTablesWhereTheyAre) {
  const double scale = numberAfter(html_, "data-metres-per-pixel=\""), min_x = numberAfter(html_, "data-min-x=\""),
               max_y = numberAfter(html_, "data-max-y=\"");
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile(folder_ / "map.png"));
  const auto colourAt = [&](double x, double y) {
    const auto column = static_cast<unsigned>((x - min_x) / scale), row = static_cast<unsigned>((max_y - y) / scale);
    return std::array<int, 3>{picture.at<std::uint8_t>(column, row, 2), picture.at<std::uint8_t>(column, row, 1),
                              picture.at<std::uint8_t>(column, row, 0)};
  };
  EXPECT_EQ(colourAt(1, 2), (std::array<int, 3>{180, 83, 9})) << "a wall";
  EXPECT_EQ(colourAt(3, 0), (std::array<int, 3>{180, 83, 9})) << "a wall of the laser alone";
  const auto table = colourAt(0.8, -0.7), notch = colourAt(0.8, -0.1);
  EXPECT_GT(table[2], table[1] + 20) << "violet";
  EXPECT_EQ(notch[1], notch[2]) << "what a concave table leaves free, above a floor that is not drawn";
}

TEST(Report, manyLandmarksAreCutWithANote) {
  ScratchFolder folder;
  RunRecord run = boxRun();
  for (int i = 0; i < 230; ++i) add(run, "plane", wall());
  plugins::ReportOutput({}, contextFor(folder.path())).finish(run.view());
  const std::string html = contentOf(folder / "report.html");
  EXPECT_NE(html.find("200 of 230 landmarks are listed, those seen most often; 30 more"), std::string::npos);
}

TEST(Report, aMapOfNothingButLandmarksIsDrawn) {
  ScratchFolder folder;
  RunRecord run;
  add(run, "plane", wall());
  plugins::ReportOutput({}, contextFor(folder.path())).finish(run.view());
  EXPECT_TRUE(std::filesystem::exists(folder / "map.png"));
  EXPECT_NE(contentOf(folder / "report.html").find("wall 0:0"), std::string::npos);
}

}  // namespace
}  // namespace landmark_outputs_test
