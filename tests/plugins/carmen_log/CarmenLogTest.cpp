#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <cmath>

#include "carmen_log/CarmenLog.h"

namespace omnimapper::source::carmen_log_test {
namespace {

using logs::readAll;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using Strings = std::vector<std::string>;
using Ending = SourceReport::Ending;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// A FLASER line (or RLASER): readings, pose of laser and robot (the same), stamp.
std::string laserLine(const std::string& name, const std::vector<double>& readings, double x,
                      const std::string& stamp) {
  std::string line = name + " " + std::to_string(readings.size());
  for (const double reading : readings) line += " " + std::to_string(reading);
  for (int i = 0; i < 2; ++i) line += " " + std::to_string(x) + " 0.5 0.25";
  return line + " " + stamp + " nohost 0.1\n";
}

std::string flaser(double x, const std::string& stamp) {
  return laserLine("FLASER", {1, 2, 3}, x, stamp);
}

std::string odom(double x, const std::string& stamp) {
  return "ODOM " + std::to_string(x) + " 0.5 0.25 0.7 0.1 0 " + stamp + " nohost 0.1\n";
}

// "LABEL stamp x" for odometry, "LABEL stamp" for scans.
Strings listing(const logs::Observations& observations) {
  Strings list;
  for (const auto& observation : observations) {
    std::string text = observation->sensorLabel + " " + base::formatUnix(observation->timestamp, 3);
    if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
      text += " " + std::to_string(odometry->odometry.x()).substr(0, 3);
    list.push_back(text);
  }
  return list;
}

class CarmenLogTest : public ::testing::Test {
 protected:
  CarmenLog& open(const std::string& text, CarmenOdometry odometry = CarmenOdometry::automatic) {
    logs::writePlain(path_, text);
    log_ = std::make_unique<CarmenLog>(path_, CarmenOptions{odometry});
    return *log_;
  }
  Strings read(const std::string& text, CarmenOdometry odometry = CarmenOdometry::automatic) {
    return listing(readAll(open(text, odometry)));
  }
  // The first scan of the log.
  CObservation2DRangeScan::Ptr scanOf(const std::string& text) {
    for (const auto& observation : readAll(open(text)))
      if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) return scan;
    return nullptr;
  }
  // Direction of beam i in the base [rad], by MRPT's rule.
  static double direction(const CObservation2DRangeScan& scan, std::size_t i) {
    const double n = static_cast<double>(scan.getScanSize());
    return scan.sensorPose.yaw() - 0.5 * scan.aperture + static_cast<double>(i) * scan.aperture / (n - 1);
  }

  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "x.clf";
  std::unique_ptr<CarmenLog> log_;
};

TEST_F(CarmenLogTest, odometryOfScansComesRightBeforeThemWithTheirStamp) {
  EXPECT_EQ(read(flaser(1, "10.5") + flaser(2, "10.7")),
            (Strings{"ODOM 10.500 1.0", "FLASER 10.500", "ODOM 10.700 2.0", "FLASER 10.700"}));
  EXPECT_EQ(log_->odometry(), CarmenOdometry::scans);
}

TEST_F(CarmenLogTest, odometryOfLinesComesFirstWhereTheClockIsGood) {
  const std::string text = odom(1, "10.4") + flaser(1, "10.5") + odom(2, "10.6") + flaser(2, "10.7");
  EXPECT_EQ(read(text), (Strings{"ODOM 10.400 1.0", "FLASER_ODOM 10.500 1.0", "FLASER 10.500", "ODOM 10.600 2.0",
                                 "FLASER_ODOM 10.700 2.0", "FLASER 10.700"}));
  EXPECT_EQ(log_->odometry(), CarmenOdometry::lines);
  EXPECT_EQ(read(text, CarmenOdometry::scans),
            (Strings{"ODOM 10.500 1.0", "FLASER 10.500", "ODOM 10.700 2.0", "FLASER 10.700"}));
  EXPECT_EQ(log_->unusedOdometry(), 2u);
}

TEST_F(CarmenLogTest, odometryOfScansIsTakenWhereAnyStampRunsBackwards) {
  EXPECT_EQ(read(odom(1, "10.4") + flaser(1, "10.5") + odom(2, "10.3") + flaser(2, "10.7")),
            (Strings{"ODOM 10.500 1.0", "FLASER 10.500", "ODOM 10.700 2.0", "FLASER 10.700"}));
}

TEST_F(CarmenLogTest, stampsOfALabelRiseByAMillisecondAtLeast) {
  EXPECT_EQ(read(flaser(1, "10.5") + flaser(2, "9.0") + flaser(3, "10.5005") + flaser(4, "10.6")),
            (Strings{"ODOM 10.500 1.0", "FLASER 10.500", "ODOM 10.501 2.0", "FLASER 10.501", "ODOM 10.502 3.0",
                     "FLASER 10.502", "ODOM 10.600 4.0", "FLASER 10.600"}));
  EXPECT_EQ(log_->report().repaired_stamps, 2u);
  EXPECT_EQ(log_->report().backwardStamps(), 0u);
}

TEST_F(CarmenLogTest, stampZeroBecomesAStampThatMrptKnows) {
  EXPECT_EQ(read(odom(1, "0.000000") + odom(2, "0.5"), CarmenOdometry::lines),
            (Strings{"ODOM 0.001 1.0", "ODOM 0.500 2.0"}));
}

TEST_F(CarmenLogTest, stampsKeepEveryDigit) {
  const auto observations = readAll(open(flaser(1, "976052857.337530")));
  EXPECT_EQ(base::formatUnix(observations.at(0)->timestamp), "976052857.3375300");
}

TEST_F(CarmenLogTest, twoLasersShareOneOdometryThatNeverRunsBack) {
  EXPECT_EQ(read(flaser(1, "10.5") + laserLine("RLASER", {1, 2, 3}, 1, "10.4") + flaser(2, "10.6")),
            (Strings{"ODOM 10.500 1.0", "FLASER 10.500", "RLASER 10.400", "ODOM 10.600 2.0", "FLASER 10.600"}));
  EXPECT_EQ(log_->unusedOdometry(), 1u);
}

TEST_F(CarmenLogTest, odometryHasPoseAndSpeed) {
  const auto observations = readAll(open(odom(1.5, "10.4"), CarmenOdometry::lines));
  const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observations.at(0));
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->odometry, mrpt::poses::CPose2D(1.5, 0.5, 0.25));
  ASSERT_TRUE(odometry->hasVelocities);
  EXPECT_EQ(odometry->velocityLocal.vx, 0.7);
  EXPECT_EQ(odometry->velocityLocal.omega, 0.1);
}

