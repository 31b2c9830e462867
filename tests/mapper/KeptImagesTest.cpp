// Tests what key frames keep of images: a thinned coloured cloud, and of the images only what an output needs.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

#include "back_end/KeptObservations.h"
#include "front_end/DepthCloud.h"

namespace omnimapper::mapper::kept_images_test {
namespace {

using mrpt::obs::CObservation3DRangeScan;

constexpr int kWidth = 64, kHeight = 48;

// A wall 2 m ahead of a camera 1 m above the base; its left half is red, its right half blue.
CObservation3DRangeScan::Ptr wall(double metres = 2) {
  auto scan = CObservation3DRangeScan::Create();
  scan->sensorLabel = "camera";
  scan->timestamp = base::stampFromUnix(1e9);
  scan->sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
  scan->rangeUnits = 0.001F;
  scan->range_is_depth = true;
  scan->hasRangeImage = true;
  scan->rangeImage_setSize(kHeight, kWidth);
  scan->rangeImage.fill(static_cast<std::uint16_t>(1000 * metres));
  scan->cameraParams.setIntrinsicParamsFromValues(50, 50, 32, 24);
  scan->cameraParamsIntensity = scan->cameraParams;
  scan->relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  scan->hasIntensityImage = true;
  scan->intensityImage.resize(kWidth, kHeight, mrpt::img::CH_RGB);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      scan->intensityImage.setPixel(u, v, u < kWidth / 2 ? mrpt::img::TColor(200, 0, 0) : mrpt::img::TColor(0, 0, 100));
  }
  return scan;
}

std::vector<map::CloudPoint> cloudOf(const mrpt::obs::CObservation& observation, const CloudOptions& options) {
  perception::Blackboard board;
  return depthCloud(observation, options, board);
}

// Every fourth pixel is sampled, which is 16 cm on the wall.
TEST(DepthCloud, EveryFourthPixelIsAPointInTheBaseWithItsColour) {
  const auto cloud = cloudOf(*wall(), {0.05, 5});
  ASSERT_EQ(cloud.size(), kWidth / 4 * kHeight / 4);
  for (const auto& point : cloud) {
    EXPECT_EQ(point.x, 2000);
    EXPECT_EQ(point.red, point.y > 0 ? 200 : 0) << "what is left in the picture has a positive y";
    EXPECT_EQ(point.blue, point.y > 0 ? 0 : 100);
  }
  // The first sampled pixel is (2, 2): 30 / 50 of 2 m to the left, and 22 / 50 of 2 m up from 1 m.
  EXPECT_EQ(cloud.front().y, 1200);
  EXPECT_EQ(cloud.front().z, 1880);
}

TEST(DepthCloud, OneOfACubeAndNoneBeyondTheRange) {
  EXPECT_TRUE(cloudOf(*wall(), {0.05, 1.9}).empty());
  EXPECT_TRUE(cloudOf(*wall(), {0, 5}).empty());
  const auto coarse = cloudOf(*wall(), {0.5, 5});
  EXPECT_LT(coarse.size(), 40U);
  EXPECT_GT(coarse.size(), 20U) << "2.4 m by 1.8 m";
}

TEST(DepthCloud, WhatIsNoDepthAndEdgesOfDepthAreLeftOut) {
  auto scan = wall();
  scan->rangeImage.fill(0);
  EXPECT_TRUE(cloudOf(*scan, {0.05, 5}).empty());
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) scan->rangeImage(v, u) = u % 2 == 0 ? 1000 : 3000;
  }
  EXPECT_TRUE(cloudOf(*scan, {0.05, 5}).empty());
  EXPECT_TRUE(cloudOf(mrpt::obs::CObservationImage(), {0.05, 5}).empty());
}

TEST(DepthCloud, WithoutAPictureItIsGrey) {
  auto scan = wall();
  scan->hasIntensityImage = false;
  for (const auto& point : cloudOf(*scan, {0.05, 5})) EXPECT_EQ(point.red + point.green + point.blue, 3 * 128);
}

// The colour camera is 10 cm to the left of the depth camera: it sees points 2 m away 2.5 pixels further to the right.
TEST(DepthCloud, APictureFromElsewhereIsLookedUpWhereItsCameraSeesThePoint) {
  auto scan = wall();
  scan->relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, 0.1, 0, -M_PI / 2, 0, -M_PI / 2);
  for (const auto& point : cloudOf(*scan, {0.05, 5})) {
    if (point.y < -1100) continue;  // not in the view of the colour camera
    EXPECT_EQ(point.red, point.y > 100 ? 200 : 0) << point.y;
  }
}

