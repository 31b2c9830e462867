#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/testing/MarkerPicture.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "markers/ArucoMarkerExtractor.h"
#include "markers/MarkerPose.h"

namespace omnimapper::perception::aruco_marker_extractor_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationBearingRange;
using mrpt::obs::CObservationImage;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kSide = 0.16, kDegree = 3.14159265358979323846 / 180;

mrpt::img::TCamera camera() {
  mrpt::img::TCamera camera;
  camera.ncols = kWidth;
  camera.nrows = kHeight;
  camera.setIntrinsicParamsFromValues(600, 605, 321.3, 238.8);
  return camera;
}

/// A marker that faces the camera except for its tilts [rad] about its vertical and its horizontal axis.
struct Placed {
  int id;
  Vector3d middle;  ///< in the optical frame [m]
  double about_vertical, about_horizontal;

  Se3 pose() const {
    const Eigen::Quaterniond facing(Eigen::AngleAxisd(180 * kDegree, Vector3d::UnitX()));
    const Eigen::Quaterniond tilted(Eigen::AngleAxisd(about_vertical, Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(about_horizontal, Vector3d::UnitX()));
    return {facing * tilted, middle};
  }
};

testing::MarkerCorners seen(const mrpt::img::TCamera& camera, const Se3& optical_from_marker) {
  const camera::LensModel lens(camera, "camera");
  const double half = 0.5 * kSide;
  testing::MarkerCorners corners;
  const Vector3d in_marker[] = {{-half, half, 0}, {half, half, 0}, {half, -half, 0}, {-half, -half, 0}};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = lens.project(optical_from_marker * in_marker[i]).place;
  return corners;
}

Vector3d rangeYawPitch(const Vector3d& in_optical) {
  const Vector3d p = camera::toSensor(in_optical);
  return {p.norm(), std::atan2(p.y(), p.x()), std::atan2(-p.z(), std::hypot(p.x(), p.y()))};
}

Vector3d rangeYawPitch(const CObservationBearingRange::TMeasurement& measured) {
  return Eigen::Vector3f(measured.range, measured.yaw, measured.pitch).cast<double>();
}

const std::vector<Placed> kPlaced{{3, {0, 0, 1.5}, 0, 0},
                                  {7, {-0.5, 0.25, 1.4}, 0.7, 0.1},
                                  {11, {0.45, -0.3, 1.3}, -0.5, 0.4},
                                  {40, {0.4, 0.35, 1.6}, 0.2, -0.6}};

CObservationImage picture(const std::vector<Placed>& placed = kPlaced, bool colour = false) {
  testing::MarkerPicture drawn(kWidth, kHeight);
  for (const auto& marker : placed) drawn.draw(marker.id, seen(camera(), marker.pose()));
  CObservationImage observation;
  observation.sensorLabel = "camera";
  observation.timestamp = base::stampFromUnix(10);
  observation.cameraParams = camera();
  observation.cameraPose = mrpt::poses::CPose3D(0.1, 0.2, 0.9, -90 * kDegree, 0, -90 * kDegree);
  observation.image = colour ? drawn.colour() : drawn.grey();
  return observation;
}

ArucoMarkerOptions options() {
  ArucoMarkerOptions options;
  options.side = kSide;
  return options;
}

void expectPlaced(const CObservationBearingRange& found) {
  ASSERT_EQ(found.sensedData.size(), kPlaced.size());
  for (std::size_t i = 0; i < kPlaced.size(); ++i) {
    const Vector3d truth = rangeYawPitch(kPlaced[i].middle), measured = rangeYawPitch(found.sensedData[i]);
    EXPECT_EQ(found.sensedData[i].landmarkID, kPlaced[i].id);
    EXPECT_NEAR(measured[0], truth[0], 0.002 * truth[0]) << kPlaced[i].id;
    EXPECT_NEAR(measured[1], truth[1], 0.02 * kDegree) << kPlaced[i].id;
    EXPECT_NEAR(measured[2], truth[2], 0.02 * kDegree) << kPlaced[i].id;
  }
}

TEST(ArucoMarkerExtractor, FindsWhereMarkersAreInColourAndGrey) {
  for (const bool colour : {false, true}) {
    const auto found = ArucoMarkerExtractor(options()).markersIn(picture(kPlaced, colour));
    expectPlaced(*found);
    EXPECT_EQ(found->sensorLabel, "camera.markers");
    EXPECT_EQ(found->timestamp, base::stampFromUnix(10));
    EXPECT_TRUE(found->validCovariances);
  }
}

TEST(ArucoMarkerExtractor, MeasuresInTheFrameThatLooksAlongX) {
  const auto found = ArucoMarkerExtractor(options()).markersIn(picture());
  const mrpt::poses::CPose3D expected(0.1, 0.2, 0.9, 0, 0, 0);
  EXPECT_LT((found->sensorLocationOnRobot.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>() -
             expected.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>())
                .asEigen()
                .norm(),
            1e-9);
  EXPECT_GT(found->sensedData.at(1).yaw, 0) << "it is left of the axis";
  EXPECT_GT(found->sensedData.at(1).pitch, 0) << "and below it";
}

TEST(ArucoMarkerExtractor, EveryRefinementReadsTheSameMarkers) {
  using Refinement = ArucoMarkerOptions::Refinement;
  for (const auto refinement : {Refinement::none, Refinement::gradients}) {
    auto with = options();
    with.refinement = refinement;
    const auto found = ArucoMarkerExtractor(with).markersIn(picture());
    ASSERT_EQ(found->sensedData.size(), kPlaced.size());
    for (std::size_t i = 0; i < kPlaced.size(); ++i)
      EXPECT_NEAR(static_cast<double>(found->sensedData[i].range), kPlaced[i].middle.norm(), 0.04) << kPlaced[i].id;
  }
}

// 24 px wide.
TEST(ArucoMarkerExtractor, ASmallMarkerIsMeasuredToAPercentByItsEdges) {
  for (const double lean : {0., 0.3, 0.6}) {
    const Placed far{5, {0.31, -0.22, 4}, lean, -0.2};
    const auto found = ArucoMarkerExtractor(options()).markersIn(picture({far}));
    ASSERT_EQ(found->sensedData.size(), 1U) << lean;
    EXPECT_NEAR(static_cast<double>(found->sensedData[0].range), far.middle.norm(), 0.01 * far.middle.norm()) << lean;
  }
}

TEST(ArucoMarkerExtractor, OtherDictionariesAndSmallMarkersAreLeftOut) {
  auto other = options();
  other.dictionary = ArucoMarkerOptions::Dictionary::dict_6x6_250;
  EXPECT_TRUE(ArucoMarkerExtractor(other).markersIn(picture())->sensedData.empty());
  auto large = options();
  large.min_side = 100;
  EXPECT_TRUE(ArucoMarkerExtractor(large).markersIn(picture())->sensedData.empty());
}

TEST(ArucoMarkerExtractor, TheSamePictureGivesTheSameBits) {
  const auto first = ArucoMarkerExtractor(options()).markersIn(picture()),
             second = ArucoMarkerExtractor(options()).markersIn(picture());
  ASSERT_EQ(first->sensedData.size(), second->sensedData.size());
  for (std::size_t i = 0; i < first->sensedData.size(); ++i) {
    EXPECT_EQ(rangeYawPitch(first->sensedData[i]), rangeYawPitch(second->sensedData[i]));
    EXPECT_EQ(first->sensedData[i].covariance, second->sensedData[i].covariance);
  }
}

TEST(ArucoMarkerExtractor, PicturesWithoutMarkersShowNone) {
  CObservationImage none = picture({});
  EXPECT_TRUE(ArucoMarkerExtractor(options()).markersIn(none)->sensedData.empty());
  for (const unsigned size : {1U, 2U, 17U, 40U}) {
    none.image.resize(size, size, mrpt::img::CH_GRAY);
    EXPECT_TRUE(ArucoMarkerExtractor(options()).markersIn(none)->sensedData.empty()) << size;
  }
  none.image.resize(kWidth, kHeight, static_cast<mrpt::img::TImageChannels>(4));
  EXPECT_TRUE(ArucoMarkerExtractor(options()).markersIn(none)->sensedData.empty()) << "of four channels";
  none.image = mrpt::img::CImage();
  none.cameraParams = mrpt::img::TCamera();
  EXPECT_TRUE(ArucoMarkerExtractor(options()).markersIn(none)->sensedData.empty()) << "without pixels or calibration";
}

base::ExitCode refusal(const CObservationImage& observation) {
  try {
    ArucoMarkerExtractor(options()).markersIn(observation);
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("camera"), std::string::npos) << error.what();
    return error.code();
  }
  return base::ExitCode::ok;
}

