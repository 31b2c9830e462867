#include <gtest/gtest.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/testing/LineScans.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

namespace omnimapper::perception::laser_line_extractor_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using obs::LineEnd;
using Method = LaserLineOptions::Method;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Method kMethods[] = {Method::split_and_merge, Method::ransac};

/// A scan from a function of the angle [rad] that gives the range [m]; beams whose range is not finite are invalid.
CObservation2DRangeScan scanOf(int beams, double aperture, const std::function<double(double)>& range) {
  CObservation2DRangeScan scan;
  scan.sensorLabel = "front";
  scan.timestamp = base::stampFromUnix(1e9);
  scan.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0.1, 0, 0);
  scan.aperture = static_cast<float>(aperture);
  scan.maxRange = 30;
  scan.rightToLeft = true;
  scan.resizeScan(static_cast<std::size_t>(beams));
  for (int i = 0; i < beams; ++i) {
    const double angle = beams > 1 ? aperture * (i / (beams - 1.0) - 0.5) : 0;
    const double r = range(angle);
    scan.setScanRange(static_cast<std::size_t>(i), static_cast<float>(r));
    scan.setScanRangeValidity(static_cast<std::size_t>(i), std::isfinite(r));
  }
  return scan;
}

/// Range of the wall x cos(normal) + y sin(normal) = distance.
double wall(double angle, double normal, double distance) {
  const double cosine = std::cos(angle - normal);
  return cosine > 1e-9 ? distance / cosine : kNan;
}

LaserLineOptions optionsOf(Method method) {
  LaserLineOptions options;
  options.method = method;
  return options;
}

std::vector<obs::LaserLine> linesOf(const CObservation2DRangeScan& scan, const LaserLineOptions& options = {}) {
  return LaserLineExtractor(options).extract(scan)->lines;
}

std::vector<geometry::Segment2> segmentsOf(const CObservation2DRangeScan& scan, Method method) {
  std::vector<geometry::Segment2> segments;
  for (const auto& line : linesOf(scan, optionsOf(method))) segments.push_back(line.segment_in_sensor);
  return segments;
}

TEST(LaserLineExtractor, ThreePointsOnAWallGiveTheCovarianceWorkedByHand) {
  // Beams at -45, 0 and 45 deg meet x = 1 at y = -1, 0, 1. If the range has the deviation s and there is no other
  // noise, points deviate by s cos across the wall: variances s^2 (1/2, 1, 1/2), weights (2, 1, 2) / s^2. Information
  // of the angle: sum w y^2 = 4 / s^2, of the distance: sum w = 5 / s^2, mixed: 0.
  LaserLineOptions options;
  options.range_sigma = 0.01;
  options.beam_width = 0;
  options.roughness = 0;
  options.min_points = 3;
  for (const Method method : kMethods) {
    options.method = method;
    const auto lines = linesOf(scanOf(3, kPi / 2, [](double a) { return wall(a, 0, 1); }), options);
    ASSERT_EQ(lines.size(), 1U);
    const auto& line = lines[0];
    EXPECT_NEAR(line.angle, 0, 1e-6);
    EXPECT_NEAR(line.distance, 1, 1e-6);
    EXPECT_NEAR(line.covariance(0, 0), 1e-4 / 4, 1e-9);
    EXPECT_NEAR(line.covariance(1, 1), 1e-4 / 5, 1e-9);
    EXPECT_NEAR(line.covariance(0, 1), 0, 1e-9);
    EXPECT_LT((line.segment_in_sensor.from - Eigen::Vector2d(1, -1)).norm(), 1e-6);
    EXPECT_LT((line.segment_in_sensor.to - Eigen::Vector2d(1, 1)).norm(), 1e-6);
    EXPECT_EQ(line.first_beam, 0U);
    EXPECT_EQ(line.last_beam, 2U);
    EXPECT_EQ(line.inliers, 3U);
    EXPECT_EQ(line.from_end, LineEnd::view);
    EXPECT_EQ(line.to_end, LineEnd::view);
  }
}

TEST(LaserLineExtractor, TheLinesHaveStampPoseAndLabelsOfTheirScan) {
  const auto scan = scanOf(181, kPi, [](double a) { return wall(a, 0.3, 2); });
  const auto derived = LaserLineExtractor({}).extract(scan);
  EXPECT_EQ(derived->timestamp, scan.timestamp);
  EXPECT_EQ(derived->sensorPose, scan.sensorPose);
  EXPECT_EQ(derived->sensorLabel, "front.lines");
  EXPECT_EQ(derived->source_label, "front");
}

TEST(LaserLineExtractor, ScansFromLeftToRightGiveTheirLinesInThatOrder) {
  auto scan = scanOf(181, kPi, [](double a) { return std::min(wall(a, kPi / 2, 2), 20.0); });
  scan.rightToLeft = false;
  const auto lines = linesOf(scan);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].angle, -kPi / 2, 1e-6);
  EXPECT_LT(lines[0].segment_in_sensor.from.x(), 25);
}

