// Gives each extractor what broken sensors, drivers and logs produce. It must find nothing or throw a clear error.
#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMap.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/CloudPlaneExtractor.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/perception/RoadExtractor.h>

#include <limits>
#include <string>
#include <vector>

#include "../camera/RangeScans.h"

namespace omnimapper::perception::bad_input_test {
namespace {

using namespace camera::scans;
using mrpt::obs::CObservation3DRangeScan;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr camera::Pinhole kCamera{kFocal, kFocal, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1)};

/// Number of results of each kind.
struct Found {
  std::size_t planes = 0, objects = 0, ground = 0, edges = 0, rgb_edges = 0;
};

std::ostream& operator<<(std::ostream& out, const Found& found) {
  return out << found.planes << " planes, " << found.objects << " objects, " << found.ground << " of ground, "
             << found.edges << " and " << found.rgb_edges << " on edges";
}

bool operator==(const Found& a, const Found& b) {
  return a.planes == b.planes && a.objects == b.objects && a.ground == b.ground && a.edges == b.edges &&
         a.rgb_edges == b.rgb_edges;
}

// Runs every extractor of depth images.
Found extractAll(const CObservation3DRangeScan& scan) {
  Found found;
  found.planes = PlaneExtractor({}, {}).extract(scan)->planes.size();
  const auto objects = ObjectExtractor({}).extract(scan);
  EXPECT_EQ(objects.planes->planes.size(), found.planes);
  found.objects = objects.objects->objects.size();
  found.ground = RoadExtractor({}, {}, {}).extract(scan)->planes.size();
  for (const auto& cloud : EdgeExtractor({}).extract(scan)) {
    const bool rgb = cloud->sensorLabel == scan.sensorLabel + kEdgesSuffix + nameOf(kRgb);
    (rgb ? found.rgb_edges : found.edges) += cloud->pointcloud->size();
  }
  return found;
}

// Runs everything that takes a depth image.
Found findAll(const std::vector<float>& metres) {
  const camera::DepthImage image(metres.data(), kWidth, kHeight, kCamera);
  Found found;
  const auto planes = PlaneSegmenter({}).segment(image);
  found.planes = planes.planes.size();
  found.objects = ObjectFinder({}, {}).find(image, planes, -Eigen::Vector3d::UnitY()).size();
  found.ground = RoadSegmenter({}).segment(image, {-Eigen::Vector3d::UnitY(), 1}).ground.planes.size();
  for (const auto kind : kEdgeKinds) found.edges += edgePoints(EdgeDetector({}).detect(image), image, kind).size();
  return found;
}

TEST(BadInput, DepthThatIsNowhereAMeasurementGivesNothing) {
  for (const float depth : {kNan, std::numeric_limits<float>::infinity(), -1.F, 0.F, 1e-30F, 1e30F})
    EXPECT_EQ(findAll(std::vector<float>(kWidth * kHeight, depth)), Found()) << depth;
  EXPECT_EQ(extractAll(rangeScan([](int, int) { return 0.; })), Found());
  EXPECT_EQ(extractAll(rangeScan([](int, int) { return 100.; })), Found()) << "65535 is saturated";
}

TEST(BadInput, ConstantDepthIsOneWallAndNothingElse) {
  Found wall;
  wall.planes = 1;
  EXPECT_EQ(extractAll(rangeScan([](int, int) { return 2.; })), wall);
  EXPECT_EQ(findAll(std::vector<float>(kWidth * kHeight, 2.F)), wall);
}

TEST(BadInput, ImagesOfNoOrOnePixelGiveNothing) {
  for (const auto& [width, height] : {std::pair{0, 0}, {0, 5}, {5, 0}, {1, 1}, {1, 200}, {200, 1}}) {
    auto scan = rangeScan([](int, int) { return 2.; }, width, height);
    EXPECT_EQ(extractAll(scan), Found()) << width << " x " << height;
    addColours(scan);
    Found found = extractAll(scan);
    EXPECT_LE(found.rgb_edges, static_cast<std::size_t>(width * height));
    found.rgb_edges = 0;
    EXPECT_EQ(found, Found()) << width << " x " << height << " with a picture of another size";
  }
}

TEST(BadInput, AScanWithoutAnythingGivesNothing) {
  CObservation3DRangeScan scan;
  EXPECT_EQ(extractAll(scan), Found());
  scan.hasRangeImage = scan.hasIntensityImage = true;
  EXPECT_EQ(extractAll(scan), Found()) << "the scan declares images but has none";
}

TEST(BadInput, SaturatedPixelsAreHoles) {
  // The right half is beyond 6.5 m, the largest depth that 16 bits hold in this unit.
  const auto scan = rangeScan([](int x, int) { return x < kWidth / 2 ? 2. : 7.; });
  const auto planes = PlaneExtractor({}, {}).extract(scan)->planes;
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_EQ(planes[0].inliers, kWidth / 2U * kHeight);
  EXPECT_EQ(extractAll(scan).edges, std::size_t{kHeight}) << "the boundary before the hole";
}

TEST(BadInput, APictureOfAnotherSizeChangesNothingOfTheGeometry) {
  auto scan = rangeScan([](int x, int y) { return x > 50 && x < 90 && y > 30 && y < 80 ? 1.2 : 2.; });
  const Found plain = extractAll(scan);
  EXPECT_GE(plain.planes, 1U);
  EXPECT_GT(plain.edges, 0U);
  for (const auto& [width, height] :
       {std::pair{1, 1}, {3, 400}, {400, 3}, {80, 60}, {kWidth + 1, kHeight}, {640, 480}}) {
    addColours(scan, width, height);
    Found coloured = extractAll(scan);
    coloured.rgb_edges = plain.rgb_edges;
    EXPECT_EQ(coloured, plain) << width << " x " << height;
  }
}

TEST(BadInput, PointsWithoutOrderAreNoImage) {
  CObservation3DRangeScan scan;
  scan.sensorLabel = "kinect";
  scan.hasPoints3D = true;
  scan.resizePoints3DVectors(1000);
  for (std::size_t i = 0; i < 1000; ++i) scan.points3D_x[i] = 2;
  EXPECT_EQ(extractAll(scan), Found()) << "no extractor takes them for a depth image";
}

TEST(BadInput, PlanesOfAnotherImageAreRefused) {
  const std::vector<float> wall(kWidth * kHeight, 2.F);
  const camera::DepthImage image(wall.data(), kWidth, kHeight, kCamera),
      half(wall.data(), kWidth, kHeight / 2, kCamera);
  const auto planes = PlaneSegmenter({}).segment(image);
  EXPECT_THROW(ObjectFinder({}, {}).find(half, planes, Eigen::Vector3d::UnitZ()), base::Error);
}

TEST(BadInput, ACloudOfOnePlaceOrOfNothingHasNoPlanes) {
  const CloudPlaneFinder finder({});
  for (const float value : {kNan, std::numeric_limits<float>::infinity(), 0.F, 2.F, 1e30F}) {
    const auto found = finder.find(std::vector<Eigen::Vector3f>(5000, Eigen::Vector3f::Constant(value)));
    EXPECT_TRUE(found.planes.empty()) << value;
    EXPECT_EQ(found.labels, std::vector<std::uint16_t>(5000, 0)) << value;
  }
}

TEST(BadInput, AScanWithOneValidBeamHasNoLineAndOnePoint) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = 3.14F;
  scan.maxRange = 30;
  scan.resizeScan(181);
  for (std::size_t i = 0; i < 181; ++i) {
    scan.setScanRange(i, i == 90 ? 2.F : kNan);
    scan.setScanRangeValidity(i, i == 90);
  }
  for (const auto method : {LaserLineOptions::Method::ransac, LaserLineOptions::Method::split_and_merge}) {
    LaserLineOptions options;
    options.method = method;
    EXPECT_TRUE(LaserLineExtractor(options).extract(scan)->lines.empty());
  }
  const auto points = LaserPointsExtractor({}).extract(scan);
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*points);
  EXPECT_EQ(cloud.pointcloud->size(), 1U);
}