TEST(ArucoMarkerExtractor, ACameraWithoutCalibrationIsAnError) {
  for (const double focal : {0., -600., 0.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto observation = picture();
    observation.cameraParams.fx(focal);
    EXPECT_EQ(refusal(observation), base::ExitCode::unreadable_input) << focal;
  }
  auto observation = picture();
  observation.cameraParams.setDistortionPlumbBob(std::nan(""), 0, 0, 0);
  EXPECT_EQ(refusal(observation), base::ExitCode::unreadable_input);
}

TEST(ArucoMarkerExtractor, APictureThatWasNotLoadedIsAnError) {
  auto observation = picture();
  observation.image.setExternalStorage("not_there.png");
  EXPECT_EQ(refusal(observation), base::ExitCode::missing_images);
  CObservation3DRangeScan scan;
  scan.hasIntensityImage = true;
  scan.intensityImage.setExternalStorage("not_there.png");
  scan.cameraParamsIntensity = camera();
  EXPECT_THROW(ArucoMarkerExtractor(options()).markersIn(scan), base::Error);
}

TEST(ArucoMarkerExtractor, ReadsThePictureOfARangeCamera) {
  const auto shown = picture();
  CObservation3DRangeScan scan;
  scan.sensorLabel = "kinect";
  scan.sensorPose = mrpt::poses::CPose3D(0.1, 0, 0.5, 0, 0.1, 0);
  EXPECT_TRUE(ArucoMarkerExtractor(options()).markersIn(scan)->sensedData.empty()) << "it has no picture";
  scan.hasIntensityImage = true;
  scan.intensityImage = shown.image;
  scan.cameraParamsIntensity = camera();
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -0.025, 0, -90 * kDegree, 0, -90 * kDegree);
  const auto found = ArucoMarkerExtractor(options()).markersIn(scan);
  expectPlaced(*found);
  EXPECT_EQ(found->sensorLabel, "kinect.markers");
  const auto expected = scan.sensorPose + mrpt::poses::CPose3D(0, -0.025, 0, 0, 0, 0);
  EXPECT_LT(found->sensorLocationOnRobot.distanceTo(expected), 1e-9);
  EXPECT_NEAR(found->sensorLocationOnRobot.pitch(), 0.1, 1e-9);
  // The picture has the view of the depth image, whose calibration is the only one.
  scan.hasRangeImage = true;
  scan.rangeImage_setSize(kHeight, kWidth);
  scan.rangeImage.fill(1000);
  scan.cameraParams = camera();
  scan.cameraParamsIntensity = mrpt::img::TCamera();
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, 0, 0, -90 * kDegree, 0, -90 * kDegree);
  expectPlaced(*ArucoMarkerExtractor(options()).markersIn(scan));
}