TEST(LaserLineExtractor, LineParametersAreAsUncertainAsTheirCovarianceSays) {
  // Chi-square of (angle, distance) over 500 scans: its sum has 1000 degrees of freedom, of which the 95 % bounds are
  // 914 and 1090.
  LaserLineOptions options;
  options.roughness = 0;
  options.beam_width = 0;
  options.range_sigma = 0.02;
  for (const Method method : kMethods) {
    options.method = method;
    testing::Dice dice(8);
    double sum = 0;
    for (int i = 0; i < 500; ++i) {
      const double normal = dice.uniform(-0.5, 0.5), distance = dice.uniform(1, 4);
      const auto scan = scanOf(181, kPi / 2, [&](double a) { return wall(a, normal, distance) + dice.normal(0.02); });
      const auto lines = linesOf(scan, options);
      ASSERT_EQ(lines.size(), 1U) << i;
      const Eigen::Vector2d error(lines[0].angle - normal, lines[0].distance - distance);
      sum += error.dot(lines[0].covariance.inverse() * error);
    }
    EXPECT_GT(sum, 914);
    EXPECT_LT(sum, 1090);
  }
}

TEST(LaserLineExtractor, WallsThatMeetEndInTheirCorner) {
  // Two walls, x = 2 and y = 2, and nothing else.
  const auto scan = scanOf(181, kPi, [](double a) {
    const double ahead = wall(a, 0, 2), left = wall(a, kPi / 2, 2);
    return std::isnan(ahead) ? left : std::isnan(left) ? ahead : std::min(ahead, left);
  });
  for (const Method method : kMethods) {
    const auto lines = linesOf(scan, optionsOf(method));
    ASSERT_EQ(lines.size(), 2U);
    for (const auto& point : {lines[0].segment_in_sensor.to, lines[1].segment_in_sensor.from})
      EXPECT_LT((point - Eigen::Vector2d(2, 2)).norm(), 1e-5);
    EXPECT_EQ(lines[0].to_end, LineEnd::wall);
    EXPECT_EQ(lines[1].from_end, LineEnd::wall);
    EXPECT_EQ(lines[1].to_end, LineEnd::view);
    EXPECT_NEAR(lines[0].angle, 0, 1e-6);
    EXPECT_NEAR(lines[1].angle, kPi / 2, 1e-6);
  }
}

TEST(LaserLineExtractor, AGapMakesTwoLinesAndItsEndsAreTheWallsOwn) {
  // A doorway of 0.9 m in the wall x = 3. Beams through it meet nothing, or a wall far behind.
  for (const double behind : {kNan, 9.0}) {
    const auto scan = scanOf(361, kPi / 2, [&](double a) {
      const double y = 3 * std::tan(a);
      return y > -0.4 && y < 0.5 ? behind : wall(a, 0, 3);
    });
    for (const Method method : kMethods) {
      const auto lines = linesOf(scan, optionsOf(method));
      std::vector<obs::LaserLine> on_wall;
      for (const auto& line : lines)
        if (std::abs(line.distance - 3) < 0.01) on_wall.push_back(line);
      ASSERT_EQ(on_wall.size(), 2U);
      EXPECT_NEAR(on_wall[0].segment_in_sensor.to.y(), -0.4, 0.03);
      EXPECT_NEAR(on_wall[1].segment_in_sensor.from.y(), 0.5, 0.03);
      const LineEnd expected = std::isnan(behind) ? LineEnd::view : LineEnd::wall;
      EXPECT_EQ(on_wall[0].to_end, expected);
      EXPECT_EQ(on_wall[1].from_end, expected);
    }
  }
}

TEST(LaserLineExtractor, WhatStandsBeforeAWallHidesItsEnds) {
  // A pillar 0.5 m wide at 1 m before a wall at 3 m, which it hides for 1.5 m.
  const auto scan =
      scanOf(361, kPi / 2, [](double a) { return std::abs(std::tan(a)) < 0.25 ? wall(a, 0, 1) : wall(a, 0, 3); });
  for (const Method method : kMethods) {
    const auto lines = linesOf(scan, optionsOf(method));
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[2].first_beam, lines[1].last_beam + 1);
    EXPECT_EQ(lines[0].to_end, LineEnd::occluded);
    EXPECT_EQ(lines[1].from_end, LineEnd::wall);
    EXPECT_EQ(lines[1].to_end, LineEnd::wall);
    EXPECT_EQ(lines[2].from_end, LineEnd::occluded);
  }
}

TEST(LaserLineExtractor, AThinPoleDoesNotPartAWall) {
  const auto scan = scanOf(361, kPi / 2, [](double a) { return std::abs(a - 0.1) < 0.01 ? 1.5 : wall(a, 0, 3); });
  for (const Method method : kMethods) {
    const auto lines = linesOf(scan, optionsOf(method));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].first_beam, 0U);
    EXPECT_EQ(lines[0].last_beam, 360U);
    EXPECT_LT(lines[0].inliers, 361U);
  }
}

