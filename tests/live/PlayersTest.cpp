#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "Fault.h"
#include "PlayRun.h"
#include "ScipCodec.h"

// Tests of the programs and classes that play logs.
namespace omnimapper::live::players_test {
namespace {

using namespace players;

mrpt::obs::CObservation2DRangeScan scanOf(std::size_t beams, double aperture_deg, float max_range = 30) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.aperture = static_cast<float>(aperture_deg * M_PI / 180);
  scan.maxRange = max_range;
  scan.rightToLeft = true;
  scan.resizeScan(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    scan.setScanRange(i, 1 + 0.001f * static_cast<float>(i));
    scan.setScanRangeValidity(i, i != 3);
  }
  return scan;
}

TEST(HokuyoModel, hasAStepForEachBeam) {
  const auto utm = HokuyoModel::fitting(scanOf(1081, 270), 40);
  EXPECT_EQ(utm.steps_per_turn, 1440);
  EXPECT_EQ(utm.last - utm.first, 1080);
  EXPECT_EQ(utm.max_mm, 30'000);
  EXPECT_EQ(utm.rpm, 2400);
  EXPECT_EQ(HokuyoModel::fitting(scanOf(180, 179), 75).steps_per_turn, 360) << "a SICK of the year 2000";
  EXPECT_THROW(HokuyoModel::fitting(scanOf(100, 250), 10), base::Error) << "a turn is no whole number of steps";
  EXPECT_THROW(HokuyoModel::fitting(scanOf(1, 10), 10), base::Error);
  EXPECT_THROW(HokuyoModel::fitting(scanOf(1081, 270, 300), 10), base::Error);
}

TEST(HokuyoModel, scansGoFromRightToLeft) {
  auto scan = scanOf(1081, 270);
  const auto model = HokuyoModel::fitting(scan, 40);
  EXPECT_EQ(hokuyoScan(scan, model).ranges_mm[7], 1007u);
  EXPECT_EQ(hokuyoScan(scan, model).ranges_mm[3], 0u) << "no measurement";
  scan.rightToLeft = false;
  EXPECT_EQ(hokuyoScan(scan, model).ranges_mm[1080 - 7], 1007u);
}

TEST(ScipDevice, answersAsTheSpecificationSays) {
  ScipDevice device(HokuyoModel{});
  EXPECT_EQ(device.receive("BM\n", 0), "BM\n00P\n\n");
  EXPECT_EQ(device.receive("BM\n", 0), "BM\n02R\n\n") << "it is on";
  EXPECT_EQ(device.receive("XX;hello\n", 0), "XX;hello\n0Ee\n\n");
  EXPECT_EQ(device.receive("TM1\n", 0x1234), "TM1\n00P\n" + withScipSum(encodeScip(0x1234, 4)) + "\n");
  EXPECT_EQ(device.receive("MD00000002", 0), "") << "the command is not whole";
  EXPECT_FALSE(device.isMeasuring());
  EXPECT_EQ(device.receive("00002\n", 0), "MD0000000200002\n00P\n\n") << "two scans of three steps";
  HokuyoScan scan;
  scan.ranges_mm = {5432, 20, 30'000};
  EXPECT_EQ(device.measured(scan, 0),
            "MD0000000200001\n99b\n00000\n" + withScipSum("1Dh" + encodeScip(20, 3) + encodeScip(30'000, 3)) + "\n");
  EXPECT_EQ(device.measured(scan, 0).substr(0, 15), "MD0000000200000");
  EXPECT_FALSE(device.isMeasuring());
  EXPECT_EQ(device.measured(scan, 0), "");
  EXPECT_EQ(device.receive("MD0000200000100\n", 0).substr(16, 2), "04") << "a step that it does not have";
  EXPECT_EQ(device.receive("GD0000000200\nQT\n", 0), "GD0000000200\n10Q\n\nQT\n00P\n\n") << "it is off";
}

TEST(Fault, isReadOrRefused) {
  const auto fault = parseFault("silence@50:2.5");
  EXPECT_EQ(fault.kind, Fault::Kind::silence);
  EXPECT_EQ(fault.at, 50u);
  EXPECT_EQ(fault.seconds, 2.5);
  for (const char* text : {"", "silence", "silence@", "silence@-1", "quiet@3", "slow@3:", "slow@3:x", "slow@3:1:2"})
    EXPECT_THROW(parseFault(text), base::Error) << text;
}

PlayedLog twoLasers() {
  PlayedLog log;
  for (const char* label : {"front", "rear"}) {
    for (int i = 0; i < 3; ++i) {
      auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scanOf(181, 180));
      scan->timestamp = base::stampFromUnix(1e9 + i);
      log.lasers[label].push_back(scan);
    }
  }
  return log;
}

TEST(PlayRun, ofSeveralLasersEachIsNamed) {
  PlayOptions options;
  options.hokuyos = {"front=127.0.0.1:0", "rear=127.0.0.1:0"};
  PlayRun run(twoLasers(), options);
  EXPECT_EQ(run.addresses().size(), 2u);
  EXPECT_NE(run.addresses()[0], run.addresses()[1]);
  for (const char* wrong : {"127.0.0.1:0", "left=127.0.0.1:0", "front=127.0.0.1", "front=127.0.0.1:70000"}) {
    options.hokuyos = {wrong};
    EXPECT_THROW(PlayRun(twoLasers(), options), base::Error) << wrong;
  }
}

TEST(PlayRun, aTerminalIsALinkThatGoesWithIt) {
  const testing::ScratchFolder folder;
  PlayOptions options;
  options.hokuyos = {"front=" + (folder / "laser")};
  {
    const PlayRun run(twoLasers(), options);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "laser"));
  }
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "laser"));
}

TEST(PlayClock, aPaceShortensTheLog) {
  const auto log = base::stampFromUnix(1e9), host = base::stampFromUnix(2e9);
  const PlayClock clock(log, host, 4);
  EXPECT_EQ(clock.hostTime(log), host);
  EXPECT_NEAR(base::secondsBetween(host, clock.hostTime(log + base::durationFromSeconds(10))), 2.5, 1e-7);
}

TEST(PlayedOdometry, velocitiesGrowWithThePace) {
  OdometryReading reading{base::stampFromUnix(1e9), mrpt::poses::CPose2D(1, -2, 0.5),
                          mrpt::math::TTwist2D(0.5, 0, -0.25)};
  EXPECT_EQ(odometryLine(reading, base::stampFromUnix(2e9), 4), "2000000000.0000000 1 -2 0.5 2 0 -1\n");
  reading.velocity.reset();
  EXPECT_EQ(odometryLine(reading, base::stampFromUnix(2e9), 4), "2000000000.0000000 1 -2 0.5\n");
}

}  // namespace
}  // namespace omnimapper::live::players_test
