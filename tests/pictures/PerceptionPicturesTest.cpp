#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/IndexColour.h>
#include <omnimapper/pictures/PerceptionPictures.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "CameraPicture.h"
#include "LaserPicture.h"

namespace omnimapper::pictures::perception_pictures_test {
namespace {

using mrpt::obs::CObservation3DRangeScan;

CObservation3DRangeScan::Ptr depthsAt(double seconds) {
  auto scan = CObservation3DRangeScan::Create();
  scan->sensorLabel = "kinect";
  scan->timestamp = base::stampFromUnix(seconds);
  scan->hasRangeImage = true;
  scan->cameraParams.setIntrinsicParamsFromValues(100, 100, 49.5, 39.5);
  scan->rangeImage_setSize(80, 100);
  scan->rangeImage.fill(2000);
  return scan;
}

geometry::Polygon3 square(double half) {
  return {{{2, half, half}, {2, half, -half}, {2, -half, -half}, {2, -half, half}}};
}

/// A square of 1 m with a hole of 0.4 m, 2 m ahead: half the image high, from pixel 25 to 75 of a row.
obs::CObservationPlanes::Ptr plane() {
  auto planes = obs::CObservationPlanes::Create();
  obs::ObservedPlane plane;
  plane.plane_in_sensor = geometry::Plane3::through({2, 0, 0}, {-1, 0, 0});
  plane.centroid = {2, 0, 0};
  plane.outline = square(0.5);
  plane.holes = {square(0.2)};
  planes->planes.push_back(plane);
  return planes;
}

class PerceptionPicturesTest : public ::testing::Test {
 protected:
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }
  mrpt::img::CImage picture(const std::string& name) const {
    mrpt::img::CImage image;
    EXPECT_TRUE(image.loadFromFile(folder_ + "/" + name));
    return image;
  }
  testing::ScratchFolder scratch_;
  const std::string folder_ = scratch_ / "a/b";
};

bool isNear(const mrpt::img::CImage& image, unsigned x, unsigned y, const mrpt::img::TColor& colour) {
  const auto* pixel = image.ptrLine<std::uint8_t>(y) + 3 * x;
  return std::abs(pixel[2] - colour.R) < 20 && std::abs(pixel[1] - colour.G) < 20 && std::abs(pixel[0] - colour.B) < 20;
}

bool isGrey(const mrpt::img::CImage& image, unsigned x, unsigned y) {
  const auto* pixel = image.ptrLine<std::uint8_t>(y) + 3 * x;
  return pixel[0] == pixel[1] && pixel[1] == pixel[2];
}

TEST_F(PerceptionPicturesTest, everySoManiethThatSomethingWasDerivedOf) {
  PerceptionPictures pictures(folder_, 2);
  pictures.add(*depthsAt(1), {});
  for (int i = 2; i < 6; ++i) pictures.add(*depthsAt(i), {plane()});
  pictures.add(mrpt::obs::CObservationOdometry(), {plane()});
  EXPECT_EQ(files(), (std::set<std::string>{"kinect_2.000000.png", "kinect_4.000000.png"}));
  EXPECT_EQ(pictures.count(), 2);
}

TEST_F(PerceptionPicturesTest, planesLieWhereTheCameraSeesThem) {
  PerceptionPictures(folder_, 1).add(*depthsAt(1), {plane()});
  const auto image = picture("kinect_1.000000.png");
  ASSERT_EQ(image.getWidth(), 100U);
  ASSERT_EQ(image.getHeight(), 80U);
  for (const unsigned x : {25U, 75U}) EXPECT_TRUE(isNear(image, x, 40, obs::indexColour(0))) << "outline " << x;
  EXPECT_FALSE(isGrey(image, 30, 30)) << "filled";
  EXPECT_TRUE(isGrey(image, 45, 36)) << "in the hole";
  EXPECT_TRUE(isGrey(image, 10, 10)) << "beside it";
}

// Pixels of a row of the legend that have that colour.
int inkIn(const draw::Image& picture, const mrpt::img::TColor& colour) {
  int count = 0;
  for (int y = picture.height - 60; y < picture.height; ++y) {
    for (int x = 0; x < 30; ++x) {
      const draw::Rgb& p = picture.at(x, y);
      count += p.r == colour.R && p.g == colour.G && p.b == colour.B;
    }
  }
  return count;
}

TEST_F(PerceptionPicturesTest, aLegendExplainsTheColoursWhereThereIsRoom) {
  const auto scan = depthsAt(1);
  EXPECT_FALSE(inkIn(drawCameraPicture(*scan, {plane()}), {255, 255, 255})) << "100 px are too few";
  scan->rangeImage_setSize(480, 640);
  scan->rangeImage.fill(2000);
  scan->cameraParams.setIntrinsicParamsFromValues(500, 500, 319.5, 239.5);
  EXPECT_GT(inkIn(drawCameraPicture(*scan, {plane()}), obs::indexColour(0)), 40) << "its swatch";
  EXPECT_EQ(inkIn(drawCameraPicture(*scan, {}), obs::indexColour(0)), 0) << "nothing to explain";
  auto edges = mrpt::obs::CObservationPointCloud::Create();
  edges->sensorLabel = "kinect.edges.occluded";
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(2, 0, 0);
  edges->pointcloud = points;
  EXPECT_GT(inkIn(drawCameraPicture(*scan, {edges}), {230, 0, 0}), 40);
}

TEST_F(PerceptionPicturesTest, aPictureThroughAnotherLensIsNotDrawnOver) {
  const auto scan = depthsAt(1);
  scan->hasIntensityImage = true;
  scan->intensityImage = mrpt::img::CImage(100, 80, mrpt::img::CH_RGB);
  scan->intensityImage.filledRectangle(0, 0, 99, 79, mrpt::img::TColor(200, 0, 0));
  scan->cameraParams.setIntrinsicParamsFromValues(525, 525, 49.5, 39.5);
  scan->cameraParamsIntensity = scan->cameraParams;
  EXPECT_EQ(drawCameraPicture(*scan, {}).at(50, 40).r, 133) << "half of it greyed";
  scan->cameraParamsIntensity.setIntrinsicParamsFromValues(580, 580, 49.5, 39.5);
  EXPECT_EQ(drawCameraPicture(*scan, {}).at(50, 40).g, 240) << "depth, as near as the nearest";
}

TEST_F(PerceptionPicturesTest, objectsHaveTheirBoxAndPoints) {
  auto objects = obs::CObservationObjects::Create();
  obs::ObservedObject object;
  object.sensor_from_box.translation = {2, 0, 0};
  object.box_size = {0.01, 1, 1};
  object.points = {{2, 0, 0}};
  objects->objects = {object};
  PerceptionPictures(folder_, 1).add(*depthsAt(1), {objects});
  const auto image = picture("kinect_1.000000.png");
  EXPECT_TRUE(isNear(image, 25, 40, obs::indexColour(0)));
  EXPECT_FALSE(isGrey(image, 50, 40));
  EXPECT_TRUE(isGrey(image, 40, 40));
}

/// Marker 3, 2 m ahead and 0.2 m to the left of its finder, which is at that pose on the base.
mrpt::obs::CObservationBearingRange::Ptr marker(const mrpt::poses::CPose3D& base_from_finder) {
  auto markers = mrpt::obs::CObservationBearingRange::Create();
  markers->sensorLabel = "kinect.markers";
  markers->sensorLocationOnRobot = base_from_finder;
  auto& measured = markers->sensedData.emplace_back();
  measured.range = static_cast<float>(std::hypot(2, 0.2));
  measured.yaw = static_cast<float>(std::atan2(0.2, 2));
  measured.pitch = 0;
  measured.landmarkID = 3;
  return markers;
}

TEST_F(PerceptionPicturesTest, markersLieInThePictureOfWhateverCamera) {
  const auto scan = depthsAt(1);
  PerceptionPictures pictures(folder_, 1);
  pictures.add(*scan, {marker(scan->sensorPose)});
  const auto of_depth = picture("kinect_1.000000.png");
  EXPECT_TRUE(isNear(of_depth, 39, 39, obs::indexColour(3)));
  EXPECT_TRUE(isGrey(of_depth, 25, 39));
  EXPECT_TRUE(isNear(of_depth, 44, 39, {0, 0, 0})) << "its rim";
  bool has_number = false;
  for (unsigned x = 47; x < 53; ++x) has_number |= isNear(of_depth, x, 39, {20, 20, 20});
  EXPECT_TRUE(has_number);

  // A camera 0.2 m to the left of the finder sees the marker straight ahead.
  mrpt::obs::CObservationImage image;
  image.sensorLabel = "camera";
  image.timestamp = base::stampFromUnix(1);
  image.cameraPose = mrpt::poses::CPose3D(0, 0.2, 0, -1.57079632679, 0, -1.57079632679);
  image.cameraParams = scan->cameraParams;
  image.image = mrpt::img::CImage(100, 80, mrpt::img::CH_GRAY);
  image.image.filledRectangle(0, 0, 99, 79, mrpt::img::TColor(200, 200, 200));
  pictures.add(image, {marker({})});
  EXPECT_TRUE(isNear(picture("camera_1.000000.png"), 49, 39, obs::indexColour(3)));
  EXPECT_TRUE(isGrey(picture("camera_1.000000.png"), 39, 39));

  image.cameraParams = mrpt::img::TCamera();
  image.timestamp = base::stampFromUnix(2);
  pictures.add(image, {marker({})});
  EXPECT_TRUE(isGrey(picture("camera_2.000000.png"), 49, 39))
      << "the view of a camera without calibration is not known";

  image.image = mrpt::img::CImage();
  pictures.add(image, {marker({})});
  EXPECT_EQ(pictures.count(), 3) << "there is nothing to draw over";
}

TEST_F(PerceptionPicturesTest, signsHaveTheirOutlineAndTexts) {
  mrpt::obs::CObservationImage image;
  image.sensorLabel = "camera";
  image.timestamp = base::stampFromUnix(1);
  image.image = mrpt::img::CImage(640, 480, mrpt::img::CH_RGB);
  image.image.filledRectangle(0, 0, 639, 479, mrpt::img::TColor(200, 200, 200));
  auto signs = obs::CObservationDoorSigns::Create();
  const auto add = [&](float left, float top, const std::string& text, double confidence) {
    obs::ObservedDoorSign sign;
    sign.corners_px = {Eigen::Vector2f(left, top), {left + 100, top}, {left + 100, top + 60}, {left, top + 60}};
    sign.texts = {{text, confidence}};
    signs->signs.push_back(sign);
  };
  add(100, 100, "213", 0.98);
  add(400, 100, "2\x1b[31m", 0.4);
  add(1e30f, 100, "far", 1);
  add(std::numeric_limits<float>::quiet_NaN(), 100, "nowhere", 1);
  const auto picture = drawCameraPicture(image, {signs});
  ASSERT_TRUE(picture.has_value());
  const auto isLike = [&](int x, int y, draw::Rgb colour) {
    const auto& pixel = picture->at(x, y);
    return std::abs(pixel.r - colour.r) + std::abs(pixel.g - colour.g) + std::abs(pixel.b - colour.b) < 30;
  };
  EXPECT_TRUE(isLike(150, 100, {20, 160, 40}));
  EXPECT_TRUE(isLike(100, 130, {20, 160, 40}));
  EXPECT_TRUE(isLike(450, 160, {230, 130, 0}));
  EXPECT_TRUE(isLike(150, 130, {200, 200, 200}));
  EXPECT_GT(picture->height, 480) << "the legend";
}

TEST_F(PerceptionPicturesTest, linesLieOverTheScan) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "front/laser";
  scan.timestamp = base::stampFromUnix(1);
  scan.resizeScan(1);
  auto lines = obs::CObservationLaserLines::Create();
  obs::LaserLine line;
  line.segment_in_sensor = {{0.5, -0.5}, {0.5, 0.5}};
  lines->lines = {line};
  PerceptionPictures(folder_, 1).add(scan, {lines});
  const auto image = picture("front_laser_1.000000.png");
  // 2 m are 760 pixels.
  EXPECT_TRUE(isNear(image, 590, 400, obs::indexColour(0)));
  EXPECT_TRUE(isNear(image, 590, 300, obs::indexColour(0)));
  EXPECT_TRUE(isNear(image, 590, 150, mrpt::img::TColor(255, 255, 255)));
}

