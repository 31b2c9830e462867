// The truth about objects that omnimapper-simulate writes, and omnimapper-eval that reads it.
#include <omnimapper/eval/ObjectTruth.h>
#include <omnimapper/eval/TriangleMesh.h>

#include <algorithm>

#include "SimulateRun.h"

namespace {

using namespace runs;
namespace eval = omnimapper::eval;

// The small world with a box that carries a cup in view of the camera. The box is removed, and a person carries a can.
const char* const kObjects = R"([world]
objects = box, cup, can
people = anna
[box]
class = box
x_m = 2.2
y_m = 3.2
length_m = 0.3
width_m = 0.2
height_m = 0.1
on = table_1/top
moves = 5 away
[cup]
class = cup
x_m = 2.2
y_m = 3.2
on = box/top
[can]
class = can
x_m = 3.1
y_m = 3.2
on = table_1/top
[anna]
class = person
path = 0 3.5 3.2
carrying = 2 4.5 can 3.1 3.1 0 table_1/top
[robot]
mode = still
start = 1 1 55
waypoints =
)";

class SimulatedObjects : public ::testing::Test {
 protected:
  void SetUp() override {
    writeFile(scratch_ / "small.ini", kSmallWorld);
    writeFile(scratch_ / "objects.ini", kObjects);
    ASSERT_TRUE(endedWith(ExitCode::ok,
                          simulate({"-i", scratch_ / "small.ini", "-i", scratch_ / "objects.ini", "-o", folder_})));
  }
  omnimapper::testing::ScratchFolder scratch_;
  const std::string folder_ = scratch_ / "out";
};

TEST_F(SimulatedObjects, AreReadWithTheirPlacesAndMeshes) {
  const auto objects = eval::readTrueObjects(folder_);
  ASSERT_EQ(objects.size(), 3U);
  const auto& [box, cup, can] = std::tie(objects[0], objects[1], objects[2]);
  EXPECT_EQ(box.at(0).on, "table_1/top");
  EXPECT_EQ(cup.at(0).on, "box/top");
  EXPECT_NEAR(cup.at(0).map_from_object->translation.z(), 0.84, 1e-6);
  EXPECT_FALSE(cup.at(5).map_from_object) << "it goes with the box";
  EXPECT_EQ(can.at(2).on, "anna");
  EXPECT_TRUE(can.at(2).in_motion);
  EXPECT_FALSE(can.at(4.5).in_motion);
  EXPECT_NEAR(can.at(4.5).map_from_object->translation.y(), 3.1, 1e-6);
  for (const auto& object : objects) {
    const auto mesh = eval::readTriangleMesh(object.mesh);
    ASSERT_FALSE(mesh.triangles.empty()) << object.name;
    Eigen::Vector3d low = mesh.vertices.front(), high = low;
    for (const auto& vertex : mesh.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
    EXPECT_LT((high - low - object.extents).norm(), 1e-4) << object.name;
    EXPECT_NEAR(low.z(), 0, 1e-6) << object.name;
  }
}

TEST_F(SimulatedObjects, AreCountedInTheImagesThatShowThem) {
  const auto objects = eval::readTrueObjects(folder_);
  const auto sightings = eval::readObjectSightings(folder_);
  const auto countOf = [&](const std::string& name) {
    return std::count_if(sightings.begin(), sightings.end(), [&](const auto& each) { return each.object == name; });
  };
  EXPECT_EQ(countOf("box"), 10) << "two images a second until it is removed";
  EXPECT_EQ(countOf("cup"), 10);
  EXPECT_EQ(countOf("can"), 13) << "also while it is carried";
  const auto seen = eval::countSightings(objects, sightings, {5, 10});
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](const auto& object) { return object.is_seen; }));
  const auto ended = omnimapper::testing::runProgram(
      {omnimapper::testing::ownProgram("omnimapper-eval"), "seen", folder_, "--pixels", "5", "--images", "10"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended, {}));
  EXPECT_NE(ended.out.find("3 of 3 objects were seen"), std::string::npos) << ended.out;
  EXPECT_EQ(
      omnimapper::testing::runProgram({omnimapper::testing::ownProgram("omnimapper-eval"), "seen", scratch_ / "none"})
          .code,
      static_cast<int>(ExitCode::unreadable_input));
}

}  // namespace
