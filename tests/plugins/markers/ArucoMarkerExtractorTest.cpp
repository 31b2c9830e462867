#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/MapperRun.h>
#include <omnimapper/testing/MarkerPicture.h>

#include <cmath>
#include <optional>

#include "points/PointPayload.h"

namespace omnimapper::plugins::aruco_marker_extractor_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;
using mrpt::obs::CObservationBearingRange;
using mrpt::obs::CObservationImage;

constexpr double kPi = 3.14159265358979323846, kSide = 0.3;
constexpr int kWidth = 640, kHeight = 480, kLooks = 60;
const mrpt::poses::CPose3D kBaseFromCamera(0.1, 0, 0.6, -kPi / 2, 0, -kPi / 2);

const std::string kIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = points
[perception]
extractors = markers
[trigger]
every_observation = true
[odometry]
class = OdometryPlugin
[markers]
class  = ArucoMarkerExtractor
side_m = 0.3
[points]
class = PointLandmarksPlugin
)";

/// Number i, on the walls of a room of 5 m x 4 m around the origin.
std::vector<Se3> markersOnWalls() {
  std::vector<Se3> all;
  for (int wall = 0; wall < 4; ++wall) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(wall * kPi / 2, Vector3d::UnitZ()));
    Eigen::Matrix3d axes;  // right, up, out of the wall that is at +x
    axes << 0, 0, -1, -1, 0, 0, 0, 1, 0;
    for (const double along : {-0.9, 0.6})
      all.push_back(
          {turn * Eigen::Quaterniond(axes), turn * Vector3d(wall % 2 == 0 ? 2.5 : 2, along, 0.6 + 0.3 * along)});
  }
  return all;
}

mrpt::img::TCamera camera() {
  mrpt::img::TCamera camera;
  camera.ncols = kWidth;
  camera.nrows = kHeight;
  camera.setIntrinsicParamsFromValues(500, 500, 319.5, 239.5);
  return camera;
}

/// Where the camera sees the corners of a marker in front of it; none unless the picture has room for all.
std::optional<testing::MarkerCorners> seen(const Se3& optical_from_marker) {
  const double half = kSide / 2;
  const Vector3d corners[] = {{-half, half, 0}, {half, half, 0}, {half, -half, 0}, {-half, -half, 0}};
  testing::MarkerCorners places;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = optical_from_marker * corners[i];
    if (p.z() < 0.3) return std::nullopt;
    places[i] = {500 * p.x() / p.z() + 319.5, 500 * p.y() / p.z() + 239.5};
    if (!(places[i].x() > 5 && places[i].x() < kWidth - 6 && places[i].y() > 5 && places[i].y() < kHeight - 6))
      return std::nullopt;
  }
  return places;
}

/// In a circle of 0.8 m around the room's middle, once.
mrpt::poses::CPose2D mapFromBase(int look) {
  const double angle = 2 * kPi * look / kLooks;
  return {0.8 * std::cos(angle), 0.8 * std::sin(angle), angle + kPi / 2};
}

CObservationImage::Ptr look(int k) {
  const Se3 map_from_camera = geometry::fromMrpt(mrpt::poses::CPose3D(mapFromBase(k)) + kBaseFromCamera);
  testing::MarkerPicture drawn(kWidth, kHeight);
  const auto markers = markersOnWalls();
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const auto corners = seen(geometry::inverse(map_from_camera) * markers[i]);
    if (corners) drawn.draw(static_cast<int>(i), *corners);
  }
  auto picture = CObservationImage::Create();
  picture->timestamp = base::stampFromUnix(1000 + 0.5 * k);
  picture->sensorLabel = "camera";
  picture->cameraParams = camera();
  picture->cameraPose = kBaseFromCamera;
  picture->image = drawn.grey();
  return picture;
}

/// Odometry that turns 6 degrees too much in a round, and measures ways 3 % too long.
std::vector<mrpt::obs::CObservation::Ptr> drive() {
  std::vector<mrpt::obs::CObservation::Ptr> all;
  mrpt::poses::CPose2D odom_from_base;
  for (int k = 0; k < kLooks; ++k) {
    if (k > 0) {
      const auto step = mapFromBase(k) - mapFromBase(k - 1);
      odom_from_base = odom_from_base + mrpt::poses::CPose2D(1.03 * step.x(), 1.03 * step.y(), step.phi() + 0.0017);
    }
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->timestamp = base::stampFromUnix(1000 + 0.5 * k);
    odometry->sensorLabel = "odometry";
    odometry->odometry = odom_from_base;
    all.push_back(odometry);
    all.push_back(look(k));
  }
  return all;
}

TEST(ArucoMarkerExtractorOfAnIni, MarkersOfADriveBecomeLandmarksWhereTheyAre) {
  const auto engine = testing::makeEngine(kIni);
  testing::run(*engine, drive());
  const auto view = engine->view();
  const auto markers = markersOnWalls();
  ASSERT_EQ(view.map.landmarks.size(), markers.size());
  const Se3 truth_from_map = geometry::fromMrpt(mrpt::poses::CPose3D(mapFromBase(0)));
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto& payload = dynamic_cast<const PointPayload&>(*landmark.payload);
    EXPECT_EQ(landmark.kind, "marker");
    EXPECT_GT(payload.seen_by.at("camera.markers"), 5);
    const Eigen::VectorXd& there = view.graph.value(landmark.variables.front());
    const Vector3d middle = markers.at(static_cast<std::size_t>(payload.number)).translation;
    const Vector3d found = truth_from_map * Vector3d(there[0], there[1], 0);
    EXPECT_LT((found - middle).head<2>().norm(), 0.03) << payload.number;
    const auto shape = payload.shape({there}, view.map.key_frames);
    EXPECT_NEAR(shape.points.front().z(), middle.z(), 0.02) << payload.number;
  }
}

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[markers]\nclass = ArucoMarkerExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"markers"}, {}, {}}, config, {});
}

TEST(ArucoMarkerExtractorOfAnIni, TurnsPicturesAndNothingElseIntoRangesAndBearings) {
  const auto set = made("side_m = 0.3\n");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation2DRangeScan()));
  mrpt::obs::CObservation3DRangeScan scan;
  EXPECT_FALSE(extractor.wants(scan)) << "it has no picture";
  scan.hasIntensityImage = true;
  EXPECT_TRUE(extractor.wants(scan));
  const auto picture = look(0);
  ASSERT_TRUE(extractor.wants(*picture));
  const auto derived = extractor.extract(*picture);
  ASSERT_EQ(derived.size(), 1U);
  EXPECT_FALSE(dynamic_cast<const CObservationBearingRange&>(*derived.front()).sensedData.empty());
  const auto names = extractor.namesOf(*picture);
  ASSERT_EQ(names.size(), 1U);
  EXPECT_EQ(names.front().label, derived.front()->sensorLabel);
}

TEST(ArucoMarkerExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_NO_THROW(made("dictionary = 6x6_250\nrefinement = gradients\n"));
  EXPECT_THROW(made("dictionary = 9x9\n"), base::Error);
  EXPECT_THROW(made("side_m = 0\n"), base::Error);
  EXPECT_THROW(made("corner_sigma_px = 0\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::aruco_marker_extractor_test
