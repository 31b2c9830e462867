#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/ObservationGate.h>

#include <cmath>
#include <functional>
#include <limits>

namespace omnimapper::source::observation_gate_test {
namespace {

using namespace mrpt::obs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

CObservation2DRangeScan laser() {
  CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.aperture = static_cast<float>(M_PI);
  scan.resizeScanAndAssign(181, 4.0F, true);
  return scan;
}

CObservation3DRangeScan camera(int rows = 48, int columns = 64) {
  CObservation3DRangeScan scan;
  scan.sensorLabel = "kinect";
  scan.hasRangeImage = true;
  scan.rangeImage_setSize(rows, columns);
  scan.cameraParams.setIntrinsicParamsFromValues(52, 52, 32, 24);
  scan.rangeUnits = 0.001F;
  return scan;
}

// The reason why `good` cannot be used after `spoil`; empty if it can.
template <class Observation>
std::string reasonOf(Observation good, const std::function<void(Observation&)>& spoil) {
  EXPECT_EQ(whyUnusable(good).value_or(""), "");
  spoil(good);
  return whyUnusable(good).value_or("");
}

TEST(ObservationGate, SensorPosesAreFiniteAndOnTheBase) {
  using Scan = CObservation2DRangeScan;
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.sensorPose.y(kNan); }), "the sensor pose is not valid");
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.sensorPose.x(1e300); }),
            "the sensor is more than 1 km from the base");
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.sensorPose.x(999); }), "");
  const auto stretched = [](double factor) {
    return [factor](Scan& s) {
      s.sensorPose.setRotationMatrix(mrpt::math::CMatrixDouble33(factor * Eigen::Matrix3d::Identity()));
    };
  };
  EXPECT_EQ(reasonOf<Scan>(laser(), stretched(1e200)), "the sensor pose is not valid")
      << "of a quaternion of any length";
  EXPECT_EQ(reasonOf<Scan>(laser(), stretched(1.00001)), "") << "rounded";
}

TEST(ObservationGate, ScansHaveAnAperture) {
  using Scan = CObservation2DRangeScan;
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.aperture = static_cast<float>(kNan); }),
            "the aperture is not finite");
  for (const double wrong : {0.0, -1.0, 7.0, 1e30}) {
    EXPECT_EQ(reasonOf<Scan>(laser(), [&](Scan& s) { s.aperture = static_cast<float>(wrong); }),
              "the aperture is not between 0 and 400 deg");
  }
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.aperture = static_cast<float>(2 * M_PI); }), "");
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.setScanRange(3, static_cast<float>(kNan)); }), "") << "one beam";
  EXPECT_EQ(reasonOf<Scan>(laser(), [](Scan& s) { s.resizeScan(0); }), "") << "it saw nothing, and has its pose";
}

TEST(ObservationGate, DepthImagesHaveACalibrationAndAUnit) {
  using Scan = CObservation3DRangeScan;
  EXPECT_EQ(reasonOf<Scan>(camera(), [](Scan& s) { s.cameraParams.fx(kNan); }),
            "the camera's calibration is not finite");
  EXPECT_EQ(reasonOf<Scan>(camera(), [](Scan& s) { s.cameraParams.dist[2] = kInf; }),
            "the camera's calibration is not finite");
  EXPECT_EQ(reasonOf<Scan>(camera(), [](Scan& s) { s.cameraParams.fy(0); }), "")
      << "extractors report that the camera is not calibrated";
  EXPECT_EQ(reasonOf<Scan>(camera(), [](Scan& s) { s.rangeUnits = -0.001F; }), "the unit of depth is not positive");
}

