#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include "RenderedScan.h"
#include "rgbd/CloudOdometryPlugin.h"

namespace omnimapper::plugins::cloud_odometry_plugin_test {
namespace {

using geometry::Se3;
using mrpt::poses::CPose3D;
using Taken = mapper::PosePlugin::Taken;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

const CPose3D kBaseFromCamera(0.1, 0.05, 0.2, 0, 0.3, 0);

/// Pose of the base in the room's frame, whose z is forward and y down. Its camera looks into a corner at the floor.
Se3 truth(double seconds) {
  geometry::Vector6d delta;
  delta << 0.1 * std::sin(seconds), 0.08 * seconds, 0.02 * seconds, 0.05 * std::sin(seconds), 0.03 * seconds,
      0.2 * std::sin(seconds);
  const Se3 room_from_level{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0, 0.1, -0.3}};
  const Se3 turned{Eigen::Quaterniond(Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitZ())), {0, 0, 0}};
  return room_from_level * turned * geometry::plus(Se3{}, delta);
}

class CloudOdometry : public ::testing::Test {
 protected:
  CloudOdometry() {
    source_.source = matching::CloudSource::voxels;
    source_.voxel = 0.05;
    make();
  }
  void make() {
    plugin_ = std::make_unique<CloudOdometryPlugin>(CameraOdometryOptions{}, tracking_, source_, matching_);
  }

  void add(double seconds, bool is_covered = false) {
    const auto scan = renderedScan(room_, truth(seconds), kBaseFromCamera, at(seconds), is_covered);
    EXPECT_EQ(plugin_->add(scan), Taken::taken);
    plugin_->processUntil(at(seconds));
  }

  void expectMotion(double begin, double end) const {
    const auto motion = plugin_->between(at(begin), at(end));
    ASSERT_TRUE(motion) << begin << " to " << end;
    const auto off = minus(geometry::fromMrpt(motion->begin_from_end), inverse(truth(begin)) * truth(end));
    EXPECT_LT(off.head<3>().norm(), 0.02) << begin << " to " << end;
    EXPECT_LT(off.tail<3>().norm(), 0.012) << begin << " to " << end;
  }

  mapper::Evidence evidence(const std::string& name) const {
    for (const auto& one : plugin_->evidence())
      if (one.name == name) return one;
    return {};
  }

  matching::RenderedRoom room_;
  matching::CloudTrackerOptions tracking_;
  matching::CloudSourceOptions source_;
  matching::CloudMatcherOptions matching_;
  std::unique_ptr<CloudOdometryPlugin> plugin_;
};

TEST_F(CloudOdometry, MeasuresTheMotionOfTheBaseNotOfTheCamera) {
  for (const auto method : {matching::CloudMethod::point_to_plane, matching::CloudMethod::gicp}) {
    matching_.method = method;
    make();
    for (int i = 0; i <= 15; ++i) add(0.1 * i);
    expectMotion(0, 1);
    expectMotion(0.5, 1.5);
    EXPECT_EQ(plugin_->coveredUntil(), at(1.5));
    EXPECT_EQ(evidence("camera_lost_percent").value, 0);
  }
}

TEST_F(CloudOdometry, PclMeasuresTheMotionTooOrItsAbsenceIsReported) {
  using matching::CloudMethod;
  CloudLibraryOptions by;
  by.library = CloudLibraryOptions::Library::pcl;
  tracking_.longest_loss = 0.5;
  for (const auto method : {CloudMethod::point_to_point, CloudMethod::point_to_plane, CloudMethod::gicp}) {
    matching_.method = method;
    try {
      plugin_ = std::make_unique<CloudOdometryPlugin>(CameraOdometryOptions{}, tracking_, source_, matching_, by);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::plugin_library);
      EXPECT_NE(std::string(error.what()).find("feature 'pcl_matching'"), std::string::npos) << error.what();
      GTEST_SKIP() << "built without PCL (libpcl-dev)";
    }
    for (int i = 0; i <= 5; ++i) add(0.1 * i);
    expectMotion(0, 0.5);
  }
}

TEST_F(CloudOdometry, AcrossACoveredLensTheMotionIsMeasuredWhenTheViewIsFoundAgain) {
  for (int i = 0; i <= 5; ++i) add(0.1 * i);
  for (int i = 6; i <= 8; ++i) add(0.1 * i, true);
  EXPECT_FALSE(plugin_->between(at(0), at(0.8))) << "a loss is reported, not guessed";
  add(0.9);
  expectMotion(0, 0.9);
  EXPECT_EQ(evidence("camera_begun_anew").value, 0);
}

TEST_F(CloudOdometry, AfterALongLossItBeginsAnewAtTheFirstImageThatShowsSomething) {
  add(0);
  add(0.1);
  for (int i = 2; i <= 24; ++i) add(0.1 * i, true);
  EXPECT_EQ(evidence("camera_begun_anew").value, 0) << "tracking does not start at a covered lens";
  room_.half[0] = 3;  // another room
  room_.half[2] = 2.5;
  add(2.5);
  add(2.6);
  EXPECT_FALSE(plugin_->between(at(0.1), at(2.5)));
  expectMotion(2.5, 2.6);
  EXPECT_EQ(evidence("camera_begun_anew").value, 1);
  EXPECT_EQ(evidence("camera_begun_anew").says, mapper::Evidence::Says::against_it);
}

TEST_F(CloudOdometry, ACoveredLensAtTheStartIsNoGap) {
  add(0, true);
  add(0.1);
  add(0.2);
  expectMotion(0.1, 0.2);
  EXPECT_EQ(evidence("camera_begun_anew").value, 0);
}

TEST_F(CloudOdometry, EdgesThatAreToBeRegisteredByPlanesAreRefused) {
  source_.source = matching::CloudSource::rgb_edges;
  matching_.method = matching::CloudMethod::point_to_plane;
  EXPECT_THROW(make(), base::Error);
}

TEST_F(CloudOdometry, WhatAnImageCannotGiveIsAWarning) {
  source_.source = matching::CloudSource::rgb_edges;
  make();
  const auto scan = renderedScan(room_, truth(0), kBaseFromCamera, at(0));
  scan->hasIntensityImage = false;
  EXPECT_EQ(plugin_->add(scan), Taken::taken);
  plugin_->processUntil(at(0));
  ASSERT_EQ(plugin_->warnings().size(), 1U);
  EXPECT_NE(plugin_->warnings()[0].find("there is no picture"), std::string::npos) << plugin_->warnings()[0];
}

}  // namespace
}  // namespace omnimapper::plugins::cloud_odometry_plugin_test
