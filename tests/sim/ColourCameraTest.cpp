#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim_world/MarkerMaking.h>
#include <omnimapper/sim_world/Textures.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/aruco.hpp>

#include "CameraFixture.h"

namespace colour_camera_test {
namespace {

using namespace omnimapper;
using sim::CameraFixture;

std::shared_ptr<mrpt::obs::CObservationImage> pictureOf(const sim::Measurement& measurement) {
  return std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(measurement.observation);
}

double brightness(const mrpt::img::CImage& image, int column, int row) {
  return image.getAsFloat(column, row);
}

// Mean squared difference of pixels at this distance.
double contrast(const mrpt::img::CImage& image, int dx, int dy) {
  double sum = 0;
  int count = 0;
  for (int row = 10; row + 10 < static_cast<int>(image.getHeight()); row += 3) {
    for (int column = 10; column + 10 < static_cast<int>(image.getWidth()); column += 3) {
      const double difference = brightness(image, column + dx, row + dy) - brightness(image, column, row);
      sum += difference * difference;
      ++count;
    }
  }
  return sum / count;
}

sim::Material checked() {
  sim::Material material;
  material.colour.setOnes();
  material.texture = sim::makeTexture(sim::TextureKind::checker, 1);
  return material;
}

// A marker 2 m ahead and 2 m to the left: with the pan at 45 degrees it is in the middle.
TEST(ColourCamera, thePanTiltAimsAndMarkersHaveTheirTrueCorners) {
  CameraFixture fixture;
  sim::Material white, black;
  white.colour.setConstant(0.9f);
  black.colour.setConstant(0.02f);
  const geometry::Se3 aside{Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitZ())), {2, 2, 1}};
  // The marker's frame: x to the reader's right, y up, z to the reader. The board faces -x of its own frame.
  Eigen::Matrix3d axes;
  axes << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  const geometry::Se3 map_from_marker = aside * geometry::Se3{Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()};
  sim::MeshBuilder marker("marker", sim::Track(map_from_marker));
  marker.addPlane("", sim::SurfaceKind::marker, black,
                  {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}});
  fixture.world.bodies.push_back(marker.build());
  fixture.addFacing("wall", sim::SurfaceKind::wall, aside * geometry::Se3{Eigen::Quaterniond::Identity(), {0.5, 0, 0}},
                    9, 9, white);
  fixture.world.markers.push_back({"marker", 17, 0.2});
  const auto measurement = fixture.make("ColourCamera\nz_m = 1\npan_deg = 45\nfocal_px = 600")->measure(0);
  const auto picture = pictureOf(measurement);
  const auto truth = nlohmann::json::parse(measurement.truth);
  ASSERT_EQ(truth["markers"].size(), 1u);
  const auto& seen = truth["markers"][0];
  EXPECT_EQ(seen["id"], 17);
  EXPECT_EQ(seen["visible"], 1.0);
  EXPECT_NEAR(seen["distance_m"], std::sqrt(8), 1e-9);
  EXPECT_NEAR(seen["incidence_deg"], 0, 1e-5);
  // 0.1 m at sqrt(8) m and a focal length of 600: 21.2132 pixels to either side; upper left first, clockwise.
  const double half = 600 * 0.1 / std::sqrt(8);
  const double corners[4][2] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(seen["corners"][i][0], 319.5 + corners[i][0], 1e-6) << i;
    EXPECT_NEAR(seen["corners"][i][1], 239.5 + corners[i][1], 1e-6) << i;
  }
  EXPECT_LT(brightness(picture->image, 320, 240), 0.3);
  EXPECT_LT(brightness(picture->image, 320 + 18, 240 - 18), 0.3);
  EXPECT_GT(brightness(picture->image, 320 + 25, 240), 0.6);
  EXPECT_GT(brightness(picture->image, 320, 240 + 25), 0.6);
  // The pose that MRPT gets looks along z: the marker lies straight ahead.
  const auto ahead = picture->cameraPose.inverseComposePoint({2, 2, 1});
  EXPECT_NEAR(ahead.x, 0, 1e-9);
  EXPECT_NEAR(ahead.y, 0, 1e-9);
  EXPECT_NEAR(ahead.z, std::sqrt(8), 1e-9);
}