class KeptImages : public ::testing::Test {
 protected:
  KeptImages() { add(mrpt::poses::CPose3D()); }
  base::KeyFrameId add(const mrpt::poses::CPose3D& map_from_base) {
    map::KeyFrame frame;
    frame.id = {0, static_cast<std::uint32_t>(map_.key_frames.size())};
    frame.stamp = base::stampFromUnix(1e9 + frame.id.index);
    frame.map_from_base = map_from_base;
    frame.observations.push_back(wall());
    map_.key_frames.insert(frame);
    return frame.id;
  }
  const CObservation3DRangeScan& kept(RawImages images) {
    KeptObservations(CloudOptions(), images, map_).dropImages({0, 0});
    return dynamic_cast<const CObservation3DRangeScan&>(*map_.key_frames[0].observations[0]);
  }

  map::Map map_;
};

TEST_F(KeptImages, APlaceThatWasSeenBeforeAddsNoPoints) {
  KeptObservations keeping(CloudOptions(), RawImages::none, map_);
  const auto cloud = cloudOf(*wall(), CloudOptions());
  keeping.addCloud({0, 0}, cloud);
  EXPECT_EQ(map_.key_frames[0].cloud.size(), cloud.size());
  keeping.addCloud(add(mrpt::poses::CPose3D()), cloud);
  EXPECT_TRUE(map_.key_frames[1].cloud.empty());
  keeping.addCloud(add(mrpt::poses::CPose3D(5, 0, 0, 0, 0, 0)), cloud);
  EXPECT_EQ(map_.key_frames[2].cloud.size(), cloud.size());
  KeptObservations next_session(CloudOptions(), RawImages::none, map_);
  next_session.posesChanged();
  next_session.addCloud(add(mrpt::poses::CPose3D()), cloud);
  EXPECT_TRUE(map_.key_frames[3].cloud.empty());
}

// A closure has moved the only view of the wall by a metre, so its former place is free again.
TEST_F(KeptImages, WhatASolveHasMovedCountsWhereItIsNow) {
  KeptObservations keeping(CloudOptions(), RawImages::none, map_);
  const auto cloud = cloudOf(*wall(), CloudOptions());
  keeping.addCloud({0, 0}, cloud);
  map_.key_frames.edit({0, 0}).map_from_base = mrpt::poses::CPose3D(1, 0, 0, 0, 0, 0);
  keeping.posesChanged();
  keeping.addCloud(add(mrpt::poses::CPose3D(1, 0, 0, 0, 0, 0)), cloud);
  EXPECT_TRUE(map_.key_frames[1].cloud.empty());
  keeping.addCloud(add(mrpt::poses::CPose3D()), cloud);
  EXPECT_EQ(map_.key_frames[2].cloud.size(), cloud.size());
}

TEST_F(KeptImages, NoneKeepsTheSensorWithoutItsImages) {
  const auto& scan = kept(RawImages::none);
  EXPECT_FALSE(scan.hasRangeImage);
  EXPECT_FALSE(scan.hasIntensityImage);
  EXPECT_EQ(scan.sensorLabel, "camera");
  EXPECT_TRUE(scan.timestamp == base::stampFromUnix(1e9));
  EXPECT_EQ(scan.sensorPose.z(), 1);
  EXPECT_EQ(scan.cameraParams.fx(), 50);
}

TEST_F(KeptImages, DepthKeepsThatAlone) {
  const auto& scan = kept(RawImages::depth);
  ASSERT_TRUE(scan.hasRangeImage);
  EXPECT_EQ(scan.rangeImage(5, 7), 2000);
  EXPECT_FALSE(scan.hasIntensityImage);
}

TEST_F(KeptImages, AllKeepsTheObservationItself) {
  const auto before = map_.key_frames[0].observations[0];
  kept(RawImages::all);
  EXPECT_EQ(map_.key_frames[0].observations[0], before);
}

TEST_F(KeptImages, PicturesAreLeftOutButNotTheirCamera) {
  auto picture = mrpt::obs::CObservationImage::Create();
  picture->sensorLabel = "picture";
  picture->cameraParams.setIntrinsicParamsFromValues(70, 70, 3, 2);
  picture->image.resize(8, 6, mrpt::img::CH_RGB);
  map_.key_frames.edit({0, 0}).observations.push_back(picture);
  KeptObservations(CloudOptions(), RawImages::depth, map_).dropImages({0, 0});
  const auto& kept = dynamic_cast<const mrpt::obs::CObservationImage&>(*map_.key_frames[0].observations[1]);
  EXPECT_TRUE(kept.image.isEmpty());
  EXPECT_EQ(kept.cameraParams.fx(), 70);
  EXPECT_EQ(picture->image.getWidth(), 8) << "somebody else may hold it";
}

}  // namespace
}  // namespace omnimapper::mapper::kept_images_test
