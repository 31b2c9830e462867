#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>

#include <functional>

#include "RenderedScan.h"
#include "rgbd/VisualOdometryPlugin.h"

namespace omnimapper::plugins::visual_odometry_plugin_test {
namespace {

using geometry::Se3;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::poses::CPose3D;
using Says = mapper::Evidence::Says;
using Taken = mapper::PosePlugin::Taken;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

const CPose3D kBaseFromCamera(0.1, 0.05, 0.2, 0.1, 0.2, 0);

/// Pose of the base in the room's frame, whose z is forward and y down.
Se3 truth(double seconds) {
  geometry::Vector6d delta;
  delta << 0.15 * std::sin(seconds), 0.1 * (1 - std::cos(seconds)), 0.02 * seconds, 0.05 * std::sin(seconds),
      0.03 * seconds, 0.25 * std::sin(seconds);
  const Se3 room_from_level{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0, 0.1, -0.3}};
  return room_from_level * geometry::plus(Se3{}, delta);
}

class VisualOdometry : public ::testing::Test {
 protected:
  VisualOdometry() {
    matching::RgbdTrackerOptions tracking;
    tracking.depth_readout = tracking.picture_readout = tracking.picture_delay = tracking.picture_delay_sigma = 0;
    plugin_ =
        std::make_unique<VisualOdometryPlugin>(CameraOdometryOptions{}, tracking, matching::DenseMatcherOptions{});
  }

  CObservation3DRangeScan::Ptr scan(double seconds, bool is_covered = false) const {
    return renderedScan(room_, truth(seconds), kBaseFromCamera, at(seconds), is_covered);
  }

  void add(double seconds, bool is_covered = false) {
    EXPECT_EQ(plugin_->add(scan(seconds, is_covered)), Taken::taken);
    plugin_->processUntil(at(seconds));
  }

  /// Errors of the motion of the base [m] [rad].
  void expectMotion(double begin, double end) const {
    const auto motion = plugin_->between(at(begin), at(end));
    ASSERT_TRUE(motion) << begin << " to " << end;
    const auto off = minus(geometry::fromMrpt(motion->begin_from_end), inverse(truth(begin)) * truth(end));
    EXPECT_LT(off.head<3>().norm(), 0.012) << begin << " to " << end;
    EXPECT_LT(off.tail<3>().norm(), 0.008) << begin << " to " << end;
  }

  /// Adds images each 0.1 s up to 2 s, with those from 0.6 to 1 s changed.
  template <class Change>
  void addWith(const Change& change) {
    for (int i = 0; i <= 20; ++i) {
      auto image = scan(0.1 * i);
      if (i >= 6 && i <= 10) change(*image, 0.1 * i);
      plugin_->add(image);
      plugin_->processUntil(at(0.1 * i));
    }
  }

  /// Expects each motion that is measured to be right within four standard deviations.
  void expectHonest(double begin, double end) const {
    const auto motion = plugin_->between(at(begin), at(end));
    if (!motion) return;
    const auto off = minus(geometry::fromMrpt(motion->begin_from_end), inverse(truth(begin)) * truth(end));
    const geometry::Matrix6d covariance = motion->covariance;
    EXPECT_LT(off.dot(covariance.ldlt().solve(off)) / 6, 16) << begin << " to " << end << ": " << off.transpose();
  }

  mapper::Evidence evidence(const std::string& name) const {
    for (const auto& one : plugin_->evidence())
      if (one.name == name) return one;
    return {};
  }