// Markers at three slants before a wall, found by OpenCV in the finished picture with noise and blur of the lens.
TEST(ColourCamera, opencvFindsMarkersWhereTruthHasThem) {
  CameraFixture fixture;
  Eigen::Matrix3d axes;
  axes << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  for (int i = 0; i < 3; ++i) {
    sim::MarkerSpec spec;
    spec.name = "marker_" + std::to_string(i);
    spec.id = 10 + i;
    const Eigen::AngleAxisd slant(0.35 * (i - 1), Eigen::Vector3d(0.2, 0.3, 1).normalized());
    spec.map_from_marker = {Eigen::Quaterniond(slant * Eigen::Quaterniond(axes)),
                            {2.0 + 0.4 * i, 0.6 * (i - 1), 0.1 * i}};
    const sim::MadeMarker made = sim::makeMarker(spec);
    fixture.world.bodies.push_back(made.body);
    fixture.world.markers.push_back(made.marker);
  }
  fixture.addBoard("wall", 4, 0, 0, 20, 20);
  const auto measurement = fixture.make("ColourCamera")->measure(0);
  const auto truth = nlohmann::json::parse(measurement.truth);
  ASSERT_EQ(truth["markers"].size(), 3u);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  parameters->cornerRefinementWinSize = 3;
  cv::aruco::detectMarkers(pictureOf(measurement)->image.asCvMatRef(),
                           cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50), corners, ids, parameters);
  ASSERT_EQ(ids.size(), 3u);
  for (const auto& seen : truth["markers"]) {
    const auto at = std::find(ids.begin(), ids.end(), seen["id"].get<int>()) - ids.begin();
    ASSERT_LT(at, 3);
    // White spreads into the black square, in the lens and by the sRGB curve, so each corner is found a little inside.
    double mean_x = 0, mean_y = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const double dx = corners[at][corner].x - seen["corners"][corner][0].get<double>(),
                   dy = corners[at][corner].y - seen["corners"][corner][1].get<double>();
      EXPECT_LT(std::hypot(dx, dy), 1.2);
      mean_x += dx / 4;
      mean_y += dy / 4;
    }
    EXPECT_NEAR(mean_x, 0, 0.25);
    EXPECT_NEAR(mean_y, 0, 0.25);
  }
}

TEST(ColourCamera, signsReportTheirTextAndWhatHidesThem) {
  CameraFixture fixture;
  Eigen::Matrix3d axes;
  axes << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  const geometry::Se3 map_from_sign{Eigen::Quaterniond(axes), {3, 0, 0}};
  sim::MeshBuilder body("sign", sim::Track(map_from_sign));
  body.addPlane("", sim::SurfaceKind::sign, {}, {{-0.2, -0.1, 0}, {0.2, -0.1, 0}, {0.2, 0.1, 0}, {-0.2, 0.1, 0}});
  fixture.world.bodies.push_back(body.build());
  fixture.world.signs.push_back({"sign", {"R 118", "Workshop"}, "workshop", map_from_sign, 0.4, 0.2, {0.06, 0.02}});
  fixture.addBoard("post", 1.5, 0.1, 0, 0.2, 4);  // hides y from 0 to 0.4 m of what is at 3 m: the left half
  const auto truth = nlohmann::json::parse(fixture.make("ColourCamera")->measure(0).truth);
  ASSERT_EQ(truth["signs"].size(), 1u);
  EXPECT_EQ(truth["signs"][0]["lines"], (std::vector<std::string>{"R 118", "Workshop"}));
  EXPECT_EQ(truth["signs"][0]["room"], "workshop");
  EXPECT_NEAR(truth["signs"][0]["capitals_px"], 600 * 0.06 / 3, 1e-9);
  EXPECT_NEAR(truth["signs"][0]["least_capitals_px"], 600 * 0.02 / 3, 1e-9);
  EXPECT_NEAR(truth["signs"][0]["visible"], 0.4, 0.11);
  const auto behind = nlohmann::json::parse(fixture.make("ColourCamera\npan_deg = 180")->measure(0).truth);
  EXPECT_TRUE(behind["signs"].empty());
}

