#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "laser2d/UsableScan.h"

namespace omnimapper::plugins::usable_scan_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;

// 181 beams over half a turn, all of which end at 3 m.
CObservation2DRangeScan scan() {
  CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(M_PI);
  scan.maxRange = 10;
  scan.resizeScan(181);
  for (std::size_t i = 0; i < 181; ++i) {
    scan.setScanRange(i, 3);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

std::size_t invalidBeams(const CObservation2DRangeScan& scan, std::size_t from, std::size_t until) {
  std::size_t count = 0;
  for (std::size_t i = from; i < until; ++i) count += !scan.getScanRangeValidity(i);
  return count;
}

// A point straight ahead of a laser that is 0.2 m before the base: beams are 5 cm apart there.
TEST(UsableScan, BeamsNearAPointAreLeftOutAndAllOthersKept) {
  auto raw = scan();
  raw.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, 0);
  const auto usable = withoutBeamsNear({{3.2F, 0}}, 0.09F, raw);
  EXPECT_EQ(invalidBeams(*usable, 0, 181), 3U);
  EXPECT_EQ(invalidBeams(*usable, 89, 92), 3U);
  EXPECT_EQ(usable->getScanRange(0), 3);
}

// Upside down, its left is the base's right.
TEST(UsableScan, ALaserMayBeUpsideDown) {
  auto raw = scan();
  raw.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI);
  const auto usable = withoutBeamsNear({{0, 3}}, 0.09F, raw);
  EXPECT_EQ(invalidBeams(*usable, 0, 5), 2U);
  EXPECT_EQ(invalidBeams(*usable, 5, 181), 0U);
}

TEST(UsableScan, TheSameRangesAreRecognizedWhateverBeamsWithoutEchoHold) {
  auto a = scan();
  auto b = scan();
  EXPECT_TRUE(haveSameRanges(a, b));
  for (auto* each : {&a, &b}) each->setScanRange(7, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(haveSameRanges(a, b)) << "NaN differs from itself";
  a.setScanRange(8, 12);
  b.setScanRange(8, 0);
  b.setScanRangeValidity(8, false);
  EXPECT_TRUE(haveSameRanges(a, b)) << "neither is an echo";
  b.setScanRange(9, 3.01F);
  EXPECT_FALSE(haveSameRanges(a, b));
}

TEST(UsableScan, ScansOfFewEchoesAreNotTheSame) {
  auto a = scan();
  for (std::size_t i = 9; i < 181; ++i) a.setScanRangeValidity(i, false);
  EXPECT_FALSE(haveSameRanges(a, a)) << "in the open nothing is seen";
  EXPECT_FALSE(haveSameRanges(a, scan()));
  EXPECT_FALSE(haveSameRanges(scan(), CObservation2DRangeScan()));
}

}  // namespace
}  // namespace omnimapper::plugins::usable_scan_test
