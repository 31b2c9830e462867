#include <gtest/gtest.h>

#include "lines/ScanPoints.h"

namespace omnimapper::perception::lines::scan_points_test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180, kMaxGap = 0.2;

/// Neighbouring beams a quarter of a degree apart that end at these ranges [m].
ScanPoints beamsOf(const std::vector<double>& ranges) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(0.25 * kDegree * static_cast<double>(ranges.size() - 1));
  scan.maxRange = 30;
  scan.rightToLeft = true;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, static_cast<float>(ranges[i]));
    scan.setScanRangeValidity(i, ranges[i] > 0);
  }
  return pointsOf(scan, {});
}

TEST(ScanPoints, AnObjectAndWhatIsBehindItAreNoWall) {
  // 2.5 m apart, where a wall at 87 degrees would have 20 x 0.25 deg x 1 m = 0.087 m between two beams.
  EXPECT_TRUE(beamsOf({1, 3.5}).isBehind(0, 1, kMaxGap));
  EXPECT_TRUE(beamsOf({3.5, 1}).isBehind(0, 1, kMaxGap));
  EXPECT_FALSE(beamsOf({1, 1.15}).isBehind(0, 1, kMaxGap)) << "less than a gap";
}

TEST(ScanPoints, WallsSeenAslantAreWalls) {
  // On a wall 0.6 m beside the sensor, a beam meets it at 10 m, and the next one 10^2 x 0.25 deg / 0.6 = 0.73 m farther
  // on.
  const double angle = std::asin(0.6 / 10), next = 0.6 / std::sin(angle - 0.25 * kDegree);
  const auto points = beamsOf({10, next});
  EXPECT_GT(points.distanceBetween(0, 1), 0.7);
  EXPECT_FALSE(points.isBehind(0, 1, kMaxGap));
  EXPECT_FALSE(points.isGap(0, 1, kMaxGap)) << "nothing was measured between two beams";
}

TEST(ScanPoints, BeamsWithoutEchoLeaveAGapOnceTheyAreTwo) {
  EXPECT_FALSE(beamsOf({25, 0, 25}).isGap(0, 1, kMaxGap)) << "0.22 m, but one beam may fail";
  EXPECT_TRUE(beamsOf({25, 0, 0, 25}).isGap(0, 1, kMaxGap));
}

}  // namespace
}  // namespace omnimapper::perception::lines::scan_points_test
