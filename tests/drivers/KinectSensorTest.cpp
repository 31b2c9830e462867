#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/drivers/KinectCalibration.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/SensorDriver.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "../live/Observations.h"
#include "PlayedScans.h"

/// Tests of the Kinect's driver with libfreenect's fakenect, which plays a log.
namespace omnimapper::drivers::kinect_sensor_test {
namespace {

using namespace live;

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationIMU;

const std::string kFakenect = OMNIMAPPER_FAKENECT_FOLDER;  // with the libfreenect.so of fakenect
const std::string kSection = "[live]\nsensors = kinect\n[kinect]\ndriver = KinectSensor\nsensorLabel = KINECT\n";

CObservationIMU accelerationAt(double seconds, double forward, double left, double up) {
  CObservationIMU imu;
  imu.timestamp = live::observations::at(seconds);
  imu.sensorLabel = "imu";
  imu.set(mrpt::obs::IMU_X_ACC, forward);
  imu.set(mrpt::obs::IMU_Y_ACC, left);
  imu.set(mrpt::obs::IMU_Z_ACC, up);
  return imu;
}

class KinectSensorTest : public ::testing::Test {
 protected:
  // A camera falls silent and comes back while the other tests run, because most of this is waiting.
  static void SetUpTestSuite() {
    if (!std::filesystem::exists(kFakenect + "/libfreenect.so.0.5")) return;
    folder_of_silent = std::make_unique<testing::ScratchFolder>();
    const auto images = range_scans::flat(1);
    images[0]->hasIntensityImage = false;
    makeSession(*folder_of_silent, [&](source::RawlogWriter& log) {
      // A third of a second with depths, 0.8 s without, and a third with depths again. The session pauses while it is
      // closed.
      for (int i = 0; i < 30; ++i) {
        log.add(accelerationAt(0.05 * i, 0, 0, 9.8));
        if (i >= 7 && i < 23) continue;
        auto scan = *images[0];
        scan.timestamp = live::observations::at(0.05 * i);
        log.add(scan);
      }
    });
    silent =
        std::make_unique<testing::Program>(recording(*folder_of_silent, "grab_image = false\nsilence_s = 0.4\n", 1000));
  }
  static void TearDownTestSuite() {
    silent.reset();
    folder_of_silent.reset();
  }
  void SetUp() override {
    if (!folder_of_silent)
      GTEST_SKIP() << "this was built without libfreenect (Debian's libfreenect-dev), or its fakenect is missing";
  }

  static void makeSession(const testing::ScratchFolder& folder, const std::string& log) {
    const auto ended = testing::runProgram({testing::ownProgram("fakenect-session"), log, folder / "session"});
    ASSERT_EQ(ended.code, 0) << testing::toString(ended);
  }
  static void makeSession(const testing::ScratchFolder& folder,
                          const std::function<void(source::RawlogWriter&)>& fill) {
    source::writeRawlog(folder / "played.rawlog", fill);
    makeSession(folder, folder / "played.rawlog");
  }

  // The command that reads the Kinect until `count` observations have come, or the session ends.
  static std::vector<std::string> recording(const testing::ScratchFolder& folder, const std::string& keys, int count) {
    std::ofstream(folder / "live.ini") << kSection << keys;
    // fakenect searches for the end of a line in bytes without a terminating zero.
    return {"env",
            "ASAN_OPTIONS=strict_string_checks=0",
            "LD_LIBRARY_PATH=" + kFakenect,
            "FAKENECT_PATH=" + folder / "session",
            testing::ownProgram("live-record"),
            folder / "live.ini",
            folder / "out",
            "60",
            std::to_string(count),
            "is gone"};
  }
  testing::Ended record(const std::string& keys, int count) {
    return testing::runProgram(recording(folder, keys, count));
  }

  static void expectSameDepths(const CObservation3DRangeScan& seen, const CObservation3DRangeScan& played) {
    const KinectCalibration calibration;
    const double unit = static_cast<double>(played.rangeUnits), seen_unit = static_cast<double>(seen.rangeUnits);
    ASSERT_EQ(seen.rangeImage.size(), 640 * 480);
    std::size_t count = 0;
    for (int i = 0; i < 640 * 480; ++i) {
      const double depth = played.rangeImage.data()[i] * unit, got = seen.rangeImage.data()[i] * seen_unit;
      const double quantized = calibration.depthOf(calibration.rawOf(depth));
      const double tolerance = 0.55 * 0.0030711016 * depth * depth + 1.01e-4;
      // An EXPECT_NEAR for each pixel would take most of the test's time.
      if (std::abs(got - quantized) > 1.01e-4 || (quantized > 0 && std::abs(got - depth) > tolerance))
        FAIL() << got << " m for " << depth << " m at column " << i % 640 << ", row " << i / 640;
      if (quantized > 0) ++count;
    }
    EXPECT_GT(count, 10000u) << "pixels with depths";
  }