TEST_F(CarmenLogTest, hundredAndEightyBeamsLieFromMinus90To89Degrees) {
  const auto scan = scanOf(laserLine("FLASER", std::vector<double>(180, 5.0), 0, "10"));
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->aperture, 179 * kDegree, 1e-6);
  EXPECT_NEAR(scan->sensorPose.yaw(), -0.5 * kDegree, 1e-9);
  EXPECT_TRUE(scan->rightToLeft);
  for (const std::size_t i : {0u, 90u, 179u})
    EXPECT_NEAR(direction(*scan, i), (static_cast<double>(i) - 90) * kDegree, 1e-6);
}

TEST_F(CarmenLogTest, otherCountsOfBeamsAreThoseOfSick) {
  const auto ends = [&](std::size_t beams) {
    const auto scan = scanOf(laserLine("FLASER", std::vector<double>(beams, 5.0), 0, "10"));
    return std::make_pair(std::round(direction(*scan, 0) / kDegree * 100) / 100,
                          std::round(direction(*scan, beams - 1) / kDegree * 100) / 100);
  };
  EXPECT_EQ(ends(181), std::make_pair(-90.0, 90.0));
  EXPECT_EQ(ends(361), std::make_pair(-90.0, 90.0));
  EXPECT_EQ(ends(360), std::make_pair(-90.0, 89.5));
  EXPECT_EQ(ends(401), std::make_pair(-50.0, 50.0));
}

