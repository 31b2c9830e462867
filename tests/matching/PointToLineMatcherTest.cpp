#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/PointToLineMatcher.h>

#include <Eigen/Eigenvalues>

#include "Scans.h"

namespace omnimapper::matching::point_to_line_matcher_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;
constexpr double kDegree = 3.14159265358979323846 / 180;

ScanMatch match(const ScanWithNormals& reference, const ScanWithNormals& scan, const TPose2D& guess) {
  const PointToLineMatcher matcher(ScanMatcherOptions{});
  return matcher.match(*matcher.prepare(reference), scan, guess);
}

void expectNear(const TPose2D& found, const TPose2D& truth, double position, double angle) {
  EXPECT_LT(std::hypot(found.x - truth.x, found.y - truth.y), position) << found << " is not " << truth;
  EXPECT_LT(std::abs(found.phi - truth.phi), angle) << found << " is not " << truth;
}

// The points of a scan, of whose beams a share `clutter` ends at people and panes of glass instead, anywhere.
std::vector<Eigen::Vector2f> beams(const FloorPlan& plan, const TPose2D& pose, double clutter, std::uint64_t seed) {
  testing::Dice dice(seed);
  std::vector<Eigen::Vector2f> points;
  for (int i = -90; i <= 90; ++i) {
    const double angle = i * kDegree;
    double range = plan.distanceToWall({pose.x, pose.y}, {std::cos(pose.phi + angle), std::sin(pose.phi + angle)}) +
                   dice.normal(0.01);
    if (dice.uniform(0, 1) < clutter) range = dice.uniform(0.3, 8);
    if (range < 12) points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

TEST(PointToLineMatcher, MatchesThoughThreeTenthsOfBothScansAreClutter) {
  const auto plan = FloorPlan::ring();
  const TPose2D motion(0.3, 0.05, 0.1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto reference = fitLines(beams(plan, {0, 0, 0}, 0.3, 2 * seed)),
               scan = fitLines(beams(plan, motion, 0.3, 2 * seed + 1));
    expectNear(match(reference, scan, motion + TPose2D(0.1, -0.1, 4 * kDegree)).reference_from_scan, motion, 0.08,
               2.5 * kDegree);
  }
}

TEST(PointToLineMatcher, FindsItsWayFromAMetreAndTwentyDegreesAway) {
  const auto plan = FloorPlan::box();
  const auto reference = scanFrom(plan, {0, 0, 0}, 0.01, 1), scan = scanFrom(plan, {0.2, 0.1, 0.1}, 0.01, 2);
  for (const TPose2D offset : {TPose2D(0.9, 0, 0), TPose2D(0, 0.9, 0), TPose2D(-0.6, 0.6, -20 * kDegree)}) {
    expectNear(match(reference, scan, TPose2D(0.2, 0.1, 0.1) + offset).reference_from_scan, {0.2, 0.1, 0.1}, 0.02,
               0.5 * kDegree);
  }
}

TEST(PointToLineMatcher, ARoundRoomLeavesTheHeadingOpen) {
  FloorPlan room;
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 720; ++i) corners.emplace_back(3 * std::cos(i * kDegree / 2), 3 * std::sin(i * kDegree / 2));
  room.addPolygon(corners);
  const auto found =
      match(scanFrom(room, {0, 0, 0}, 0.002, 1), scanFrom(room, {0.1, 0, 0.2}, 0.002, 2), {0.05, 0.02, 0.15});
  EXPECT_TRUE(found.degenerate);
  // The room leaves open a rotation about its middle, which lies behind the sensor by as much as the sensor moved.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(found.unit_covariance);
  EXPECT_GT(std::abs(eigen.eigenvectors()(2, 2)), 0.9);
}

TEST(PointToLineMatcher, ACorridorIsDegenerateAndARoomIsNot) {
  FloorPlan corridor;
  corridor.addPolygon({{-60, -1.5}, {60, -1.5}, {60, 1.5}, {-60, 1.5}});
  EXPECT_TRUE(
      match(scanFrom(corridor, {0, 0, 0}, 0.005, 1, 8), scanFrom(corridor, {0.5, 0, 0}, 0.005, 2, 8), {}).degenerate);
  EXPECT_FALSE(
      match(scanFrom(FloorPlan::box(), {0, 0, 0}, 0.005, 1), scanFrom(FloorPlan::box(), {0.1, 0, 0}, 0.005, 2), {})
          .degenerate);
}

TEST(PointToLineMatcher, FewPointsAreMatchedOrSaidToBeOpen) {
  const auto room = scanFrom(FloorPlan::box(), {0, 0, 0});
  for (int count = 1; count <= 5; ++count) {
    std::vector<Eigen::Vector2f> few(room.points.begin(), room.points.begin() + count);
    const auto found = match(room, fitLines(few), {0.05, 0.02, 0.01});
    EXPECT_TRUE(
        std::isfinite(found.reference_from_scan.x + found.reference_from_scan.y + found.reference_from_scan.phi));
    EXPECT_TRUE(found.degenerate) << count << " points on one wall";
    EXPECT_TRUE(match(fitLines(few), room, {}).reference_from_scan.x < 1) << count;
  }
}

TEST(PointToLineMatcher, APoseThatIsNoNumberFindsNoCorrespondences) {
  const auto room = scanFrom(FloorPlan::box(), {0, 0, 0});
  EXPECT_EQ(match(room, room, {NAN, 0, 0}).overlap, 0);
  EXPECT_EQ(match(room, room, {1e30, 0, 0}).overlap, 0);
}

mrpt::maps::CSimplePointsMap mapOf(const std::vector<Eigen::Vector2f>& points) {
  mrpt::maps::CSimplePointsMap map;
  for (const auto& p : points) map.insertPoint(p.x(), p.y(), 0);
  return map;
}

TEST(PointToLineMatcher, AlignsPointMapsThroughTheInterfaceOfMrpt) {
  const TPose2D truth(0.2, 0.1, 90 * kDegree);
  const auto m1 = mapOf(beams(FloorPlan::box(), {0, 0, 80 * kDegree}, 0, 1)),
             m2 = mapOf(beams(FloorPlan::box(), TPose2D(0, 0, 80 * kDegree) + truth, 0, 2));
  PointToLineMatcher matcher(ScanMatcherOptions{});
  mrpt::slam::CMetricMapsAlignmentAlgorithm& algorithm = matcher;
  const auto pdf = algorithm.Align(&m1, &m2, mrpt::poses::CPose2D(0.1, 0.15, 85 * kDegree));
  expectNear(pdf->getMeanVal().asTPose(), truth, 0.03, 0.5 * kDegree);
  const auto [covariance, mean] = pdf->getCovarianceAndMean();
  EXPECT_GT(covariance(0, 0), 1e-8);
  EXPECT_LT(covariance(0, 0), 1e-2);
  EXPECT_LT(covariance(2, 2), 1e-3);
}

TEST(PointToLineMatcher, TheOpenDirectionOfACorridorIsInTheFrameOfTheFirstMap) {
  FloorPlan corridor;
  corridor.addPolygon({{-60, -1.5}, {60, -1.5}, {60, 1.5}, {-60, 1.5}});
  const auto near = [&](const TPose2D& pose, std::uint64_t seed) {
    auto points = beams(corridor, pose, 0, seed);
    points.erase(std::remove_if(points.begin(), points.end(), [](const auto& p) { return p.norm() > 8; }),
                 points.end());
    return mapOf(points);
  };
  const auto m1 = near({0, 0, 0}, 1), m2 = near({0.2, 0, 1}, 2);  // m2 is turned: its own x is not along the corridor
  PointToLineMatcher matcher(ScanMatcherOptions{});
  const auto pdf = matcher.Align(&m1, &m2, mrpt::poses::CPose2D(0.1, 0, 1));
  const auto [covariance, mean] = pdf->getCovarianceAndMean();
  EXPECT_GT(covariance(0, 0), 1000 * covariance(1, 1));
}

TEST(PointToLineMatcher, RefusesMapsThatAreNotOfPoints) {
  PointToLineMatcher matcher(ScanMatcherOptions{});
  const mrpt::maps::COccupancyGridMap2D grid;
  const auto points = mapOf({{1, 2}});
  EXPECT_THROW(matcher.Align(&grid, &points, mrpt::poses::CPose2D()), base::Error);
  EXPECT_THROW(matcher.Align3D(&points, &points, mrpt::poses::CPose3D()), base::Error);
}

}  // namespace
}  // namespace omnimapper::matching::point_to_line_matcher_test