  matching::RenderedRoom room_;
  std::unique_ptr<VisualOdometryPlugin> plugin_;
};

TEST_F(VisualOdometry, MeasuresTheMotionOfTheBaseNotOfTheCamera) {
  for (int i = 0; i <= 20; ++i) add(0.1 * i);
  expectMotion(0, 1);
  expectMotion(0.5, 1.5);
  expectMotion(0, 2);
  EXPECT_EQ(plugin_->coveredUntil(), at(2));
  const auto covariance = plugin_->between(at(0), at(2))->covariance;
  EXPECT_GT(covariance(0, 0), 1e-6);
  EXPECT_LT(covariance(0, 0), 1e-2);
}

TEST_F(VisualOdometry, AcrossACoveredLensTheMotionIsMeasuredWhenTheViewIsFoundAgain) {
  for (int i = 0; i <= 5; ++i) add(0.1 * i);
  for (int i = 6; i <= 9; ++i) add(0.1 * i, true);
  EXPECT_FALSE(plugin_->between(at(0), at(0.9))) << "a loss is reported, not guessed";
  add(1.0);
  expectMotion(0, 1);
  EXPECT_EQ(evidence("camera_found_again").says, Says::too_little);
  EXPECT_EQ(evidence("camera_lost_percent").says, Says::too_little);
  EXPECT_EQ(evidence("camera_begun_anew").value, 0);
}

TEST_F(VisualOdometry, AfterALongLossTheMapIsSuspicious) {
  add(0);
  add(0.1);
  for (int i = 2; i <= 22; ++i) add(0.1 * i, true);
  room_.half[0] = 3;  // another room
  room_.half[2] = 2.5;
  add(2.5);
  add(2.6);
  EXPECT_FALSE(plugin_->between(at(0.1), at(2.5)));
  expectMotion(2.5, 2.6);
  EXPECT_EQ(evidence("camera_begun_anew").says, Says::against_it);
}

// The base drives along a bare wall, whose depths do not determine that motion.
TEST_F(VisualOdometry, WheelsMeasureWhatABareWallLeavesUnconstrained) {
  room_.half[0] = 50;
  room_.half[1] = 50;
  const auto wallOnly = [&](double seconds) {
    const Se3 moved{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0.4 * seconds, 0.1, -0.3}};
    auto image = renderedScan(room_, moved, CPose3D(), at(seconds), false);
    image->hasIntensityImage = false;
    return image;
  };
  for (int i = 0; i <= 30; ++i) {
    const double seconds = 0.1 * i;
    const auto wheels = mrpt::obs::CObservationOdometry::Create();
    wheels->timestamp = at(seconds);
    wheels->sensorLabel = "wheels";
    wheels->odometry = mrpt::poses::CPose2D(0, -0.4 * seconds, 0);  // to the right, where the room's x is
    EXPECT_EQ(plugin_->add(wheels), Taken::not_mine) << "others may take them, too";
    plugin_->add(wallOnly(seconds));
    plugin_->processUntil(at(seconds));
  }
  const auto motion = plugin_->between(at(0), at(3));
  ASSERT_TRUE(motion) << "longer than a camera is trusted without wheels";
  EXPECT_NEAR(motion->begin_from_end.y(), -1.2, 0.02);
  EXPECT_GT(std::sqrt(motion->covariance(1, 1)), 0.03) << "as the wheels measured it";
  EXPECT_EQ(evidence("camera_blind_percent").says, Says::good);
}

TEST_F(VisualOdometry, LossesAreReportedWithWheelsToo) {
  for (int i = 0; i <= 10; ++i) {
    const auto wheels = mrpt::obs::CObservationOdometry::Create();
    wheels->timestamp = at(0.1 * i);
    plugin_->add(wheels);
    add(0.1 * i, i >= 2);
  }
  EXPECT_EQ(evidence("camera_lost_percent").says, Says::too_little);
}

TEST_F(VisualOdometry, ASpinThatIsTooFastIsReportedNotGuessed) {
  add(0);
  add(0.1);
  const auto spun = [&](double seconds) {  // by 115 deg from image to image
    geometry::Vector6d turn = geometry::Vector6d::Zero();
    turn[5] = 20 * (seconds - 0.1);
    return renderedScan(room_, geometry::plus(truth(0.1), turn), kBaseFromCamera, at(seconds), false);
  };
  for (int i = 2; i <= 8; ++i) {
    plugin_->add(spun(0.1 * i));
    plugin_->processUntil(at(0.1 * i));
  }
  EXPECT_FALSE(plugin_->between(at(0.1), at(0.7)));
  EXPECT_EQ(evidence("camera_lost_percent").says, Says::too_little);
}

TEST_F(VisualOdometry, ACoveredLensAtTheStartIsNoGap) {
  add(0, true);
  add(0.1);
  add(0.2);
  expectMotion(0.1, 0.2);
  EXPECT_EQ(evidence("camera_begun_anew").value, 0);
}

TEST_F(VisualOdometry, OfOtherCamerasAndLateImagesNothingIsTaken) {
  add(0);
  add(0.2);
  auto other = scan(0.3);
  other->sensorLabel = "other";
  EXPECT_EQ(plugin_->add(other), Taken::not_mine);
  EXPECT_EQ(plugin_->add(scan(0.1)), Taken::taken) << "left out because a later one was processed";
  plugin_->processUntil(at(0.2));
  expectMotion(0, 0.2);
}

TEST_F(VisualOdometry, ACameraWithoutCalibrationIsAWarning) {
  auto image = scan(0);
  image->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_EQ(plugin_->add(image), Taken::taken);
  plugin_->processUntil(at(0));
  ASSERT_EQ(plugin_->warnings().size(), 1U);
  EXPECT_NE(plugin_->warnings()[0].find("camera"), std::string::npos);
  EXPECT_TRUE(plugin_->evidence().empty());
}