// The view follows from the camera's true pose, without a picture; the noise of the reported angles is not in it.
TEST(ColourCamera, theViewOfAPictureIsTheTruthOfIt) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 9, 9);
  const auto camera = fixture.make(
      "ColourCamera\nwidth_px = 160\nheight_px = 120\nz_m = 1\npan_sweep_deg = 40\npan_period_s = 4\n"
      "pan_sigma_deg = 5\nrate_hz = 3");
  for (int k = 0; k < 12; ++k) {
    const auto truth = nlohmann::json::parse(camera->measure(k).truth);
    const sim::CameraView view = *camera->pictureView(k);
    EXPECT_NEAR(truth["time_s"], view.time, 1e-12);
    EXPECT_EQ(view.camera.width, 160);
    const Eigen::Vector3d ahead = view.map_from_optical.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()) * 180 / M_PI, truth["pan_deg"], 1e-9);
    EXPECT_NEAR(view.map_from_optical.translation.z(), truth["map_from_camera"][2], 1e-12);
  }
}

TEST(ColourCamera, sweepsAndReportsItsAnglesWithNoiseAndBias) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 9, 9);
  const auto camera = fixture.make(
      "ColourCamera\nwidth_px = 16\nheight_px = 16\npan_sweep_deg = 40\npan_period_s = 4\npan_sigma_deg = 1\n"
      "pan_bias_deg = 2\nrate_hz = 50");
  double sum = 0, squares = 0;
  for (int k = 0; k < camera->count(); ++k) {
    const auto measurement = camera->measure(k);
    const auto truth = nlohmann::json::parse(measurement.truth);
    EXPECT_NEAR(truth["pan_deg"], 40 * std::sin(2 * M_PI * camera->timeOf(k) / 4), 1e-9);
    // The reported direction of the camera in the base.
    const auto ahead = pictureOf(measurement)->cameraPose.composePoint({0, 0, 1});
    const double error = std::atan2(ahead.y, ahead.x) * 180 / M_PI - truth["pan_deg"].get<double>();
    sum += error;
    squares += error * error;
  }
  const double mean = sum / camera->count();
  EXPECT_NEAR(mean, 2, 0.2);
  EXPECT_NEAR(std::sqrt(squares / camera->count() - mean * mean), 1, 0.15);
}

// Turning at 60 deg/s for 20 ms is 1.2 degrees, 12.6 pixels at a focal length of 600.
TEST(ColourCamera, turningBlursAcrossAndNotDown) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 1.2, 1.2, checked());
  fixture.map_from_base = sim::Track(
      sim::Track::Kind::motion,
      {{0, geometry::Se3{}},
       {2, geometry::Se3{Eigen::Quaterniond(Eigen::AngleAxisd(2 * M_PI / 3, Eigen::Vector3d::UnitZ())), {0, 0, 0}}}});
  const std::string ini = "ColourCamera\nnoise = 0\nfirst_s = 0.1\nexposure_s = ";
  const auto sharp = pictureOf(fixture.make(ini + "0")->measure(0)),
             blurred = pictureOf(fixture.make(ini + "0.02")->measure(0));
  EXPECT_GT(contrast(sharp->image, 4, 0), 1.6 * contrast(blurred->image, 4, 0));
  EXPECT_GT(contrast(blurred->image, 0, 4), 0.75 * contrast(sharp->image, 0, 4));
}

TEST(ColourCamera, gainBrightensCornersDarkenNoiseIsAsSet) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 20, 20);
  const auto image = [&](const std::string& ini) {
    return pictureOf(fixture.make("ColourCamera\n" + ini)->measure(0))->image;
  };
  const auto dim = image("gain = 0.5\nnoise = 0"), bright = image("gain = 1\nnoise = 0"),
             open = image("vignetting = 0");
  EXPECT_GT(brightness(bright, 320, 240), brightness(dim, 320, 240) + 0.1);
  EXPECT_LT(brightness(bright, 1, 1), brightness(bright, 320, 240) - 0.03);
  EXPECT_LT(contrast(bright, 1, 0), 1e-5);
  EXPECT_GT(contrast(open, 1, 0), 3e-5);
}

}  // namespace
}  // namespace colour_camera_test
