#include <gtest/gtest.h>
#include <omnimapper/matching/Things.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::matching::things_test {
namespace {

using Eigen::Vector2f;
constexpr int kWall = ScanWithNormals::kNoThing;
const Vector2f kLaser(0, 0);

// A wall 3 m ahead from y = -2 to 2 m, a point every 10 cm, with a leg of three points 1 m ahead instead of the wall
// between y = -0.2 and 0.2.
std::vector<Vector2f> legBeforeWall() {
  std::vector<Vector2f> points;
  for (int i = -20; i <= 20; ++i) {
    if (std::abs(i) > 2) points.emplace_back(3, 0.1F * static_cast<float>(i));
    if (i == 0) {
      for (const float y : {-0.05F, 0.0F, 0.05F}) points.emplace_back(1, y);
    }
  }
  return points;
}

TEST(Things, ALegBeforeAWallIsAThing) {
  const auto points = legBeforeWall();
  const auto things = numberThings(points, kLaser, rangeNoise(points));
  ASSERT_EQ(things.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(things[i], points[i].x() < 2 ? 0 : kWall) << i;
}

TEST(Things, TwoLegsAreTwoThings) {
  auto points = legBeforeWall();
  for (auto& point : points) {
    if (point.x() > 2 && std::abs(point.y() - 1) < 0.11F) point = point / 3;  // nearer, on the same beams
  }
  const auto things = numberThings(points, kLaser, rangeNoise(points));
  EXPECT_EQ(*std::max_element(things.begin(), things.end()), 1);
}

TEST(Things, APieceOfWallBetweenTwoThingsIsNone) {
  std::vector<Vector2f> points;
  for (int i = -3; i <= 3; ++i) points.emplace_back(1, -0.5F + 0.02F * static_cast<float>(i));
  for (int i = -3; i <= 3; ++i) points.emplace_back(3, 0.1F * static_cast<float>(i));
  for (int i = -3; i <= 3; ++i) points.emplace_back(1, 0.5F + 0.02F * static_cast<float>(i));
  const auto things = numberThings(points, kLaser, rangeNoise(points));
  EXPECT_EQ(things.front(), 0);
  EXPECT_EQ(things[10], kWall);
  EXPECT_EQ(things.back(), 1);
}

// Half a degree from beam to beam, along a wall 1.2 m beside the laser: the last beams end 6 m apart.
TEST(Things, BeamsFarAlongAWallAreNone) {
  std::vector<Vector2f> points;
  for (int i = 5; i <= 120; ++i) {
    const double angle = 0.5 * i * 3.14159265358979 / 180;
    points.emplace_back(1.2 / std::tan(angle), 1.2);
  }
  for (const int thing : numberThings(points, kLaser, rangeNoise(points))) EXPECT_EQ(thing, kWall);
  std::reverse(points.begin(), points.end());
  for (auto& point : points) point.y() = -1.2F;
  for (const int thing : numberThings(points, kLaser, rangeNoise(points))) EXPECT_EQ(thing, kWall);
}

TEST(Things, AWideThingIsAWallAndANoisyScanHasNone) {
  std::vector<Vector2f> wide;
  for (int i = 0; i <= 30; ++i) wide.emplace_back(1, 0.05F * static_cast<float>(i));
  for (const int thing : numberThings(wide, kLaser, rangeNoise(wide))) EXPECT_EQ(thing, kWall);
  testing::Dice dice(1);
  auto noisy = legBeforeWall();
  for (auto& point : noisy) point.x() += static_cast<float>(dice.normal(0.2));
  for (const int thing : numberThings(noisy, kLaser, rangeNoise(noisy))) EXPECT_EQ(thing, kWall);
}

TEST(Things, NothingAndASinglePointHaveAnAnswer) {
  EXPECT_TRUE(numberThings({}, kLaser, 0).empty());
  EXPECT_EQ(numberThings({{1, 0}}, kLaser, 0).size(), 1U);
}

}  // namespace
}  // namespace omnimapper::matching::things_test