// Number of coloured lines that a row of the picture crosses; a row that coincides with a line crosses fewer.
int squaresInARow(const draw::Image& picture) {
  int most = 0;
  for (int y = 0; y < picture.height; ++y) {
    int lines = 0;
    for (int x = 1; x < picture.width; ++x) lines += picture.at(x - 1, y).r == 255 && picture.at(x, y).r < 255;
    most = std::max(most, lines);
  }
  return most;
}

TEST_F(PerceptionPicturesTest, rangesBeyondAllMeasureHaveTheirPictureToo) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.maxRange = std::numeric_limits<float>::max();
  scan.resizeScan(2);  // MRPT has no beam angles for a scan with a single beam
  scan.setScanRangeValidity(0, true);
  for (const float range : {150.F, 1e17F, 1e38F}) {
    scan.setScanRange(0, range);
    const int squares = squaresInARow(drawLaserPicture(scan, {}));
    EXPECT_GE(squares, 9) << range;
    EXPECT_LE(squares, 103) << range << ": 101 lines, sensor and point";
  }
}

TEST_F(PerceptionPicturesTest, aFolderThatCannotBeIsAnError) {
  std::ofstream(scratch_ / "file") << "x";
  EXPECT_THROW(PerceptionPictures(scratch_ / "file/pictures", 1), base::Error);
}

}  // namespace
}  // namespace omnimapper::pictures::perception_pictures_test
