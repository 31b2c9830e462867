#include <gtest/gtest.h>
#include <omnimapper/eval/ObjectMapQuality.h>

#include <nlohmann/json.hpp>
#include <string>

namespace omnimapper::eval::object_map_quality_test {
namespace {

using Eigen::Vector3d;
using Is = JudgedObject::Is;
using State = MappedObject::State;

constexpr double kBegin = 1700000000;

// A box of these sides with the middle of its lowest face at the origin.
TriangleMesh boxMesh(const Vector3d& sides) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 0.5 : -0.5) * sides.x(), (i & 2 ? 0.5 : -0.5) * sides.y(),
                               i & 4 ? sides.z() : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Points on the top and on the four sides of such a box, `out` [m] outside of it.
std::vector<Vector3d> pointsOnBox(const Vector3d& sides, const Vector3d& at, double out = 0) {
  std::vector<Vector3d> points;
  constexpr int kSteps = 10;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double a = i / double(kSteps) - 0.5, b = k / double(kSteps) - 0.5, up = (b + 0.5) * sides.z();
      points.push_back(at + Vector3d(a * sides.x(), b * sides.y(), sides.z() + out));
      for (const int side : {-1, 1}) {
        points.push_back(at + Vector3d(a * sides.x(), side * (0.5 * sides.y() + out), up));
        points.push_back(at + Vector3d(side * (0.5 * sides.x() + out), a * sides.y(), up));
      }
    }
  }
  return points;
}

const Vector3d kSides(0.2, 0.1, 0.1);

MappedObject mapped(const std::string& id, const Vector3d& at, State state = State::present, double out = 0) {
  MappedObject object;
  object.id = id;
  object.state = state;
  object.map_from_box.translation = at + Vector3d(0, 0, 0.05);
  object.box_size = kSides;
  object.seen_in = 30;
  object.points = pointsOnBox(kSides, at, out);
  return object;
}

// Three boxes on a floor, of which 40 images show enough; the third is carried off after 50 of 100 s.
struct Scene {
  ObjectTruth truth;
  ObjectMap map;

  Scene() {
    truth.begin = kBegin;
    truth.end = kBegin + 100;
    for (const char* name : {"cup", "box", "can"}) {
      TrueObject object;
      object.name = object.shape = name;
      const double x = static_cast<double>(truth.objects.size());
      object.places.push_back({0, "floor", false, geometry::Se3{Eigen::Quaterniond::Identity(), {x, 0, 0}}});
      truth.objects.push_back(object);
      truth.meshes.push_back(boxMesh(kSides));
      for (int i = 0; i < 40; ++i) {
        ObjectSighting sighting;
        sighting.stamp = base::stampFromUnix(kBegin + i);
        sighting.object = name;
        sighting.pixels = 400;
        sighting.distance = 1;
        truth.sightings.push_back(sighting);
      }
    }
    truth.objects[2].places.push_back({50, "", false, {}});
    truth.world = boxMesh({20, 20, 1});
    for (auto& vertex : truth.world.vertices) vertex.z() -= 1;  // the floor is at 0
    map.objects = {mapped("0-1", {0, 0, 0}), mapped("0-2", {1, 0, 0})};
  }
  ObjectMapQuality judged() const { return judgeObjects(map, truth); }
};

TEST(ObjectMapQuality, APerfectMapHasEachObjectOnce) {
  const Scene scene;
  const auto quality = scene.judged();
  ASSERT_EQ(quality.sought.size(), 2U) << "the third is away at the end";
  EXPECT_EQ(quality.found(), 2U);
  EXPECT_EQ(quality.doubled(), 0U);
  for (const JudgedObject& judged : quality.judged) {
    EXPECT_EQ(judged.is, Is::object);
    EXPECT_TRUE(judged.is_there);
    EXPECT_EQ(judged.state_is_right, true);
    EXPECT_NEAR(judged.position_error, 0, 1e-9);
    EXPECT_NEAR(judged.extent, 1, 0.05);
    EXPECT_NEAR(judged.distance_90, 0, 1e-9);
  }
  ASSERT_EQ(quality.curve.size(), 2U) << "for 1 image and for 30, the only number at which it changes";
  EXPECT_EQ(quality.curve.back().precision, 1);
  EXPECT_EQ(quality.curve.back().recall, 1);
}

TEST(ObjectMapQuality, ErrorsAreThoseThatWereMade) {
  Scene scene;
  scene.map.objects[0] = mapped("0-1", {0.01, 0, 0});
  scene.map.objects[1] = mapped("0-2", {1, 0, 0}, State::present, 0.01);
  const auto quality = scene.judged();
  EXPECT_NEAR(quality.judged[0].position_error, 0.01, 1e-9);
  EXPECT_NEAR(quality.judged[1].position_error, 0, 1e-9);
  EXPECT_NEAR(quality.judged[1].distance_median, 0.01, 1e-6);
  scene.map.objects[0].points.clear();
  for (const Vector3d& point : pointsOnBox(kSides, {0, 0, 0})) {
    if (point.x() < 0) scene.map.objects[0].points.push_back(point);
  }
  EXPECT_NEAR(scene.judged().judged[0].extent, (0.45 + 1 + 1) / 3, 0.05) << "one half of it was seen";
}

