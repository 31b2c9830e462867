#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/sim_world/Textures.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "CameraFixture.h"

namespace rgbd_camera_test {
namespace {

using namespace omnimapper;
using Scan = mrpt::obs::CObservation3DRangeScan;
using sim::CameraFixture;

std::shared_ptr<Scan> scanOf(const sim::Measurement& measurement) {
  return std::dynamic_pointer_cast<Scan>(measurement.observation);
}

std::vector<double> depthsOf(const Scan& scan) {
  std::vector<double> depths;
  for (int row = 0; row < scan.rangeImage.rows(); ++row) {
    for (int column = 0; column < scan.rangeImage.cols(); ++column) {
      if (scan.rangeImage(row, column) > 0)
        depths.push_back(scan.rangeImage(row, column) * static_cast<double>(scan.rangeUnits));
    }
  }
  return depths;
}

geometry::Se3 turnedAt(double x, double y, double z, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, z}};
}

// The camera is 1 m up and 0.2 m to the left, and looks to the left; the wall is at y = 3.
TEST(RgbdCamera, mrptProjectsItsPointsOntoTheTrueWall) {
  for (const std::string model : {"ideal", "kinect"}) {
    CameraFixture fixture;
    fixture.addFacing("wall", sim::SurfaceKind::wall, turnedAt(0, 3, 0, M_PI / 2), 20, 20);
    const auto scan = scanOf(
        fixture.make("RgbdCamera\nmodel = " + model + "\nx_m = 0.1\ny_m = 0.2\nz_m = 1\nyaw_deg = 90")->measure(0));
    mrpt::maps::CSimplePointsMap in_base, in_sensor;
    mrpt::obs::T3DPointsProjectionParams params;
    scan->unprojectInto(in_sensor, params);
    params.takeIntoAccountSensorPoseOnRobot = true;
    scan->unprojectInto(in_base, params);
    ASSERT_GT(in_base.size(), 200000u);
    const double bound = model == "ideal" ? 0.001 : 0.08;
    double sum = 0;
    for (std::size_t i = 0; i < in_base.size(); i += 7) {
      float x, y, z;
      in_base.getPoint(i, x, y, z);
      ASSERT_NEAR(y, 3, bound);
      sum += y;
    }
    EXPECT_NEAR(sum / std::ceil(in_base.size() / 7.0), 3, model == "ideal" ? 1e-4 : 0.01);
    float x, y, z;
    in_sensor.getPoint(0, x, y, z);  // the upper left pixel: ahead, to the left, up
    EXPECT_NEAR(x, 2.8, bound);
    EXPECT_GT(y, 0.5);
    EXPECT_GT(z, 0.5);
    EXPECT_TRUE(scan->doDepthAndIntensityCamerasCoincide());
    EXPECT_EQ(scan->cameraParams.fx(), scan->cameraParamsIntensity.fx());
  }
}

TEST(RgbdCamera, noModelReportsDepthsOutOfItsRange) {
  for (const std::string model : {"ideal", "kinect", "stereo"}) {
    CameraFixture fixture;
    fixture.addFacing("near", sim::SurfaceKind::wall, turnedAt(1, 0, 0, 0), 0.2, 4);
    fixture.addFacing("far", sim::SurfaceKind::wall, turnedAt(4, 0, 0, 0), 20, 20);
    const auto depths = [&](const std::string& keys) {
      return depthsOf(*scanOf(fixture.make("RgbdCamera\nmodel = " + model + "\n" + keys)->measure(0)));
    };
    const auto only_near = depths("max_range_m = 3"), only_far = depths("min_range_m = 2");
    for (const double depth : only_near) ASSERT_LE(depth, 3) << model;
    for (const double depth : only_far) ASSERT_GE(depth, 2) << model;
    if (model == "ideal") {
      EXPECT_GT(only_near.size(), 1000U);
      EXPECT_GT(only_far.size(), 1000U);
    }
  }
}