  testing::ScratchFolder folder;
  static inline std::unique_ptr<testing::ScratchFolder> folder_of_silent;
  static inline std::unique_ptr<testing::Program> silent;
};

TEST_F(KinectSensorTest, whatIsPlayedArrivesToTheQuantization) {
  const auto played = range_scans::simulated(6);
  makeSession(folder, [&](source::RawlogWriter& log) {
    for (std::size_t i = 0; i < played.size(); ++i) {
      log.add(accelerationAt(0.1 * static_cast<double>(i), 0.5, -1.25, 9.7));
      log.add(*played[i]);
    }
  });
  const auto begin = mrpt::Clock::now();
  const auto ended = record("registration = none\nimu_rate_hz = 40\n", 1000);
  ASSERT_EQ(ended.code, 0) << testing::toString(ended);
  const auto scans = range_scans::recorded<CObservation3DRangeScan>(folder / "out/log.rawlog");
  ASSERT_GE(scans.size(), played.size() - 2) << testing::toString(ended);
  for (std::size_t i = 0; i < std::min(scans.size(), played.size()); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(scans[i]->sensorLabel, "KINECT");
    expectSameDepths(*scans[i], *played[i]);
    EXPECT_TRUE(range_scans::isSamePicture(*scans[i], *played[i]));
    EXPECT_GT(base::secondsBetween(begin, scans[i]->timestamp), 0);
    EXPECT_GT(base::secondsBetween(scans[i]->timestamp, mrpt::Clock::now()), 0);
    const auto before = i > 0 ? scans[i - 1]->timestamp : scans[i]->timestamp - base::durationFromSeconds(0.1);
    EXPECT_NEAR(base::secondsBetween(before, scans[i]->timestamp), 0.1, 0.05);
  }
  const auto accelerations = range_scans::recorded<CObservationIMU>(folder / "out/log.rawlog");
  ASSERT_GE(accelerations.size(), 4u);
  for (const auto& imu : accelerations) {
    constexpr double kCount = 9.80665 / 819;
    EXPECT_EQ(imu->sensorLabel, "KINECT_IMU");
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_X_ACC), 0.5, kCount);
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_Y_ACC), -1.25, kCount);
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_Z_ACC), 9.7, kCount);
    EXPECT_FALSE(imu->has(mrpt::obs::IMU_YAW_VEL));
  }
}

TEST_F(KinectSensorTest, aRealLogArrivesToTheQuantization) {
  const auto real = testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(real);
  OMNIMAPPER_NEEDS_FORMAT("rgbd_folder");
  // The first nine lines are a fifth of a second; three of them are comments.
  std::filesystem::create_directories(folder / "log");
  for (const char* name : {"depth", "rgb"}) std::filesystem::create_symlink(*real + "/" + name, folder / "log/" + name);
  for (const char* name : {"depth.txt", "rgb.txt"}) {
    std::ifstream from(*real + "/" + name);
    std::ofstream to(folder / "log/" + name);
    std::string line;
    for (int i = 0; i < 9 && std::getline(from, line); ++i) to << line << "\n";
  }
  makeSession(folder, folder / "log");
  range_scans::Scans played;
  const auto ini = base::Config::fromText("[source_rgbd_folder]\nintrinsics = freiburg1\n", "");
  const auto images = source::openLogs({folder / "log"}, source::readSourceOptions(ini));
  while (const auto one = images->next()) played.push_back(std::dynamic_pointer_cast<CObservation3DRangeScan>(one));
  const auto ended = record("registration = none\ngrab_IMU = false\n", 1000);
  ASSERT_EQ(ended.code, 0) << testing::toString(ended);
  const auto scans = range_scans::recorded<CObservation3DRangeScan>(folder / "out/log.rawlog");
  ASSERT_GE(scans.size(), played.size() - 2) << testing::toString(ended);
  for (std::size_t i = 0; i < std::min(scans.size(), played.size()); ++i) {
    SCOPED_TRACE(i);
    expectSameDepths(*scans[i], *played[i]);
    EXPECT_TRUE(!played[i]->hasIntensityImage || range_scans::isSamePicture(*scans[i], *played[i]));
  }
}

TEST_F(KinectSensorTest, aDepthCameraThatFallsSilentIsReportedAndOpenedAgain) {
  ASSERT_TRUE(silent) << "its session could not be made";
  const auto ended = silent->wait();
  ASSERT_EQ(ended.code, 0) << testing::toString(ended);
  // On a busy machine it is noticed later.
  const std::string lost = "sensor [kinect] is lost: the Kinect has sent no depth image for ";
  const auto lost_at = ended.out.find(lost);
  ASSERT_NE(lost_at, std::string::npos) << ended.out;
  EXPECT_GE(std::stod(ended.out.substr(lost_at + lost.size())), 0.4) << ended.out;
  const auto back = ended.out.find("sensor [kinect] is back");
  ASSERT_NE(back, std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("sensor [kinect] is lost: USB reports that the Kinect is gone", back), std::string::npos)
      << "at the end of the session: " << ended.out;
  EXPECT_NE(ended.out.find("reopened 1"), std::string::npos) << ended.out;
  const auto scans = range_scans::recorded<CObservation3DRangeScan>(*folder_of_silent / "out/log.rawlog");
  ASSERT_GE(scans.size(), 8u);
  double longest = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double step = base::secondsBetween(scans[i - 1]->timestamp, scans[i]->timestamp);
    EXPECT_GT(step, 0) << i;
    longest = std::max(longest, step);
  }
  EXPECT_GT(longest, 0.9);
}

// The machine of the tests has no Kinect, so libfreenect finds none.
TEST_F(KinectSensorTest, withoutAKinectItCannotBeOpened) {
  const auto config = base::Config::fromText(kSection, "robot.ini");
  const auto options = config.section("live").read<LiveOptions>();
  LiveSource source(readSensors(options, config), options, nullptr);
  try {
    source.open({});
    GTEST_SKIP() << "there is a Kinect on this machine";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("[kinect] (KinectSensor) cannot be opened"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::drivers::kinect_sensor_test