TEST_F(CarmenLogTest, parameterLinesGiveBeamsAndMounting) {
  const auto scan = scanOf(
      "PARAM robot_frontlaser_offset 0.25 nohost 0\nPARAM robot_frontlaser_side_offset -0.05 nohost 0\n"
      "PARAM laser_front_laser_resolution 0.5 nohost 0\nPARAM laser_front_laser_fov 100 nohost 0\n"
      "PARAM robot_front_laser_max 20 nohost 0\n" +
      laserLine("FLASER", std::vector<double>(200, 19.0), 0, "10"));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sensorPose.x(), 0.25);
  EXPECT_EQ(scan->sensorPose.y(), -0.05);
  EXPECT_NEAR(direction(*scan, 0), -50 * kDegree, 1e-6);
  EXPECT_NEAR(direction(*scan, 199), 49.5 * kDegree, 1e-6);
  EXPECT_EQ(scan->maxRange, 20.0f);
}

TEST_F(CarmenLogTest, rearLaserLooksBack) {
  const auto scan = scanOf("PARAM robot_rearlaser_offset -0.3 nohost 0\n" +
                           laserLine("RLASER", std::vector<double>(181, 5.0), 0, "10"));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sensorLabel, "RLASER");
  EXPECT_EQ(scan->sensorPose.x(), -0.3);
  EXPECT_NEAR(std::abs(scan->sensorPose.yaw()), 180 * kDegree, 1e-9);
}

TEST_F(CarmenLogTest, readingsWithoutEchoAreInvalid) {
  const auto scan = scanOf(laserLine("FLASER", {5, 81.91, 80, 79.99, 0, -1}, 0, "10"));
  ASSERT_TRUE(scan);
  std::string validity;
  for (std::size_t i = 0; i < 6; ++i) validity += scan->getScanRangeValidity(i) ? '1' : '0';
  EXPECT_EQ(validity, "100100");
  EXPECT_EQ(scan->getScanRange(0), 5.0f);
}

// type start fov resolution max accuracy remission | 4 readings | 2 remissions | laser pose | robot pose | ...
const char* const kRobotLaser =
    "ROBOTLASER1 0 -1.570796 3.141593 1.047197 30.0 0.02 0 4 1.0 2.0 30.0 4.0 2 0.5 0.6 "
    "1.0 2.3 1.570796 1.0 2.0 1.570796 0 0 0.1 0.1 1e6 20.25 host 0.5\n";

TEST_F(CarmenLogTest, robotLaserLineSaysBeamsAndMountingItself) {
  EXPECT_EQ(read(kRobotLaser), (Strings{"ODOM 20.250 1.0", "ROBOTLASER1 20.250"}));
  const auto scan = scanOf(kRobotLaser);
  ASSERT_TRUE(scan);
  // The robot looks along y; the laser, 0.3 m further along y, is ahead of it.
  EXPECT_NEAR(scan->sensorPose.x(), 0.3, 1e-6);
  EXPECT_NEAR(scan->sensorPose.y(), 0, 1e-6);
  EXPECT_NEAR(direction(*scan, 0), -90 * kDegree, 1e-5);
  EXPECT_NEAR(direction(*scan, 3), 90 * kDegree, 1e-4);
  EXPECT_EQ(scan->stdError, 0.02f);
  EXPECT_EQ(scan->maxRange, 30.0f);
  EXPECT_TRUE(scan->getScanRangeValidity(1));
  EXPECT_FALSE(scan->getScanRangeValidity(2));
}

TEST_F(CarmenLogTest, badLinesAreLeftOutAndNamed) {
  EXPECT_EQ(read("# comment\n" + flaser(1, "1") + "FLASER 3 1 2 oops 0 0 0 0 0 0 2 h 0\n" + "ODOM 1 2\n" +
                 "FLASER 500 1 2 3\n" + flaser(2, "2x") + "\n" + "TRUEPOS 0 0 0 0 0 0 1 h 0\n" + flaser(4, "4")),
            (Strings{"ODOM 1.000 1.0", "FLASER 1.000", "ODOM 4.000 4.0", "FLASER 4.000"}));
  EXPECT_EQ(log_->badLineCount(), 4u);
  Strings bad;
  for (const auto& line : log_->badLines()) bad.push_back(std::to_string(line.number) + " " + line.reason);
  EXPECT_EQ(bad[0], "3 has 'oops' where a number is expected");
  EXPECT_EQ(bad[1], "4 ends too early");
  EXPECT_EQ(bad[2], "5 has fewer readings than it states");
  EXPECT_EQ(bad[3].rfind("6 has a stamp that cannot be read: '2x'", 0), 0U) << bad[3];
  const auto report = log_->report();
  EXPECT_EQ(report.ending, Ending::corrupt);
  EXPECT_EQ(report.other_objects.at("TRUEPOS"), 1u);
  EXPECT_NE(report.message.find("left out: 4."), std::string::npos) << report.message;
  EXPECT_NE(report.message.find("is line 3: it has 'oops'"), std::string::npos) << report.message;
}