void paint(CObservation3DRangeScan& scan, const std::function<double(int x, int y)>& brightness) {
  for (unsigned y = 0; y < scan.intensityImage.getHeight(); ++y) {
    for (unsigned x = 0; x < scan.intensityImage.getWidth(); ++x)
      *scan.intensityImage.ptr<std::uint8_t>(x, y) =
          static_cast<std::uint8_t>(brightness(static_cast<int>(x), static_cast<int>(y)));
  }
}

TEST_F(VisualOdometry, WithTheLightsOffItIsNotWrong) {
  addWith([](auto& scan, double) { paint(scan, [](int, int) { return 0; }); });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
}

TEST_F(VisualOdometry, WithoutDepthsItIsNotWrong) {
  addWith([](auto& scan, double) { scan.rangeImage.setZero(); });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
}

TEST_F(VisualOdometry, WithoutAPictureItIsNotWrong) {
  addWith([](auto& scan, double) { scan.hasIntensityImage = false; });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
}

TEST_F(VisualOdometry, SomebodyWhoFillsTheViewIsNotFollowed) {
  addWith([](auto& scan, double seconds) {
    scan.rangeImage.setConstant(6000);  // 0.6 m away, walking by at 0.5 m/s
    paint(scan, [&](int x, int y) { return 128 + 60 * std::sin(0.1 * x - 22 * seconds) + 40 * std::sin(0.15 * y); });
  });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
  EXPECT_GT(evidence("camera_lost_percent").value, 10);
}

TEST_F(VisualOdometry, ImagesOfAnotherSizeAreTrackedOrRefused) {
  matching::RenderedRoom half = room_;
  half.width /= 2;
  half.height /= 2;
  half.camera = {130, 130, 79.5, 59.5};
  addWith(
      [&](auto& scan, double seconds) { scan = *renderedScan(half, truth(seconds), kBaseFromCamera, at(seconds)); });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
}

TEST_F(VisualOdometry, WithAPictureOfSixteenBitsItIsNotWrong) {
  addWith([](auto& scan, double) {
    scan.intensityImage.resize(scan.rangeImage.cols(), scan.rangeImage.rows(), mrpt::img::CH_GRAY,
                               mrpt::img::PixelDepth::D16U);
  });
  for (const double end : {0.8, 1.0, 1.2, 2.0}) expectHonest(0.5, end);
  expectMotion(1.4, 2);
}

TEST_F(VisualOdometry, AcrossTwoSecondsWithoutImagesItIsNotWrong) {
  for (const double seconds : {0.0, 0.1, 0.2, 0.3, 2.3, 2.4, 2.5}) add(seconds);
  expectHonest(0.3, 2.3);
  expectMotion(2.3, 2.5);
}

TEST_F(VisualOdometry, AcrossASecondWithoutImagesItIsNotWrong) {
  for (const double seconds : {0.0, 0.1, 0.2, 0.3, 1.5, 1.6, 1.7}) add(seconds);
  expectHonest(0.3, 1.5);
  expectMotion(1.5, 1.7);
}

/// The images as a lens with that radial distortion shows them.
void bend(CObservation3DRangeScan& scan, double k1) {
  auto& camera = scan.cameraParams;
  const auto depths = scan.rangeImage;
  const auto picture = scan.intensityImage.makeDeepCopy();
  for (int y = 0; y < depths.rows(); ++y) {
    for (int x = 0; x < depths.cols(); ++x) {
      // The ray whose distorted image is this pixel.
      const double u = (x - camera.cx()) / camera.fx(), v = (y - camera.cy()) / camera.fy();
      double stretch = 1;
      for (int i = 0; i < 30; ++i) stretch = 1 / (1 + k1 * (u * u + v * v) * stretch * stretch);
      const long column = std::lround(camera.fx() * u * stretch + camera.cx());
      const long row = std::lround(camera.fy() * v * stretch + camera.cy());
      const bool is_inside = column >= 0 && row >= 0 && column < depths.cols() && row < depths.rows();
      scan.rangeImage(y, x) = is_inside ? depths(row, column) : std::uint16_t{0};
      *scan.intensityImage.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y)) =
          is_inside ? *picture.ptr<std::uint8_t>(static_cast<unsigned>(column), static_cast<unsigned>(row))
                    : std::uint8_t{0};
    }
  }
  for (auto* one : {&scan.cameraParams, &scan.cameraParamsIntensity}) {
    one->distortion = mrpt::img::DistortionModel::plumb_bob;
    one->dist[0] = k1;
  }
}

