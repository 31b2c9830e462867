#include <gtest/gtest.h>

#include "Scans.h"

namespace omnimapper::matching::planar_scan_test {
namespace {

using Eigen::Vector2f;

Vector2f pointOf(const ScanWithNormals& scan, std::size_t i) {
  return scan.points[i];
}

// Points every 5 cm along x at y = 2, with noise across.
std::vector<Vector2f> wall(int count, double sigma) {
  testing::Dice dice(1);
  std::vector<Vector2f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(0.05 * i, 2 + dice.normal(sigma));
  return points;
}

// As in a scan whose beams all have the same direction.
TEST(ScanWithNormals, PointsThatAreAllOneStayFinite) {
  for (const Vector2f& point : {Vector2f(0, 0), Vector2f(2, 0), Vector2f(2, 1)}) {
    const auto scan = fitLines(std::vector<Vector2f>(60, point));
    for (std::size_t i = 0; i < scan.size(); ++i) {
      EXPECT_TRUE(scan.normals[i].allFinite());
      EXPECT_NEAR((scan.points[i] - point).norm(), 0, 1e-5);
    }
  }
}

TEST(ScanWithNormals, PointsOfAWallGetItsNormal) {
  const auto scan = fitLines(wall(60, 0));
  ASSERT_EQ(scan.size(), 60U);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(std::abs(scan.normals[i].y()), 1, 1e-5);
    EXPECT_NEAR(pointOf(scan, i).y(), 2, 1e-5);
  }
}

TEST(ScanWithNormals, ANoisyWallBecomesThinner) {
  const double sigma = 0.03;
  const auto raw = wall(100, sigma);
  const auto scan = fitLines(raw);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_GT(std::abs(scan.normals[i].y()), std::cos(0.35)) << "point " << i;
    before += std::pow(raw[i].y() - 2, 2);
    after += std::pow(pointOf(scan, i).y() - 2, 2);
  }
  EXPECT_LT(std::sqrt(after), 0.6 * std::sqrt(before));
}

TEST(ScanWithNormals, ACleanCornerStaysSharp) {
  std::vector<Vector2f> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.05 * i, 0);
  for (int i = 1; i < 20; ++i) points.emplace_back(0.95, 0.05 * i);
  const auto scan = fitLines(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((pointOf(scan, i) - points[i]).norm(), 0.03) << i;
  EXPECT_NEAR(std::abs(scan.normals[10].y()), 1, 1e-3);
  EXPECT_NEAR(std::abs(scan.normals[28].x()), 1, 1e-3);
}

TEST(ScanWithNormals, PointsByThemselvesHaveNoNormalAndStayWhereTheyAre) {
  const std::vector<Vector2f> apart{{0, 0}, {3, 0}, {6, 1}, {9, -2}};
  const auto scan = fitLines(apart);
  ASSERT_EQ(scan.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(scan.normals[i].isZero());
    EXPECT_EQ(pointOf(scan, i), apart[i]);
  }
  EXPECT_TRUE(fitLines({}).empty());
  EXPECT_EQ(fitLines({{1, 2}}).size(), 1U);
}

// Beams of half a degree along a corridor of 2.4 m: from 12 m on they end over 0.6 m apart on its walls.
TEST(ScanWithNormals, AWallThatIsSeenAlongItsLengthHasItsNormalFarAway) {
  std::vector<Vector2f> points;
  for (int i = 6; i <= 120; ++i) {
    const double angle = 0.5 * i * 3.14159265358979 / 180;
    points.emplace_back(1.2 / std::tan(angle), 1.2);
  }
  const auto scan = fitLines(points);
  EXPECT_GT((points[1] - points[0]).norm(), 1.5F) << "the farthest two";
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(std::abs(scan.normals[i].y()), 1, 1e-3) << i;
  auto bent = points;
  bent[1].y() += 0.3F;
  EXPECT_TRUE(fitLines(bent).normals[1].isZero()) << "no line without its neighbours";
}

TEST(ScanWithNormals, WithoutAndNeighboursKeepWhatIsKnownOfThePoints) {
  auto scan = fitLines(wall(10, 0));
  scan.things.assign(10, ScanWithNormals::kNoThing);
  scan.things[3] = 7;
  scan.weights.assign(10, 0.5F);
  std::vector<bool> marked(10, false);
  marked[4] = true;
  const auto kept = without(marked, scan);
  ASSERT_EQ(kept.size(), 9U);
  EXPECT_EQ(kept.things[3], 7);
  EXPECT_EQ(kept.weights.size(), 9U);
  const auto wider = withNeighbours(marked, scan);
  EXPECT_EQ(wider, (std::vector<bool>{true, true, true, true, true, true, true, true, true, false}));
}

TEST(ScanWithNormals, AppendingMovesPointsAndTurnsNormals) {
  const auto scan = fitLines(wall(10, 0));
  ScanWithNormals both = scan;
  append(scan, mrpt::math::TPose2D(1, -1, 3.14159265358979323846 / 2), both);
  ASSERT_EQ(both.size(), 20U);
  ASSERT_EQ(both.points.size(), 20U);
  for (std::size_t i = 0; i < 10; ++i) {
    const Vector2f p = pointOf(scan, i);
    EXPECT_LT((pointOf(both, i) - p).norm(), 1e-6);
    EXPECT_LT((pointOf(both, 10 + i) - Vector2f(1 - p.y(), -1 + p.x())).norm(), 1e-5);
    EXPECT_NEAR(std::abs(both.normals[10 + i].x()), 1, 1e-5);
  }
}

TEST(ScanWithNormals, OncePerCellKeepsTheFirstPointOfEach) {
  ScanWithNormals scan;
  scan.points = {{0.01F, 0.01F}, {0.09F, 0.09F}, {0.11F, 0.01F}, {-0.01F, 0.01F}, {0.05F, 0.02F}};
  scan.normals = {{1, 0}, {0, 1}, {0, 0}, {0, -1}, {1, 0}};
  const auto kept = voxelDownsample(scan, 0.1);
  EXPECT_EQ(kept.points, (std::vector<Vector2f>{{0.01F, 0.01F}, {0.11F, 0.01F}, {-0.01F, 0.01F}}));
  EXPECT_EQ(kept.normals, (std::vector<Vector2f>{{1, 0}, {0, 0}, {0, -1}}));
  EXPECT_TRUE(voxelDownsample({}, 0.1).empty());
}

}  // namespace
}  // namespace omnimapper::matching::planar_scan_test