TEST(ObjectMapQuality, DoubledMissedFurnitureAndNothing) {
  Scene scene;
  scene.map.objects = {mapped("0-1", {0, 0, 0}), mapped("0-2", {0.01, 0, 0}), mapped("0-3", {5, 5, -0.05}),
                       mapped("0-4", {5, 5, 2}), mapped("0-5", {5, 5, 2}, State::candidate)};
  scene.map.objects[3].points.clear();
  const auto quality = scene.judged();
  EXPECT_EQ(quality.found(), 1U);
  EXPECT_EQ(quality.doubled(), 1U);
  EXPECT_EQ(quality.judged[2].is, Is::furniture) << "it is in the floor";
  EXPECT_EQ(quality.judged[3].is, Is::nothing);
  const auto numbers = nlohmann::json::parse(json(quality, scene.map, scene.truth));
  EXPECT_EQ(numbers["on_furniture"], nlohmann::json::array({"0-3"}));
  EXPECT_EQ(numbers["on_nothing"], nlohmann::json::array({"0-4"})) << "candidates do not count";
  EXPECT_EQ(numbers["present"], 4);
  const std::string text = table(quality, scene.map, scene.truth);
  EXPECT_NE(text.find("1 of 2 objects"), std::string::npos) << text;
  EXPECT_NE(text.find("0-1 0-2"), std::string::npos) << text;
  EXPECT_NE(text.find("missed"), std::string::npos) << text;
}

TEST(ObjectMapQuality, WhatWasTakenAwayMustBeGoneOnceTheMapHasLooked) {
  Scene scene;
  scene.map.objects.push_back(mapped("0-3", {2, 0, 0}));
  EXPECT_FALSE(scene.judged().judged[2].state_is_right) << "nobody has looked since";
  scene.map.objects[2].last_looked = kBegin + 60;
  EXPECT_EQ(scene.judged().judged[2].state_is_right, false);
  scene.map.objects[2].state = State::gone;
  EXPECT_EQ(scene.judged().judged[2].state_is_right, true);
  scene.map.objects[0].state = State::gone;
  const auto quality = scene.judged();
  EXPECT_EQ(quality.judged[0].state_is_right, false) << "it is still there";
  EXPECT_EQ(quality.found(), 1U) << "what is gone is not in the map";
}

TEST(ObjectMapQuality, WhatWasMovedIsSoughtWhereItIsSinceThen) {
  Scene scene;
  scene.truth.objects[2].places.back() = {50, "floor", false, geometry::Se3{Eigen::Quaterniond::Identity(), {4, 0, 0}}};
  EXPECT_EQ(scene.judged().sought.size(), 2U) << "nobody has seen it there";
  for (int i = 0; i < 40; ++i) {
    scene.truth.sightings.push_back(scene.truth.sightings.back());
    scene.truth.sightings.back().stamp = base::stampFromUnix(kBegin + 60 + 0.5 * i);
  }
  scene.map.objects.push_back(mapped("0-3", {2, 0, 0}));
  EXPECT_EQ(scene.judged().sought.size(), 3U);
  EXPECT_EQ(scene.judged().found(), 2U) << "the map has it where it was";
  scene.map.objects.push_back(mapped("0-4", {4, 0, 0}));
  EXPECT_EQ(scene.judged().found(), 3U);
}

TEST(ObjectMapQuality, TheCurveFallsToThoseThatManyImagesShow) {
  Scene scene;
  scene.map.objects.push_back(mapped("0-3", {5, 5, 2}));
  scene.map.objects[0].seen_in = 3;
  scene.map.objects[1].seen_in = 2;
  scene.map.objects[2].seen_in = 1;
  const auto quality = scene.judged();
  EXPECT_EQ(curveTable(quality),
            "images,objects,precision,recall\n1,3,0.6667,1.0000\n2,2,1.0000,1.0000\n3,1,1.0000,0.5000\n");
}

TEST(ObjectMapQuality, NothingIsNoFault) {
  const ObjectMap empty;
  const Scene scene;
  const auto quality = judgeObjects(empty, scene.truth);
  EXPECT_EQ(quality.found(), 0U);
  EXPECT_TRUE(quality.curve.empty());
  EXPECT_NE(table(quality, empty, scene.truth).find("0 of 2 objects"), std::string::npos);
  ObjectTruth nowhere;
  EXPECT_TRUE(judgeObjects(scene.map, nowhere).sought.empty());
}

TEST(ObjectMapQuality, AMapIsMovedWithItsModels) {
  const Scene scene;
  const geometry::Se3 motion{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitZ())), {3, -1, 0}};
  const auto quality = judgeObjects(moved(moved(scene.map, motion), inverse(motion)), scene.truth);
  EXPECT_EQ(quality.found(), 2U);
  EXPECT_NEAR(quality.judged[0].position_error, 0, 1e-9);
}

}  // namespace
}  // namespace omnimapper::eval::object_map_quality_test
