#include <gtest/gtest.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "TableWorld.h"
#include "object_landmarks/ObjectLook.h"

namespace omnimapper::plugins::object_look_test {
namespace {

using namespace table_world;

// A box of 20 cm on the table, a metre to the left of the base at the origin, as one image shows it.
const Thing kBox = onTable(0, 1.2, {0.2, 0.2, 0.2});

class ObjectLook : public ::testing::Test {
 protected:
  ObjectLook() {
    TableWorld world;
    world.things = {kBox};
    const auto frame = run_.addFrame({}).id;
    const auto [scan, objects] = world.seen({}, 0);
    const auto base_from_sensor = geometry::fromMrpt(world.base_from_camera);
    ObjectView view;
    view.frame = frame;
    view.distance = 1.3;
    for (const auto& point : objects->objects.at(0).points)
      view.points.push_back((base_from_sensor * point.cast<double>()).cast<float>());
    view.foot = Vector3d(0, 1.2, 0.7);
    object_ = std::make_unique<ObjectGeometry>(ObjectModel({view}), run_.map.key_frames);
  }
  // What an image of a world shows of the box, from a base that is at `map_from_base` and believed to be at `believed`.
  LookCounts counts(const std::vector<Thing>& things, const mrpt::poses::CPose3D& map_from_base = {},
                    const std::optional<mrpt::poses::CPose3D>& believed = {}, double reach = 0) const {
    TableWorld world;
    world.things = things;
    const auto scan = world.seen(map_from_base, 0).first;
    const camera::ScanDepth depth(*scan);
    const auto map_from_optical = geometry::fromMrpt(believed.value_or(map_from_base)) *
                                  geometry::fromMrpt(world.base_from_camera) * geometry::sensorFromOptical();
    const LookingCamera camera{depth.image(), geometry::inverse(map_from_optical)};
    may_be_beside_ = reach > 0 && mayBeBeside(*object_, camera, reach * Eigen::Matrix3d::Identity());
    return isInView(*object_, camera) ? lookFor(*object_, camera) : LookCounts();
  }
  Sight sight(const std::vector<Thing>& things, const mrpt::poses::CPose3D& map_from_base = {}) const {
    return counts(things, map_from_base).sight();
  }

  testing::HandMadeRun run_;
  std::unique_ptr<ObjectGeometry> object_;
  mutable bool may_be_beside_ = false;  // by the last counts()
};

TEST_F(ObjectLook, WhatStandsThereIsSeen) {
  EXPECT_EQ(sight({kBox}), Sight::seen);
  EXPECT_EQ(sight({kBox}, {0.3, 0.1, 0, 0.2, 0, 0}), Sight::seen) << "from another place";
  const auto all = counts({kBox});
  EXPECT_EQ(all.through + all.hidden + all.unmeasured + all.outside, 0);
}

TEST_F(ObjectLook, WhatWasTakenAwayIsAbsent) {
  EXPECT_EQ(sight({}), Sight::absent);
  EXPECT_EQ(sight({}, {0.3, 0.1, 0, 0.2, 0, 0}), Sight::absent);
  EXPECT_EQ(sight({onTable(0.5, 1.2, {0.2, 0.2, 0.2})}), Sight::absent) << "it was moved by half a metre";
}

TEST_F(ObjectLook, WhatIsBehindSomethingIsHidden) {
  const Thing person{{0, 0.7, 0.9}, {0.5, 0.2, 1.8}};
  EXPECT_EQ(sight({kBox, person}), Sight::hidden);
  EXPECT_EQ(sight({person}), Sight::hidden) << "nobody can know that it is gone";
}

TEST_F(ObjectLook, WhatIsHalfHiddenIsNotAbsent) {
  const Thing post{{-0.06, 0.7, 0.9}, {0.12, 0.1, 1.8}};
  EXPECT_NE(sight({kBox, post}), Sight::absent);
}

TEST_F(ObjectLook, BesideTheImageAndBeyondItsRangeNothingIsKnown) {
  EXPECT_EQ(sight({}, {2, 0, 0, 0, 0, 0}), Sight::unknown);
  EXPECT_EQ(sight({}, {0, 0, 0, EIGEN_PI, 0, 0}), Sight::unknown) << "behind the camera";
  EXPECT_EQ(sight({}, {0, -3.5, 0, 0, 0, 0}), Sight::unknown) << "too far away";
}

TEST_F(ObjectLook, WithoutDepthsNothingIsKnown) {
  const std::vector<float> none(160 * 120, 0);
  const camera::DepthImage image(none.data(), 160, 120, TableWorld().pinhole);
  const auto map_from_optical = geometry::fromMrpt(TableWorld().base_from_camera) * geometry::sensorFromOptical();
  const auto all = lookFor(*object_, {image, geometry::inverse(map_from_optical)});
  EXPECT_EQ(all.sight(), Sight::unknown);
  EXPECT_GT(all.unmeasured, 0);
}

TEST_F(ObjectLook, WhatThePoseExplainsIsNotAbsent) {
  // The robot believes that it is 30 cm beside its place, so that the box seems to be elsewhere.
  const mrpt::poses::CPose3D truth, believed(0.3, 0, 0, 0, 0, 0);
  EXPECT_EQ(counts({kBox}, truth, believed, 0.35).sight(), Sight::absent);
  EXPECT_TRUE(may_be_beside_);
  EXPECT_EQ(counts({kBox}, truth, believed, 0.15).sight(), Sight::absent);
  EXPECT_FALSE(may_be_beside_) << "it is farther away than the pose is uncertain";
  EXPECT_EQ(counts({}, truth, truth, 0.35).sight(), Sight::absent);
  EXPECT_FALSE(may_be_beside_) << "nothing in the image has its shape";
}

TEST_F(ObjectLook, WhatIsFlatOnItsSurfaceCannotBeMissed) {
  // A sheet of 1 cm: without it, the camera would see the table almost at the same depths.
  TableWorld world;
  const Thing sheet = onTable(0, 1.2, {0.3, 0.2, 0.01});
  world.things = {sheet};
  const auto [scan, objects] = world.seen({}, 0);
  ObjectView view;
  view.frame = run_.map.key_frames.front().id;
  for (const auto& point : objects->objects.at(0).points)
    view.points.push_back((geometry::fromMrpt(world.base_from_camera) * point.cast<double>()).cast<float>());
  view.foot = Vector3d(0, 1.2, 0.7);
  object_ = std::make_unique<ObjectGeometry>(ObjectModel({view}), run_.map.key_frames);
  EXPECT_EQ(sight({}), Sight::unknown);
  EXPECT_EQ(sight({sheet}), Sight::unknown);
}

TEST(LookCounts, SayNothingByAFewPoints) {
  LookCounts counts;
  counts.through = 10;
  EXPECT_EQ(counts.sight(), Sight::unknown);
  counts.through = 100;
  EXPECT_EQ(counts.sight(), Sight::absent);
  counts.outside = 101;
  EXPECT_EQ(counts.sight(), Sight::unknown) << "most of it is beside the image";
}

}  // namespace
}  // namespace omnimapper::plugins::object_look_test