// A board with a vertical edge at y = 0 lies in depth image and picture where each camera sees it.
TEST(RgbdCamera, pictureAndDepthAgreeThroughTheirRelativePose) {
  CameraFixture fixture;
  sim::Material white, black;
  white.colour.setConstant(0.9f);
  black.colour.setConstant(0.02f);
  fixture.addBoard("board", 1.5, 1, 0, 2, 4, white);  // y from 0 to 2, to the left
  fixture.addBoard("wall", 2.5, 0, 0, 20, 20, black);
  const auto scan = scanOf(
      fixture.make("RgbdCamera\nmodel = ideal\nregistered = false\ncolour_right_m = 0.05\nfocal_px = 580")->measure(0));
  EXPECT_FALSE(scan->doDepthAndIntensityCamerasCoincide());
  EXPECT_EQ(scan->cameraParams.fx(), 580);
  EXPECT_EQ(scan->cameraParamsIntensity.fx(), 525);
  // The edge in the optical frame of the colour camera, from the observation alone.
  const mrpt::math::TPoint3D edge = scan->relativePoseIntensityWRTDepth.inverseComposePoint({1.5, 0, 0});
  const double column = scan->cameraParamsIntensity.cx() + 525 * edge.x / edge.z;
  EXPECT_NEAR(column, 319.5 - 525 * 0.05 / 1.5, 1e-6);
  const auto bright = [&](double at) { return scan->intensityImage.getAsFloat(static_cast<unsigned>(at), 240) > 0.5f; };
  EXPECT_TRUE(bright(column - 3));
  EXPECT_FALSE(bright(column + 3));
  EXPECT_NEAR(scan->rangeImage(240, 318) * static_cast<double>(scan->rangeUnits), 1.5, 0.001);
  EXPECT_NEAR(scan->rangeImage(240, 321) * static_cast<double>(scan->rangeUnits), 2.5, 0.001);
}

// f b = 580 * 0.075 = 43.5, in eighths of a pixel 348: the depths are 348 / n. 4 m is 348 / 87, 3 m is 348 / 116, so
// that there are 30 of them from 3 to 4 m.
TEST(RgbdCamera, kinectHasTheDepthsThatEighthsOfAPixelHave) {
  CameraFixture fixture;
  fixture.addFacing("wall", sim::SurfaceKind::wall, turnedAt(3.5, 0, 0, 0.5), 20, 20);
  for (const std::string registered : {"true", "false"}) {
    const auto scan = scanOf(fixture.make("RgbdCamera\ncolour = false\nregistered = " + registered)->measure(0));
    std::set<int> distinct;
    for (const double depth : depthsOf(*scan)) {
      if (depth > 2.9995 && depth < 4.0005) distinct.insert(static_cast<int>(std::lround(1000 * depth)));
      const double n = 348 / depth;
      EXPECT_NEAR(depth, 348 / std::round(n), 0.0006);
    }
    EXPECT_EQ(distinct.size(), 30u);
  }
}

// The standard deviation is z^2 / 43.5 * sqrt(0.06^2 + (1/8)^2 / 12), and somewhat more where the pattern is weak.
TEST(RgbdCamera, kinectNoiseGrowsWithTheSquareOfDepth) {
  for (const double distance : {1.0, 2.0, 3.5}) {
    CameraFixture fixture;
    fixture.addBoard("wall", distance, 0, 0, 20, 20);
    const auto camera = fixture.make("RgbdCamera\ncolour = false\nregistered = false");
    double squares = 0, sum = 0;
    std::size_t count = 0;
    for (int k = 0; k < 4; ++k) {
      for (const double depth : depthsOf(*scanOf(camera->measure(k)))) {
        squares += (depth - distance) * (depth - distance);
        sum += depth - distance;
        ++count;
      }
    }
    const double expected = distance * distance / 43.5 * std::hypot(0.06, 0.125 / std::sqrt(12));
    EXPECT_GT(std::sqrt(squares / count), 0.8 * expected) << distance;
    EXPECT_LT(std::sqrt(squares / count), 1.5 * expected) << distance;
    EXPECT_LT(std::abs(sum / count), 0.7 * distance * distance / 348) << distance;  // within a step
  }
}

TEST(RgbdCamera, nothingComesFromBeyondItsRangesFromDarkAndFromGlass) {
  sim::Material dark, glass;
  dark.infrared = 0.01f;
  glass.transmission = 0.9f;
  const auto share = [](const sim::Material& material, double distance) {
    CameraFixture fixture;
    fixture.addBoard("board", distance, 0, 0, 50, 50, material);
    fixture.addBoard("wall", distance + 1, 0, 0, 50, 50);
    const auto scan = scanOf(fixture.make("RgbdCamera\ncolour = false\nregistered = false")->measure(0));
    return depthsOf(*scan).size() / 307200.0;
  };
  EXPECT_GT(share({}, 1.5), 0.97);
  EXPECT_EQ(share({}, 0.4), 0);
  EXPECT_LT(share({}, 11), 0.01);
  EXPECT_LT(share(dark, 1.5), 0.15);
  EXPECT_LT(share(glass, 1.5), 0.05);
}

