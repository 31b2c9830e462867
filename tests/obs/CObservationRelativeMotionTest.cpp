#include <gtest/gtest.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <sstream>

namespace omnimapper::obs::c_observation_relative_motion_test {
namespace {

CObservationRelativeMotion planarMotion() {
  CObservationRelativeMotion motion;
  motion.begin = base::stampFromUnix(100.25);
  motion.timestamp = base::stampFromUnix(101.5);
  motion.sensorLabel = "odometry";
  motion.begin_from_end = mrpt::poses::CPose3D(1.0, 0.5, 0, 0.25, 0, 0);
  motion.covariance(0, 0) = 0.01;
  motion.covariance(1, 1) = 0.04;
  motion.covariance(0, 1) = motion.covariance(1, 0) = 0.002;
  motion.covariance(5, 5) = 0.0025;
  return motion;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> result;
  for (std::string word; in >> word;) result.push_back(word);
  return result;
}

TEST(CObservationRelativeMotion, isBornWithoutStamps) {
  const CObservationRelativeMotion motion;
  EXPECT_FALSE(base::isValid(motion.timestamp));
  EXPECT_FALSE(base::isValid(motion.begin));
}

TEST(CObservationRelativeMotion, hasNoSensorPose) {
  CObservationRelativeMotion motion;
  EXPECT_EQ(motion.sensorPose(), mrpt::math::TPose3D());
  EXPECT_NO_THROW(motion.setSensorPose(mrpt::poses::CPose3D()));
  EXPECT_THROW(motion.setSensorPose(mrpt::poses::CPose3D(1, 0, 0, 0, 0, 0)), base::Error);
}

TEST(CObservationRelativeMotion, descriptionSaysSpanMotionAndDeviations) {
  const std::string text = planarMotion().asString();
  for (const char* expected : {"odometry", "100.2500000", "101.5000000", "Length of the span [s]:     1.25", "1 0.5 0",
                               "14.3239", "0.1 0.2 0", "2.86479"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << " is not in\n" << text;
}

TEST(CObservationRelativeMotion, exportedRowHasOneFieldForEachHeading) {
  const auto motion = planarMotion();
  const auto header = words(motion.exportTxtHeader());
  const auto row = words(motion.exportTxtDataRow());
  ASSERT_TRUE(motion.exportTxtSupported());
  ASSERT_EQ(row.size(), header.size());
  ASSERT_EQ(row.size(), 1u + 6u + 21u);
  const auto field = [&](const std::string& name) {
    return row[static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin())];
  };
  EXPECT_EQ(field("begin_unix_s"), "100.2500000");
  EXPECT_EQ(std::stod(field("y_m")), 0.5);
  EXPECT_EQ(std::stod(field("yaw_rad")), 0.25);
  EXPECT_EQ(std::stod(field("cov_x_y")), 0.002);
  EXPECT_EQ(std::stod(field("cov_rz_rz")), 0.0025);
}

TEST(CObservationRelativeMotion, drawsTheEllipsoidAtTheEndOfTheSpan) {
  const auto scene = planarMotion().getVisualization();
  const auto ellipsoid = scene->getByClass<mrpt::opengl::CEllipsoid3D>();
  ASSERT_TRUE(ellipsoid);
  EXPECT_EQ(ellipsoid->getPoseX(), 1.0);
  EXPECT_EQ(ellipsoid->getPoseY(), 0.5);
  EXPECT_FALSE(CObservationRelativeMotion().getVisualization()->getByClass<mrpt::opengl::CEllipsoid3D>());
}

}  // namespace
}  // namespace omnimapper::obs::c_observation_relative_motion_test