TEST_F(VisualOdometry, LensDistortionIsCorrected) {
  for (int i = 0; i <= 20; ++i) {
    auto image = scan(0.1 * i);
    bend(*image, -0.25);  // 12 px in the corners
    plugin_->add(image);
    plugin_->processUntil(at(0.1 * i));
  }
  expectMotion(0, 1);
  expectMotion(0, 2);
  EXPECT_TRUE(plugin_->warnings().empty());
}

TEST_F(VisualOdometry, AnImageBeforeTheWheelsNextReadingIsPredictedToo) {
  room_.half[0] = room_.half[1] = 50;
  const auto wheels = [&](double seconds) {
    const auto reading = mrpt::obs::CObservationOdometry::Create();
    reading->timestamp = at(seconds);
    reading->odometry = mrpt::poses::CPose2D(0, -0.4 * seconds, 0);
    plugin_->add(reading);
  };
  for (int i = 0; i <= 30; ++i) {
    const double seconds = 0.1 * i;
    const Se3 moved{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0.4 * seconds, 0.1, -0.3}};
    auto image = renderedScan(room_, moved, CPose3D(), at(seconds), false);
    image->hasIntensityImage = false;
    plugin_->add(image);
    plugin_->processUntil(at(seconds));
    wheels(seconds + 0.05);
  }
  const auto motion = plugin_->between(at(0.3), at(3));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.y(), -1.08, 0.02);
}

TEST_F(VisualOdometry, ALongLossIsBridgedByTheWheelsOnTheirCurve) {
  const auto room = room_;
  auto other = room_;
  other.half[0] = 3;  // another room, so that no view is found again
  other.half[2] = 2.5;
  for (int i = 0; i <= 27; ++i) {
    const double seconds = 0.1 * i;
    const auto wheels = mrpt::obs::CObservationOdometry::Create();
    wheels->timestamp = at(seconds);
    wheels->odometry = mrpt::poses::CPose2D(0.3 * std::sin(seconds), 0.3 * (1 - std::cos(seconds)), seconds);
    plugin_->add(wheels);
    room_ = i <= 1 ? room : other;
    add(seconds, i > 1 && i < 25);
  }
  EXPECT_EQ(evidence("camera_begun_anew").value, 0) << "the wheels measure the motion meanwhile";
  const auto motion = plugin_->between(at(0.1), at(1.1));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.yaw(), 1, 1e-6);
  EXPECT_NEAR(motion->begin_from_end.x(), 0.3 * std::sin(1.0), 1e-3) << "on its curve, not straight on";
}

TEST_F(VisualOdometry, AcrossLostImagesTheBaseMovesAsTheWheelsMeasure) {
  // The base turns, stands still while the lens is covered, and turns on.
  const auto yaw = [](double seconds) { return 0.5 * (std::min(seconds, 0.4) + std::max(seconds - 0.9, 0.0)); };
  const auto pose = [&](double seconds) { return geometry::lift({0, 0, yaw(seconds)}); };
  for (int i = 0; i <= 14; ++i) {
    const double seconds = 0.1 * i;
    const auto wheels = mrpt::obs::CObservationOdometry::Create();
    wheels->timestamp = at(seconds);
    wheels->odometry = mrpt::poses::CPose2D(0, 0, 0.9 * yaw(seconds));  // they slip
    plugin_->add(wheels);
    plugin_->add(renderedScan(room_, truth(0) * pose(seconds), kBaseFromCamera, at(seconds), i >= 3 && i <= 10));
    plugin_->processUntil(at(seconds));
  }
  for (const double seconds : {0.2, 0.4, 0.6, 0.8, 1.0, 1.2}) {
    const auto motion = plugin_->between(at(0), at(seconds));
    ASSERT_TRUE(motion) << seconds;
    EXPECT_NEAR(motion->begin_from_end.yaw(), yaw(seconds), 0.015) << seconds;
  }
}

