#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/grid/LikelihoodPyramid.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <limits>

namespace omnimapper::grid::likelihood_pyramid_test {
namespace {

std::vector<Eigen::Vector2f> randomPoints(std::uint64_t seed, int count, double size) {
  testing::Dice dice(seed);
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(dice.uniform(-size, size), dice.uniform(-size, size) / 2);
  return points;
}

TEST(LikelihoodPyramid, IsABellAroundEachPoint) {
  LikelihoodOptions options;
  options.cell = 0.1;
  options.sigma = 0.1;
  const LikelihoodPyramid map({{1, 2}}, options);
  const int x = static_cast<int>((1 - map.origin().x()) / 0.1), y = static_cast<int>((2 - map.origin().y()) / 0.1);
  EXPECT_EQ(map.at(x, y), 255);
  EXPECT_EQ(map.at(x + 1, y), 155) << "255 exp(-1/2)";
  EXPECT_EQ(map.at(x, y - 2), 35) << "255 exp(-2)";
  EXPECT_EQ(map.at(x + 1, y + 1), 94) << "255 exp(-1)";
  EXPECT_EQ(map.at(x + 4, y), 0);
  EXPECT_EQ(map.at(x - 1000000, y), 0);
  EXPECT_NEAR(map.score({{0, 0}, {1, 0}}, {1, 2, 0}), 0.5, 1e-9) << "one point hits, one misses";
  EXPECT_NEAR(map.score({{1, 0}}, {1, 1, std::acos(0.0)}), 1, 1e-9) << "turned to the left, then moved";
}

TEST(LikelihoodPyramid, ABoundIsNoLessThanAnyCellOfItsSquareAndHardlyMoreThanThoseAround) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const LikelihoodPyramid map(randomPoints(seed, 12, 3.0), {});
    for (int level = 0; level < 7; ++level) {
      const int side = 1 << level, stride = std::max(1, side / 4);
      for (int y = -side - 3; y < 80; y += 3) {
        for (int x = -side - 3; x < 150; x += 5) {
          int inside = 0, around = 0;
          for (int v = y - stride + 1; v < y + side + stride - 1; ++v) {
            for (int u = x - stride + 1; u < x + side + stride - 1; ++u) {
              const int value = map.at(u, v);
              around = std::max(around, value);
              if (u >= x && u < x + side && v >= y && v < y + side) inside = std::max(inside, value);
            }
          }
          ASSERT_GE(map.bound(level, x, y), inside) << "level " << level << " at " << x << ", " << y;
          ASSERT_LE(map.bound(level, x, y), around) << "level " << level << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(LikelihoodPyramid, WithoutPointsEverythingIsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& points : {std::vector<Eigen::Vector2f>{}, {{nan, 0}, {0, INFINITY}}}) {
    const LikelihoodPyramid map(points);
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.at(0, 0), 0);
    EXPECT_EQ(map.bound(5, 0, 0), 0);
    EXPECT_EQ(map.score({{0, 0}}, {}), 0);
  }
  EXPECT_EQ(LikelihoodPyramid({{0, 0}}).score({}, {}), 0);
}

TEST(LikelihoodPyramid, PointsThatAreNotFiniteAreLeftOut) {
  const LikelihoodPyramid map({{1, 1}, {NAN, 2}, {INFINITY, 0}, {2, 1}});
  EXPECT_NEAR(map.score({{0, 0}, {1, 0}, {NAN, 0}}, {1, 1, 0}), 1, 1e-9);
}

TEST(LikelihoodPyramid, MemoryIsAFewBytesForEachCell) {
  const LikelihoodPyramid map({{0, 0}, {50, 50}});
  EXPECT_LT(map.bytes(), 5.0 * 1010 * 1010);
}

TEST(LikelihoodPyramid, RefusesWhatItCannotHold) {
  LikelihoodOptions small;
  small.max_cells = 10000;
  EXPECT_THROW(LikelihoodPyramid({{0, 0}, {10, 10}}, small), base::Error);
  EXPECT_THROW(LikelihoodPyramid({{0, 0}, {3e30F, 10}}), base::Error);
  LikelihoodOptions flat;
  flat.cell = 0;
  EXPECT_THROW(LikelihoodPyramid({{0, 0}}, flat), base::Error);
  flat = {};
  flat.sigma = NAN;
  EXPECT_THROW(LikelihoodPyramid({{0, 0}}, flat), base::Error);
}

}  // namespace
}  // namespace omnimapper::grid::likelihood_pyramid_test