TEST(BadInput, AScanWhoseBeamsHaveNoKnownDirectionHasNeitherLinesNorPoints) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.maxRange = 30;
  scan.resizeScan(181);
  for (std::size_t i = 0; i < 181; ++i) {
    scan.setScanRange(i, 2);
    scan.setScanRangeValidity(i, true);
  }
  for (const float aperture : {kNan, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    scan.aperture = aperture;
    for (const auto method : {LaserLineOptions::Method::ransac, LaserLineOptions::Method::split_and_merge}) {
      LaserLineOptions options;
      options.method = method;
      EXPECT_TRUE(LaserLineExtractor(options).extract(scan)->lines.empty()) << aperture;
    }
    const auto points = LaserPointsExtractor({}).extract(scan);
    EXPECT_EQ(dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*points).pointcloud->size(), 0U) << aperture;
  }
}

TEST(BadInput, APictureOfACameraWithAnImpossibleCalibrationTakesNoLonger) {
  auto scan = rangeScan([](int, int) { return 2.; });
  addColours(scan, 2 * kWidth, 2 * kHeight);
  for (const double focal : {0., 1e-300, 1e9, 1e300, std::nan(""), -100.}) {
    scan.cameraParamsIntensity.setIntrinsicParamsFromValues(focal, focal, kWidth, kHeight);
    Found found = extractAll(scan);
    found.rgb_edges = 0;
    Found wall;
    wall.planes = 1;
    EXPECT_EQ(found, wall) << focal;
  }
}

}  // namespace
}  // namespace omnimapper::perception::bad_input_test