TEST(ArucoMarkerPose, IsFoundThroughEveryLens) {
  auto bent = camera(), fisheye = camera();
  bent.setDistortionPlumbBob(-0.25, 0.08, 0.001, -0.002);
  fisheye.setDistortionKannalaBrandt(0.02, -0.01, 0.003, -0.001);
  for (const auto& lens : {camera(), bent, fisheye}) {
    for (const auto& placed : kPlaced) {
      const auto found = markers::poseOfMarker(camera::LensModel(lens, ""), seen(lens, placed.pose()), kSide, 0.3);
      ASSERT_TRUE(found);
      EXPECT_LT(geometry::minus(found->optical_from_marker, placed.pose()).norm(), 1e-4) << placed.id;
    }
  }
}

TEST(ArucoMarkerPose, CornersOfNoSquareHaveNoPoseThatIsNotFinite) {
  const camera::LensModel lens(camera(), "");
  const Eigen::Vector2d point(300, 200), other(320, 200);
  for (const auto& corners : {camera::Corners{point, point, point, point}, camera::Corners{point, other, point, other},
                              camera::Corners{point, other, 2 * other - point, 3 * other - 2 * point}}) {
    const auto found = markers::poseOfMarker(lens, corners, kSide, 0.3);
    EXPECT_TRUE(!found || found->covariance_of_middle.allFinite());
  }
}

// Sums of chi-square over 200 pictures with corner noise of 0.3 px, 3 degrees of freedom each: 95 % lie within 534 and
// 670. For a marker that faces the camera sums are larger: any tilt by noise makes it narrower, never wider, which the
// first-order covariance does not include.
TEST(ArucoMarkerExtractor, CovariancesHold) {
  for (const auto& placed : kPlaced) {
    testing::Dice dice(static_cast<std::uint64_t>(placed.id));
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      auto corners = seen(camera(), placed.pose());
      for (auto& corner : corners) {
        const double down = dice.normal(0.3), right = dice.normal(0.3);
        corner += Eigen::Vector2d(right, down);
      }
      testing::MarkerPicture drawn(kWidth, kHeight);
      drawn.draw(placed.id, corners);
      auto observation = picture({});
      observation.image = drawn.grey();
      const auto found = ArucoMarkerExtractor(options()).markersIn(observation);
      ASSERT_EQ(found->sensedData.size(), 1U);
      const Vector3d error = rangeYawPitch(found->sensedData[0]) - rangeYawPitch(placed.middle);
      sum += error.dot(found->sensedData[0].covariance.asEigen().inverse() * error);
    }
    const bool faces = placed.about_vertical == 0 && placed.about_horizontal == 0;
    EXPECT_GT(sum, 534) << placed.id;
    EXPECT_LT(sum, faces ? 900 : 670) << placed.id;
  }
}

}  // namespace
}  // namespace omnimapper::perception::aruco_marker_extractor_test