// The base turns far and moves while the lens is covered: the gyroscope measures only the turn.
TEST_F(VisualOdometry, AcrossLostImagesAGyroscopeShapesTheTurnAndThePathIsStraight) {
  const auto pose = [&](double seconds) {
    const double covered = std::clamp(seconds - 0.3, 0.0, 0.8);
    const double there = covered < 0.4 ? 4 * covered : 4 * (0.8 - covered);  // 92 deg, and back
    return geometry::lift({0.1 * covered, 0, there});
  };
  for (int i = 0; i <= 140; ++i) {
    const double seconds = 0.01 * i;
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->timestamp = at(seconds);
    const double rate = seconds < 0.3 || seconds >= 1.1 ? 0 : seconds < 0.7 ? 4 : -4;
    imu->set(mrpt::obs::IMU_WX, 0);
    imu->set(mrpt::obs::IMU_WY, 0);
    imu->set(mrpt::obs::IMU_WZ, rate);
    plugin_->add(imu);
    if (i % 10 != 0) continue;
    plugin_->add(renderedScan(room_, truth(0) * pose(seconds), kBaseFromCamera, at(seconds), i >= 40 && i <= 100));
    plugin_->processUntil(at(seconds));
  }
  for (const double seconds : {0.5, 0.7, 0.9, 1.1}) {
    const auto motion = plugin_->between(at(0), at(seconds));
    ASSERT_TRUE(motion) << seconds;
    const auto off = minus(geometry::fromMrpt(motion->begin_from_end), pose(seconds));
    EXPECT_LT(off.head<3>().norm(), 0.03) << seconds;
    EXPECT_LT(off.tail<3>().norm(), 0.05) << seconds;
  }
}

// The base turns about the normal of a bare wall, whose depths do not determine that motion.
TEST_F(VisualOdometry, AGyroscopeMeasuresTheTurnThatABareWallLeavesUnconstrained) {
  room_.half[0] = 50;
  room_.half[1] = 50;
  const CPose3D base_from_imu(0, 0, 0, 0, 0, geometry::kPi);
  for (int i = 0; i <= 100; ++i) {
    const double seconds = 0.01 * i;
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->timestamp = at(seconds);
    imu->sensorPose = base_from_imu;
    imu->set(mrpt::obs::IMU_WX, 0.4);
    imu->set(mrpt::obs::IMU_WY, 0);
    imu->set(mrpt::obs::IMU_WZ, 0);
    EXPECT_EQ(plugin_->add(imu), Taken::not_mine) << "others may take it, too";
    if (i % 10 != 0) continue;
    geometry::Vector6d rolled = geometry::Vector6d::Zero();
    rolled[3] = 0.4 * seconds;
    const Se3 level{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0, 0.1, -0.3}};
    auto image = renderedScan(room_, geometry::plus(level, rolled), CPose3D(), at(seconds), false);
    image->hasIntensityImage = false;
    plugin_->add(image);
    plugin_->processUntil(at(seconds));
  }
  const auto motion = plugin_->between(at(0), at(1));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.roll(), 0.4, 0.02);
  EXPECT_LT(std::sqrt(motion->covariance(3, 3)), 0.05) << "as the gyroscope measured it";
  EXPECT_GT(std::sqrt(motion->covariance(1, 1)), 0.3) << "along the wall nothing measures it";
}

TEST_F(VisualOdometry, sharesTheImageThatItProcessedLastWithPerception) {
  const auto first = scan(0), second = scan(0.1);
  for (const auto& one : {first, second}) plugin_->add(one);
  plugin_->processUntil(at(0));
  perception::Blackboard of_first, of_second;
  plugin_->share(*first, of_first);
  plugin_->share(*second, of_second);
  ASSERT_NE(of_first.find<StraightImage>(), nullptr);
  EXPECT_TRUE(of_first.find<StraightImage>()->isOf(*first));
  EXPECT_EQ(of_first.find<camera::RgbdView>().get(), &of_first.find<StraightImage>()->view());
  EXPECT_EQ(of_second.find<StraightImage>(), nullptr) << "not processed yet";
  plugin_->processUntil(at(0.1));
  plugin_->share(*second, of_second);
  EXPECT_TRUE(of_second.find<StraightImage>()->isOf(*second));
  EXPECT_TRUE(of_first.find<StraightImage>()->isOf(*first)) << "still there";
}

TEST_F(VisualOdometry, sharesNoDecodedImagesOfAnotherLens) {
  const auto bent = scan(0);
  for (auto* camera : {&bent->cameraParams, &bent->cameraParamsIntensity}) {
    camera->distortion = mrpt::img::DistortionModel::plumb_bob;
    camera->k1(-0.3);
  }
  plugin_->add(bent);
  plugin_->processUntil(at(0));
  perception::Blackboard board;
  plugin_->share(*bent, board);
  EXPECT_NE(board.find<StraightImage>(), nullptr);
  EXPECT_EQ(board.find<camera::RgbdView>(), nullptr) << "extractors see the image as it came";
}

}  // namespace
}  // namespace omnimapper::plugins::visual_odometry_plugin_test
