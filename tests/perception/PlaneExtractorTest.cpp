#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/testing/Fixtures.h>

#include <thread>

#include "../camera/RangeScans.h"

namespace omnimapper::perception::plane_extractor_test {
namespace {

using namespace camera::scans;
using base::ExitCode;
using obs::Rgb;
using Planes = std::vector<obs::ObservedPlane>;

const auto kWall = [](int, int) { return 2.; };
// A wall 2 m ahead whose right half is one metre farther.
const auto kTwoWalls = [](int x, int) { return x < kWidth / 2 ? 2. : 3.; };

std::shared_ptr<obs::CObservationPlanes> extract(const mrpt::obs::CObservation3DRangeScan& scan, double tolerance = 1) {
  return PlaneExtractor({}, {tolerance}).extract(scan);
}

std::string failureOf(const mrpt::obs::CObservation3DRangeScan& scan, ExitCode code) {
  try {
    extract(scan);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "no failure";
}

std::string bytesOf(const obs::CObservationPlanes& planes) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << planes;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

// Whether the polygon has a vertex at that point.
bool hasVertex(const geometry::Polygon3& polygon, const Eigen::Vector3d& point) {
  return std::any_of(polygon.vertices.begin(), polygon.vertices.end(),
                     [&](const Eigen::Vector3d& vertex) { return (vertex - point).norm() < 1e-4; });
}

TEST(PlaneExtractor, AWallStraightAheadAsWorkedByHand) {
  const auto scan = rangeScan(kWall);
  const auto found = extract(scan);
  EXPECT_EQ(found->sensorLabel, "kinect.planes");
  EXPECT_EQ(found->source_label, "kinect");
  EXPECT_EQ(found->timestamp, scan.timestamp);
  EXPECT_EQ(found->sensorPose, scan.sensorPose);
  ASSERT_EQ(found->planes.size(), 1U);
  const auto& wall = found->planes[0];
  EXPECT_LT((wall.plane_in_sensor.normal - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-5) << "x is ahead";
  EXPECT_NEAR(wall.plane_in_sensor.distance, 2, 1e-5);
  EXPECT_LT((wall.centroid - Eigen::Vector3d(2, 0, 0)).norm(), 1e-5);
  EXPECT_EQ(wall.inliers, kWidth * kHeight);
  EXPECT_FALSE(wall.colour);
  // The corners of the image are half a pixel beyond the middles of its outermost pixels.
  ASSERT_EQ(wall.outline.vertices.size(), 4U);
  for (const double left : {-1.6, 1.6}) {
    for (const double up : {-1.2, 1.2}) EXPECT_TRUE(hasVertex(wall.outline, {2, left, up})) << left << " " << up;
  }
  EXPECT_NEAR(geometry::areaVector(wall.outline).x(), -3.2 * 2.4, 1e-3) << "counter-clockwise for the sensor";
}

TEST(PlaneExtractor, AFloorBelowPointsUp) {
  const auto found = extract(rangeScan([](int, int y) { return y > 64 ? 100 / (y - 59.5) : 0; }));
  ASSERT_EQ(found->planes.size(), 1U);
  EXPECT_LT((found->planes[0].plane_in_sensor.normal - Eigen::Vector3d(0, 0, 1)).norm(), 1e-3);
  EXPECT_NEAR(found->planes[0].plane_in_sensor.distance, 1, 1e-3);
}

TEST(PlaneExtractor, CovarianceIsThatOfTheSegmenterInTheSensorsFrame) {
  const auto scan = rangeScan([](int x, int y) { return 2 / (1 + 0.002 * (x - 79.5) + 0.003 * (y - 59.5)); });
  const auto found = extract(scan);
  ASSERT_EQ(found->planes.size(), 1U);
  const camera::DepthImage image(scan.rangeImage.data(), kUnits, kWidth, kHeight, {kFocal, kFocal, 79.5, 59.5});
  const auto expected = PlaneSegmenter({}).segment(image).planes.at(0);
  EXPECT_NEAR(found->planes[0].covariance(2, 2), expected.covariance(2, 2), 1e-12);
  // A rotation about a given axis is the same rotation in both frames.
  const auto& plane = found->planes[0];
  const Eigen::Vector3d there = expected.plane_in_sensor.normal, here = plane.plane_in_sensor.normal;
  EXPECT_LT((here - Eigen::Vector3d(there.z(), -there.x(), -there.y())).norm(), 1e-12);
  const auto spaceCovariance = [](const Eigen::Vector3d& normal, const Eigen::Matrix3d& covariance) {
    const auto basis = geometry::tangentBasis(normal);
    return Eigen::Matrix3d(basis * covariance.topLeftCorner<2, 2>() * basis.transpose());
  };
  const Eigen::Matrix3d a = spaceCovariance(there, expected.covariance), b = spaceCovariance(here, plane.covariance);
  EXPECT_NEAR(b(0, 0), a(2, 2), 1e-15);
  EXPECT_NEAR(b(1, 1), a(0, 0), 1e-15);
  EXPECT_NEAR(b(2, 2), a(1, 1), 1e-15);
  EXPECT_NEAR(b(0, 1), -a(2, 0), 1e-15);
}

TEST(PlaneExtractor, HolesAndOutlinesAreSimplified) {
  // A slanted step, which is a staircase in pixels, and a window.
  const auto scan = rangeScan([](int x, int y) {
    if (x > 20 && x < 50 && y > 40 && y < 70) return 0.;
    return 3 * x < 300 + y ? 2. : 3.;
  });
  const auto all = extract(scan, 0), few = extract(scan, 1);
  ASSERT_EQ(all->planes.size(), 2U);
  ASSERT_EQ(few->planes.size(), 2U);
  EXPECT_GT(all->planes[0].outline.vertices.size(), 60U);
  EXPECT_LT(few->planes[0].outline.vertices.size(), 10U);
  ASSERT_EQ(few->planes[0].holes.size(), 1U);
  EXPECT_EQ(few->planes[0].holes[0].vertices.size(), 4U);
  EXPECT_NEAR(geometry::area(few->planes[0].outline), geometry::area(all->planes[0].outline), 0.03);
  EXPECT_LT(geometry::areaVector(few->planes[0].outline).dot(geometry::areaVector(few->planes[0].holes[0])), 0);
}

TEST(PlaneExtractor, PlanesHaveTheMeanColourOfWhatTheyCover) {
  auto scan = rangeScan(kTwoWalls);
  addColours(scan);
  const auto found = extract(scan);
  ASSERT_EQ(found->planes.size(), 2U);
  const bool left_first = found->planes[0].centroid.y() > 0;
  EXPECT_EQ(*found->planes[left_first ? 0 : 1].colour, (Rgb{200, 10, 20}));
  EXPECT_EQ(*found->planes[left_first ? 1 : 0].colour, (Rgb{30, 220, 40}));
}

TEST(PlaneExtractor, ColourAndDepthMayBeOfDifferentSize) {
  for (const int part : {1, 4}) {  // halves of the depth's side
    auto scan = rangeScan(kTwoWalls);
    addColours(scan, kWidth * part / 2, kHeight * part / 2);
    const auto found = extract(scan);
    ASSERT_EQ(found->planes.size(), 2U);
    const bool left_first = found->planes[0].centroid.y() > 0;
    EXPECT_EQ(*found->planes[left_first ? 0 : 1].colour, (Rgb{200, 10, 20})) << part;
    EXPECT_EQ(*found->planes[left_first ? 1 : 0].colour, (Rgb{30, 220, 40})) << part;
  }
}

TEST(PlaneExtractor, ColoursAreSeenFromWhereTheirCameraIs) {
  // From 1.6 m to the right, a wall 2 m ahead is 80 pixels farther left, so that its left half is out of view.
  auto scan = rangeScan(kWall);
  addColours(scan);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -1.6, 0, -0.5 * M_PI, 0, -0.5 * M_PI);
  EXPECT_EQ(*extract(scan)->planes.at(0).colour, (Rgb{200, 10, 20}));
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -5, 0, -0.5 * M_PI, 0, -0.5 * M_PI);
  EXPECT_FALSE(extract(scan)->planes.at(0).colour) << "out of view";
}

PlaneExtractor byColour() {
  PlaneComparisonOptions comparison;
  comparison.comparison = &kSamePlaneAndColour;
  return PlaneExtractor({}, {}, comparison);
}

TEST(PlaneExtractor, AWallOfTwoColoursFallsInTwo) {
  auto scan = rangeScan(kWall);
  addColours(scan);
  EXPECT_EQ(extract(scan)->planes.size(), 1U);
  const auto halves = byColour().extract(scan);
  ASSERT_EQ(halves->planes.size(), 2U);
  for (const auto& half : halves->planes) EXPECT_EQ(half.inliers, kWidth * kHeight / 2);
  const bool left_first = halves->planes[0].centroid.y() > 0;
  EXPECT_EQ(*halves->planes[left_first ? 0 : 1].colour, (Rgb{200, 10, 20}));
  EXPECT_EQ(*halves->planes[left_first ? 1 : 0].colour, (Rgb{30, 220, 40}));
}

TEST(PlaneExtractor, ColoursThatSeparatePlanesAreSeenFromWhereTheirCameraIs) {
  // From 0.4 m to the right, a wall 2 m ahead is 20 pixels farther left, so that as many columns of its right half are
  // out of view.
  auto scan = rangeScan(kWall);
  addColours(scan);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -0.4, 0, -0.5 * M_PI, 0, -0.5 * M_PI);
  const auto parts = byColour().extract(scan);
  ASSERT_EQ(parts->planes.size(), 3U) << "red, green, and what the picture does not show";
  EXPECT_EQ(parts->planes[0].inliers, (kWidth / 2 + 20 - 20) * kHeight);
  EXPECT_EQ(parts->planes[1].inliers, (kWidth / 2 - 20) * kHeight);
  EXPECT_EQ(parts->planes[2].inliers, 20 * kHeight);
  EXPECT_FALSE(parts->planes[2].colour);
}

TEST(PlaneExtractor, AComparatorOfColoursNeedsAPicture) {
  try {
    byColour().extract(rangeScan(kWall));
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    for (const char* word : {"kinect", "picture", "comparator = plane"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(PlaneExtractor, GreysAreColoursToo) {
  auto scan = rangeScan(kWall);
  addColours(scan);
  mrpt::img::CImage grey(kWidth, kHeight, mrpt::img::CH_GRAY);
  grey.filledRectangle(0, 0, kWidth - 1, kHeight - 1, mrpt::img::TColor(77, 77, 77));
  scan.intensityImage = grey;
  EXPECT_EQ(*extract(scan)->planes.at(0).colour, (Rgb{77, 77, 77}));
  scan.intensityImage.resize(kWidth, kHeight, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
  EXPECT_FALSE(extract(scan)->planes.at(0).colour) << "16 bits are no colours";
}

TEST(PlaneExtractor, RangesAlongTheRaysAreNoDepths) {
  auto scan = rangeScan([](int x, int y) { return 2 * std::hypot(1, (x - 79.5) / kFocal, (y - 59.5) / kFocal); });
  scan.range_is_depth = false;
  const auto found = extract(scan);
  ASSERT_EQ(found->planes.size(), 1U);
  EXPECT_LT((found->planes[0].plane_in_sensor.normal - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-4);
  EXPECT_NEAR(found->planes[0].plane_in_sensor.distance, 2, 1e-4);
  scan.rangeImage.fill(65535);
  EXPECT_TRUE(extract(scan)->planes.empty());
}

TEST(PlaneExtractor, TheUnitOfRangesCounts) {
  auto scan = rangeScan(kWall);
  scan.rangeUnits = 2 * kUnits;
  EXPECT_NEAR(extract(scan)->planes.at(0).plane_in_sensor.distance, 4, 1e-4);
  for (const float units : {0.F, -1.F, std::nanf("")}) {
    scan.rangeUnits = units;
    EXPECT_NE(failureOf(scan, ExitCode::unreadable_input).find("kinect"), std::string::npos);
  }
}

TEST(PlaneExtractor, NothingMeasuredIsNoPlane) {
  EXPECT_TRUE(extract(rangeScan([](int, int) { return 0.; }))->planes.empty());
  EXPECT_TRUE(extract(rangeScan([](int, int) { return 100.; }))->planes.empty()) << "65535 is saturated";
  EXPECT_TRUE(extract(rangeScan(kWall, 1, 1))->planes.empty());
  EXPECT_TRUE(extract(rangeScan(kWall, 0, 0))->planes.empty());
  mrpt::obs::CObservation3DRangeScan nothing;
  nothing.sensorLabel = "kinect";
  EXPECT_TRUE(extract(nothing)->planes.empty()) << "no depths at all, no calibration";
  auto scan = rangeScan([](int, int) { return 0.; });
  addColours(scan);
  EXPECT_TRUE(extract(scan)->planes.empty());
}

TEST(PlaneExtractor, ACameraWithoutCalibrationIsAnErrorThatNamesIt) {
  auto scan = rangeScan(kWall);
  scan.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  const auto failure = failureOf(scan, ExitCode::unreadable_input);
  EXPECT_NE(failure.find("kinect"), std::string::npos) << failure;
  EXPECT_NE(failure.find("calibrate"), std::string::npos) << failure;
}

TEST(PlaneExtractor, ImagesThatWereNotLoadedAreAnErrorThatNamesThem) {
  auto scan = rangeScan(kWall);
  scan.hasIntensityImage = true;
  scan.intensityImage.setExternalStorage("/nowhere/colour.jpg");
  EXPECT_NE(failureOf(scan, ExitCode::missing_images).find("/nowhere/colour.jpg"), std::string::npos);

  const testing::ScratchFolder folder;
  auto in_file = rangeScan(kWall);
  in_file.rangeImage_convertToExternalStorage("range.bin", folder.path() + "/");
  in_file.unload();
  EXPECT_NE(failureOf(in_file, ExitCode::missing_images).find("range.bin"), std::string::npos);
}

TEST(PlaneExtractor, ThreadsAndRepetitionChangeNoBit) {
  auto scan = rangeScan([](int x, int y) { return x < 90 ? 2 + 0.01 * y : 3 - 0.004 * x; });
  addColours(scan);
  const PlaneExtractor extractor({}, {});
  const std::string expected = bytesOf(*extractor.extract(scan));
  std::vector<std::string> bytes(4);
  std::vector<std::thread> threads;
  for (auto& result : bytes) threads.emplace_back([&] { result = bytesOf(*extractor.extract(scan)); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : bytes) EXPECT_TRUE(result == expected);
}

}  // namespace
}  // namespace omnimapper::perception::plane_extractor_test