TEST(ObservationGate, MotionsAndTheirCovariancesAreFinite) {
  using Odometry = CObservationOdometry;
  EXPECT_EQ(reasonOf<Odometry>({}, [](Odometry& o) { o.odometry.phi(kInf); }), "the pose is not finite");
  using Motion = obs::CObservationRelativeMotion;
  EXPECT_EQ(reasonOf<Motion>({}, [](Motion& m) { m.begin_from_end.x(kNan); }), "the motion is not valid");
  const auto covariance = [](const std::function<void(Eigen::Matrix<double, 6, 6>&)>& spoil) {
    return reasonOf<Motion>({}, [&](Motion& m) { spoil(m.covariance); });
  };
  const std::string none =
      "the covariance is not valid: it is not finite, not symmetric, or has a negative variance in some direction";
  EXPECT_EQ(covariance([](auto& c) { c(0, 0) = kInf; }), none);
  EXPECT_EQ(covariance([](auto& c) { c(0, 1) = 0.1; }), none) << "not symmetric";
  EXPECT_EQ(covariance([](auto& c) { c(5, 5) = -0.1; }), none);
  EXPECT_EQ(covariance([](auto& c) { c(0, 0) = c(1, 1) = 1, c(0, 1) = c(1, 0) = 1.1; }), none) << "correlation 1.1";
  EXPECT_EQ(covariance([](auto& c) { c(0, 0) = 1; }), "") << "what cannot move has no variance";
  using Pose = CObservationRobotPose;
  EXPECT_EQ(reasonOf<Pose>({}, [](Pose& p) { p.pose.mean.z(kNan); }), "the pose is not valid");
  EXPECT_EQ(reasonOf<Pose>({}, [&](Pose& p) { p.pose.cov(3, 3) = -1; }), none);
}

TEST(ObservationGate, MeasurementsAreFinite) {
  using Ranges = CObservationBearingRange;
  Ranges good;
  good.sensedData.resize(1);
  good.sensedData[0].range = 3;
  good.sensedData[0].yaw = 0.1;
  good.sensedData[0].pitch = 0;
  EXPECT_EQ(reasonOf<Ranges>(good, [](Ranges& s) { s.sensedData[0].yaw = static_cast<float>(kNan); }),
            "one of the bearings or ranges is not finite");
  good.validCovariances = true;
  good.sensedData[0].covariance.setIdentity();
  EXPECT_NE(reasonOf<Ranges>(good, [](Ranges& s) { s.sensedData[0].covariance(1, 1) = -1; }), "");
}

TEST(ObservationGate, CommandsHaveAFiniteMotionAndExpiry) {
  using Command = obs::CObservationCommand;
  EXPECT_EQ(reasonOf<Command>({}, [](Command& c) { c.expiry = kNan; }), "the command's expiry is not a time");
  EXPECT_EQ(reasonOf<Command>({}, [](Command& c) { c.expiry = -1; }), "the command's expiry is not a time");
  EXPECT_EQ(reasonOf<Command>({}, [](Command& c) { c.motion.z() = kInf; }), "the command's motion is not finite");
}

TEST(ObservationGate, ImagesHaveAFiniteCalibration) {
  using Image = CObservationImage;
  EXPECT_EQ(reasonOf<Image>({}, [](Image& i) { i.cameraParams.cx(kNan); }), "the camera's calibration is not finite");
}

TEST(ObservationGate, AnImageOfAnotherSizeIsLeftOutUntilItIsTheUsualOne) {
  ObservationGate gate;
  const auto refused = [&](int rows, int columns, const std::string& label = "kinect") {
    auto image = camera(rows, columns);
    image.sensorLabel = label;
    return gate.refuses(image).has_value();
  };
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(refused(48, 64));
  EXPECT_TRUE(refused(3000, 3000));
  EXPECT_TRUE(refused(1, 1));
  EXPECT_FALSE(refused(1, 1, "another")) << "each sensor has its own";
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(refused(48, 64));
  int lost = 0;
  while (refused(24, 32)) ++lost;
  EXPECT_EQ(lost, 4) << "five of ten are as common as the old size";
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(refused(24, 32));
  EXPECT_TRUE(refused(48, 64));
}

}  // namespace
}  // namespace omnimapper::source::observation_gate_test