TEST(LaserLineExtractor, AWallThatAScanAllRoundEndsInIsOneLine) {
  // A room of 6 m x 4 m; the scan begins and ends in the middle of the wall behind.
  const auto room = [](double a) {
    double nearest = 1e9;
    for (const auto& [normal, distance] : {std::pair{0.0, 3.0}, {kPi / 2, 2.0}, {kPi, 3.0}, {-kPi / 2, 2.0}}) {
      const double range = wall(a, normal, distance);
      if (range < nearest) nearest = range;
    }
    return nearest;
  };
  for (const double aperture : {2 * kPi, 2 * kPi * 359 / 360}) {
    for (const Method method : kMethods) {
      const auto lines = linesOf(scanOf(360, aperture, room), optionsOf(method));
      ASSERT_EQ(lines.size(), 4U);
      int over_the_end = 0;
      for (const auto& line : lines) {
        over_the_end += line.first_beam > line.last_beam;
        EXPECT_EQ(line.from_end, LineEnd::wall);
        EXPECT_EQ(line.to_end, LineEnd::wall);
        EXPECT_NEAR(std::abs(line.segment_in_sensor.from.x()), 3, 2e-3);
        EXPECT_NEAR(std::abs(line.segment_in_sensor.from.y()), 2, 2e-3);
      }
      EXPECT_EQ(over_the_end, 1);
    }
  }
}

TEST(LaserLineExtractor, ScansThatShowNoLineGiveNone) {
  for (const Method method : kMethods) {
    const auto options = optionsOf(method);
    const auto at = [](double value) { return [=](double) { return value; }; };
    for (const int beams : {0, 1, 2, 5}) EXPECT_TRUE(linesOf(scanOf(beams, 1, at(2)), options).empty()) << beams;
    for (const double value : {kNan, 0.0, -3.0, 1e9, std::numeric_limits<double>::infinity()})
      EXPECT_TRUE(linesOf(scanOf(181, kPi, at(value)), options).empty()) << value;
    EXPECT_TRUE(linesOf(scanOf(181, kPi, [](double a) { return std::abs(a) < 0.001 ? 2 : kNan; }), options).empty());
    // Beams that are flagged valid although their range is NaN.
    auto scan = scanOf(181, kPi, at(2));
    for (std::size_t i = 0; i < 181; ++i) scan.setScanRange(i, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(linesOf(scan, options).empty());
    // All points in one place.
    EXPECT_TRUE(linesOf(scanOf(50, 0, at(2)), options).empty());
  }
}

TEST(LaserLineExtractor, PointsOnOneBeamAreFiniteWithoutNoiseAcrossIt) {
  for (const Method method : kMethods) {
    auto options = optionsOf(method);
    options.roughness = options.beam_width = 0;
    auto scan = scanOf(60, 0, [](double) { return 2; });
    for (std::size_t i = 0; i < 60; ++i) scan.setScanRange(i, 1 + 0.05F * static_cast<float>(i));
    for (const auto& line : linesOf(scan, options)) {
      EXPECT_TRUE(std::isfinite(line.angle) && std::isfinite(line.distance) && line.covariance.allFinite());
    }
  }
}

TEST(LaserLineExtractor, BothMethodsAgreeInCleanRooms) {
  testing::LineScanOptions clean;
  clean.clutter = 0;
  clean.mixed = 0;
  clean.beams = 361;
  testing::LineScore score[2];
  for (int seed = 1; seed <= 60; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(seed));
    const auto truth = testing::drawLineScan(clean, dice);
    for (const Method method : kMethods) {
      const auto found = segmentsOf(truth.scan, method);
      score[method == Method::ransac].add(truth, found);
    }
  }
  for (const auto& each : score) {
    EXPECT_GE(each.recall(), 0.99);
    EXPECT_GE(each.precision(), 0.99);
    EXPECT_LT(each.meanEndError(), 0.04);
  }
}

TEST(LaserLineExtractor, FindsTheWallsOfRoomsWithClutter) {
  for (const int beams : {181, 1081}) {
    testing::LineScanOptions options;
    options.beams = beams;
    testing::LineScore score[2];
    for (int seed = 1; seed <= 60; ++seed) {
      testing::Dice dice(static_cast<std::uint64_t>(seed));
      const auto truth = testing::drawLineScan(options, dice);
      for (const Method method : kMethods) score[method == Method::ransac].add(truth, segmentsOf(truth.scan, method));
    }
    for (const auto& each : score) {
      EXPECT_GE(each.recall(), 0.93) << beams;
      EXPECT_GE(each.precision(), 0.9) << beams;
    }
  }
}

TEST(LaserLineExtractor, SeveralThreadsAtOnceGetWhatOneGets) {
  testing::Dice dice(5);
  std::vector<testing::LineScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(testing::drawLineScan({}, dice));
  const LaserLineExtractor extractor(optionsOf(Method::ransac));
  const auto work = [&] {
    std::string rows;
    for (const auto& truth : scans) rows += extractor.extract(truth.scan)->exportTxtDataRow() + "\n";
    return rows;
  };
  const auto alone = work();
  std::vector<std::string> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = work(); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace omnimapper::perception::laser_line_extractor_test
