#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <limits>

#include "absolute/GivenMotionPlugin.h"

namespace omnimapper::plugins::given_motion_plugin_test {
namespace {

using mrpt::poses::CPose3D;
using Taken = mapper::PosePlugin::Taken;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

mrpt::obs::CObservationRobotPose::Ptr given(double seconds, const CPose3D& pose, const std::string& label = "mocap") {
  const auto made = mrpt::obs::CObservationRobotPose::Create();
  made->timestamp = at(seconds);
  made->sensorLabel = label;
  made->pose.mean = pose;
  return made;
}

TEST(GivenMotionPlugin, ReturnsTheMotionBetweenPosesAndWithinThem) {
  GivenMotionPlugin plugin({});
  EXPECT_FALSE(plugin.coveredUntil());
  EXPECT_EQ(plugin.add(given(0, CPose3D(1, 2, 3, 0.5, 0, 0))), Taken::taken);
  EXPECT_EQ(plugin.add(given(0.5, CPose3D(1, 2, 3, 0.5, 0, 0) + CPose3D(0.4, 0, 0.2, 0, 0, 0.1))), Taken::taken);
  EXPECT_EQ(plugin.coveredUntil(), at(0.5));
  const auto half = plugin.between(at(0), at(0.25));
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->begin_from_end.x(), 0.2, 1e-9);
  EXPECT_NEAR(half->begin_from_end.z(), 0.1, 1e-9);
  // 0.05 m and 2 deg after 1 s, and the root of the time.
  EXPECT_NEAR(half->covariance(0, 0), 0.25 * 0.05 * 0.05, 1e-5);
  EXPECT_FALSE(plugin.between(at(0), at(0.6)));
}

TEST(GivenMotionPlugin, ALatePoseTakesItsPlace) {
  GivenMotionPlugin plugin({});
  plugin.add(given(0, CPose3D()));
  plugin.add(given(1, CPose3D(1, 0, 0, 0, 0, 0)));
  EXPECT_EQ(plugin.add(given(0.5, CPose3D(0.5, 0.3, 0, 0, 0, 0))), Taken::taken);
  ASSERT_TRUE(plugin.news());
  EXPECT_EQ(plugin.news()->begin, at(0));
  EXPECT_EQ(plugin.news()->end, at(1));
  EXPECT_NEAR(plugin.between(at(0), at(0.5))->begin_from_end.y(), 0.3, 1e-9);
  EXPECT_NEAR(plugin.between(at(0), at(1))->begin_from_end.y(), 0, 1e-9);
  EXPECT_EQ(plugin.add(given(-0.5, CPose3D(-1, 0, 0, 0, 0, 0))), Taken::taken) << "before the first";
  EXPECT_NEAR(plugin.between(at(-0.5), at(0))->begin_from_end.x(), 1, 1e-9);
  plugin.forgetBefore(at(0.6));
  EXPECT_EQ(plugin.add(given(0.2, CPose3D())), Taken::unusable) << "what was there is forgotten";
}

TEST(GivenMotionPlugin, AcrossAGapNothingIsKnown) {
  GivenMotionPlugin plugin({});
  plugin.add(given(0, CPose3D()));
  plugin.add(given(5, CPose3D(1, 0, 0, 0, 0, 0)));
  EXPECT_FALSE(plugin.between(at(0), at(5)));
  plugin.add(given(5.1, CPose3D(1.1, 0, 0, 0, 0, 0)));
  EXPECT_TRUE(plugin.between(at(5), at(5.1)));
}

TEST(GivenMotionPlugin, LeavesOutOtherLabelsRepeatedStampsAndWhatIsNotFinite) {
  GivenMotionPlugin plugin({});
  EXPECT_EQ(plugin.add(given(0, CPose3D(std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0))), Taken::unusable);
  EXPECT_EQ(plugin.add(given(0, CPose3D())), Taken::taken);
  EXPECT_EQ(plugin.add(given(0, CPose3D(1, 0, 0, 0, 0, 0))), Taken::unusable);
  EXPECT_EQ(plugin.add(given(1, CPose3D(), "another")), Taken::not_mine);
  GivenMotionOptions options;
  options.label = "mocap";
  GivenMotionPlugin named(options);
  EXPECT_EQ(named.add(given(0, CPose3D(), "another")), Taken::not_mine);
  EXPECT_EQ(named.add(given(0, CPose3D())), Taken::taken);
}

// The base is 1 m behind the tracked body: when the body turns on the spot, the base swings around it.
TEST(GivenMotionPlugin, TheTrackedBodyIsTakenBackToTheBase) {
  GivenMotionPlugin plugin({});
  for (const double yaw : {0.0, 0.1}) {
    auto pose = given(yaw, CPose3D(0, 0, 0, yaw, 0, 0));
    pose->sensorPose = CPose3D(1, 0, 0, 0, 0, 0);
    plugin.add(pose);
  }
  const auto motion = plugin.between(at(0), at(0.1));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.x(), 1 - std::cos(0.1), 1e-9);
  EXPECT_NEAR(motion->begin_from_end.y(), -std::sin(0.1), 1e-9);
}

}  // namespace
}  // namespace omnimapper::plugins::given_motion_plugin_test
