#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/motion/PoseTimeline.h>

#include "wheel_odometry/NoMotionPlugin.h"

namespace omnimapper::plugins::no_motion_plugin_test {
namespace {

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

NoMotionPlugin plugin() {
  NoMotionOptions options;
  options.position_sigma = 0.5;
  options.angle_sigma = 0.1;
  return NoMotionPlugin(options);
}

TEST(NoMotionPlugin, IsLessCertainOfRestAsTimePasses) {
  const auto motion = plugin().between(at(3), at(7));
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->begin_from_end, mrpt::poses::CPose3D());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion->covariance(i, i), 0.25 * 4, 1e-12);
  for (int i = 3; i < 6; ++i) EXPECT_NEAR(motion->covariance(i, i), 0.01 * 4, 1e-12);
  EXPECT_NEAR(motion->covariance.sum(), motion->covariance.trace(), 1e-12) << "nothing mixed";
}

TEST(NoMotionPlugin, SpansAddUp) {
  const auto whole = plugin().between(at(0), at(5));
  const auto sum = motion::compose(*plugin().between(at(0), at(2)), *plugin().between(at(2), at(5)));
  EXPECT_LT((whole->covariance - sum.covariance).norm(), 1e-12);
}

TEST(NoMotionPlugin, IsAFallbackThatTakesNothingAndDelaysNothing) {
  auto made = plugin();
  EXPECT_TRUE(made.isFallback());
  EXPECT_FALSE(made.coveredUntil());
  EXPECT_EQ(made.add(mrpt::obs::CObservationOdometry::Create()), mapper::PosePlugin::Taken::not_mine);
  EXPECT_FALSE(made.between(at(2), at(1)));
  EXPECT_GT(made.between(at(1), at(1))->covariance(0, 0), 0) << "a factor needs a variance";
}

}  // namespace
}  // namespace omnimapper::plugins::no_motion_plugin_test