// The shadow of a board before a wall agrees in all rows with geometry, up to the errors of the window at its edges.
TEST(RgbdCamera, kinectHasAHoleLeftOfWhatIsNear) {
  CameraFixture fixture;
  fixture.addBoard("board", 0.8, 0, 0, 0.3, 4);
  fixture.addBoard("wall", 2, 0, 0, 9, 9);
  const auto scan = scanOf(fixture.make("RgbdCamera\ncolour = false\nregistered = false")->measure(0));
  double left = 0, right = 0;
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 320; ++column) left += scan->rangeImage(row, column) == 0;
    for (int column = 320; column < 632; ++column) right += scan->rangeImage(row, column) == 0;
  }
  // 43.5 * (1 / 0.8 - 1 / 2) = 32.6 pixels of shadow.
  EXPECT_NEAR(left / 480, 32.6, 5);
  EXPECT_LT(right / 480, 4);
}

TEST(RgbdCamera, stereoNeedsTexture) {
  sim::Material plain, textured;
  textured.colour.setOnes();
  sim::Texture dots{256, 256, std::vector<std::uint8_t>(3 * 256 * 256)};
  sim::Random random(3, {});
  for (auto& value : dots.rgb) value = static_cast<std::uint8_t>(random.integer(0, 255));
  textured.texture = std::make_shared<const sim::Texture>(dots);
  const auto share = [](const sim::Material& material) {
    CameraFixture fixture;
    fixture.addBoard("wall", 2, 0, 0, 9, 9, material);
    return depthsOf(*scanOf(fixture.make("RgbdCamera\nmodel = stereo")->measure(0))).size() / 307200.0;
  };
  EXPECT_LT(share(plain), 0.02);
  EXPECT_GT(share(textured), 0.8);
}

std::string bytesOf(const sim::Measurement& measurement) {
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << *measurement.observation;
  std::string bytes(static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount());
  for (const auto& file : measurement.truth_files) bytes += file.name + file.bytes;
  return bytes + measurement.truth;
}

TEST(RgbdCamera, aFrameHasTheSameBytesInAnyOrderAndOnAnyThread) {
  CameraFixture fixture;
  fixture.map_from_base =
      sim::Track(sim::Track::Kind::motion, {{0, turnedAt(0, 0, 0, -0.2)}, {10, turnedAt(0.5, 0, 0, 0.4)}});
  sim::Material printed;
  printed.texture = sim::makeTexture(sim::TextureKind::print, 3);
  fixture.addBoard("board", 1.2, 0.2, 0, 0.5, 0.5, printed);
  fixture.addBoard("wall", 2.5, 0, 0, 9, 9);
  for (const std::string model : {"kinect", "stereo"}) {
    const std::string ini =
        "RgbdCamera\nwidth_px = 160\nheight_px = 120\nlabels = true\ntrue_depth = true\n"
        "colour_delay_s = 0.02\nmodel = " +
        model;
    const auto camera = fixture.make(ini);
    std::vector<std::string> forward(6), backward(6);
    for (int k = 0; k < 6; ++k) forward[k] = bytesOf(camera->measure(k));
    std::thread other([&] {
      for (int k = 5; k >= 3; --k) backward[k] = bytesOf(camera->measure(k));
    });
    for (int k = 2; k >= 0; --k) backward[k] = bytesOf(camera->measure(k));
    other.join();
    EXPECT_EQ(forward, backward);
    EXPECT_NE(forward[0], forward[1]);
  }
}

TEST(RgbdCamera, truthNamesPosesAndFilesArePixelByPixel) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 9, 9);
  const auto measurement =
      fixture.make("RgbdCamera\nwidth_px = 160\nheight_px = 120\nlabels = true\ntrue_depth = true\nlabel = eye")
          ->measure(12);
  ASSERT_EQ(measurement.truth_files.size(), 2u);
  EXPECT_EQ(measurement.truth_files[0].name, "labels/eye_000012.png");
  EXPECT_EQ(measurement.truth_files[1].name, "depth/eye_000012.png");
  const auto truth = nlohmann::json::parse(measurement.truth);
  EXPECT_DOUBLE_EQ(truth["time_s"], 1.2);
  EXPECT_DOUBLE_EQ(truth["map_from_sensor"][1], -0.025);  // depth is registered to the colour camera on the right
}

void expectRefused(const std::string& ini, const std::string& word) {
  CameraFixture fixture;
  try {
    fixture.make("RgbdCamera\n" + ini);
    FAIL() << ini;
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(RgbdCamera, whatCannotBeIsRefused) {
  expectRefused("focal_px = 0", "focal_px");
  expectRefused("min_range_m = 4\nmax_range_m = 2", "min_range_m");
  expectRefused("max_range_m = 70", "max_range_m");
  expectRefused("width_px = 3", "width_px");
  expectRefused("baseline_m = 0", "baseline_m");
}

}  // namespace
}  // namespace rgbd_camera_test