TEST_F(CarmenLogTest, logThatEndsInTheMiddleOfALineIsTruncated) {
  const std::string text = flaser(1, "1") + flaser(2, "2");
  EXPECT_EQ(read(text.substr(0, text.size() - 30)).size(), 2u);
  EXPECT_EQ(log_->report().ending, Ending::truncated);
  EXPECT_EQ(log_->report().exitCode(), base::ExitCode::damaged_input);
  EXPECT_EQ(read(text.substr(0, text.size() - 1)).size(), 4u) << "only the line feed is missing";
  EXPECT_EQ(log_->report().ending, Ending::complete);
}

TEST_F(CarmenLogTest, compressedLogsGiveTheSame) {
  std::string text;
  for (int i = 1; i < 3000; ++i) text += flaser(i, std::to_string(i));
  const auto expected = read(text);
  for (const auto& path :
       {logs::writeGzip(folder_ / "x.clf.gz", text), logs::writeBzip2(folder_ / "x.clf.bz2", text)}) {
    CarmenLog log(path);
    EXPECT_EQ(listing(readAll(log)), expected) << path;
    EXPECT_EQ(log.report().ending, Ending::complete);
  }
}

TEST_F(CarmenLogTest, truncatedCompressedLogsGiveWhatIsReadable) {
  std::string text;
  for (int i = 1; i < 20000; ++i) text += flaser(i, std::to_string(i));
  const auto expected = read(text);
  for (const auto& path :
       {logs::writeGzip(folder_ / "x.clf.gz", text), logs::writeBzip2(folder_ / "x.clf.bz2", text)}) {
    const auto bytes = logs::readFile(path);
    for (const double part : {0.5, 0.9, 0.999}) {
      SCOPED_TRACE(path + " " + std::to_string(part));
      logs::writePlain(path, bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
      CarmenLog log(path);
      const auto got = listing(readAll(log));
      EXPECT_GT(got.size(), 100u);
      EXPECT_LT(got.size(), expected.size());
      EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.begin()));
      EXPECT_EQ(log.report().ending, Ending::truncated);
    }
  }
}

TEST_F(CarmenLogTest, whatIsNoCarmenLogIsRefused) {
  EXPECT_THROW(open("Dear diary,\n"), base::Error);
  EXPECT_THROW(open(""), base::Error);
  EXPECT_THROW(open((logs::Bytes() << logs::scan(1)).string()), base::Error);
  EXPECT_THROW(CarmenLog(folder_ / "nowhere.clf"), base::Error);
}

TEST_F(CarmenLogTest, isRecognizedByTheFirstWordsOfItsLines) {
  const auto isRecognized = [&](const std::string& text) {
    return CarmenLog::recognizes(LogLook::at(logs::writePlain(path_, text)));
  };
  EXPECT_TRUE(isRecognized("# message_name ...\nPARAM robot_use_laser on nohost 0\n"));
  EXPECT_TRUE(isRecognized("ODOM 0 0 0 0 0 0 1.0 nohost 0\n"));
  EXPECT_TRUE(CarmenLog::recognizes(LogLook::at(logs::writeGzip(path_, "FLASER 1 2\n"))));
  EXPECT_FALSE(isRecognized("the ODOM of a car\n"));
  EXPECT_FALSE(isRecognized("ODOMETER 12\n"));
  EXPECT_FALSE(isRecognized(std::string("ODOM 1\n\0", 8))) << "not text";
}

}  // namespace
}  // namespace omnimapper::source::carmen_log_test
