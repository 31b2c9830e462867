#include <gtest/gtest.h>
#include <omnimapper/geometry/Simplify.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omnimapper::geometry::simplify_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Indices = std::vector<std::size_t>;

TEST(Simplify, KeepsOfALineItsEndsAndWhatIsFarFromBetweenThem) {
  EXPECT_EQ(keptOfLine({{0, 0}, {1, 0.1}, {2, 0.9}, {3, 0.1}, {4, 0}}, 0.5), (Indices{0, 2, 4}));
  EXPECT_EQ(keptOfLine({{0, 0}, {1, 0.1}, {2, 0.4}, {3, 0.1}, {4, 0}}, 0.5), (Indices{0, 4}));
  EXPECT_EQ(keptOfLine({}, 1), Indices{});
  EXPECT_EQ(keptOfLine({{1, 1}}, 1), Indices{0});
}

TEST(Simplify, MeasuresFromTheStretchAndNotFromTheLineThroughIt) {
  EXPECT_EQ(keptOfLine({{0, 0}, {9, 0}, {1, 0}}, 0.5), (Indices{0, 1, 2}));
}

TEST(Simplify, KeepsTheEndsOfALineThatComesBack) {
  EXPECT_EQ(keptOfLine({{0, 0}, {2, 0}, {0, 0}}, 0.5), (Indices{0, 1, 2}));
  EXPECT_EQ(keptOfLine({{0, 0}, {0.2, 0}, {0, 0}}, 0.5), (Indices{0, 2}));
}

TEST(Simplify, LeavesOfASquareItsCornersWhicheverOfThemIsFirst) {
  Points square;
  for (int i = 0; i < 40; ++i) {
    const double along = i % 10, rough = i % 2 == 0 ? 0 : 0.1;
    const Points sides = {{along, rough}, {10 - rough, along}, {10 - along, 10 - rough}, {rough, 10 - along}};
    square.push_back(sides[static_cast<std::size_t>(i) / 10]);
  }
  for (std::size_t begin = 0; begin < 40; begin += 10) {
    std::rotate(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(begin), square.end());
    EXPECT_EQ(keptOfLoop(square, 0.5), (Indices{0, 10, 20, 30}));
  }
}

TEST(Simplify, LeavesNothingOutThatIsFartherThanTheTolerance) {
  constexpr double kPi = 3.14159265358979, kTolerance = 0.01;
  Points circle;
  for (int i = 0; i < 1000; ++i) circle.emplace_back(std::cos(2 * kPi * i / 1000), std::sin(2 * kPi * i / 1000));
  const auto kept = keptOfLoop(circle, kTolerance);
  // A chord of n equal ones is 1 - cos(pi / n) from the circle: 23 are enough, and halving gives at most 32.
  EXPECT_GE(kept.size(), 23U);
  EXPECT_LE(kept.size(), 32U);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Eigen::Vector2d middle = (circle[kept[i]] + circle[kept[(i + 1) % kept.size()]]) / 2;
    EXPECT_GE(middle.norm(), 1 - kTolerance);
  }
}

TEST(Simplify, KeepsALoopThatWouldVanish) {
  const Points thin = {{0, 0}, {1, 0.001}, {2, 0}, {1, -0.001}};
  Indices all(thin.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(keptOfLoop(thin, 0.1), all);
  EXPECT_EQ(keptOfLoop({{0, 0}, {1, 0}, {1, 1}}, 5), (Indices{0, 1, 2}));
  EXPECT_EQ(keptOfLoop(thin, 0), all);
}

}  // namespace
}  // namespace omnimapper::geometry::simplify_test
