#include <camera/Wear.h>
#include <gtest/gtest.h>

#include <cmath>

#include "SmallWorlds.h"

namespace wear_test {
namespace {

using namespace omnimapper;

constexpr float kNear = 0.002f;  // side of a pixel on the wall [m]

struct Statistics {
  double mean = 0, sigma = 0;
};

sim::World wallWithWear(double wear, std::uint64_t seed = 1) {
  sim::World world;
  world.seed = seed;
  world.wear = wear;
  small_worlds::addWall(world, "wall", {0, 0}, {8, 0});
  return world;
}

// Over a wall of 8 m x 2.5 m.
Statistics brightnessOf(const sim::Wear& wear, float pixel_side) {
  double sum = 0, squares = 0;
  int count = 0;
  for (float x = 0; x < 8; x += 0.013f) {
    for (float z = 0; z < 2.5f; z += 0.013f, ++count) {
      const double factor = wear.factorAt(0, {x, 0, z}, pixel_side);
      sum += factor;
      squares += factor * factor;
    }
  }
  return {sum / count, std::sqrt(squares / count - sum * sum / count / count)};
}

TEST(Wear, changesNothingOfWhatIsNew) {
  const sim::World world = wallWithWear(0);
  EXPECT_EQ(sim::Wear(world).factorAt(0, {1, 0, 1}, kNear), 1);
}

TEST(Wear, isTheStandardDeviationOfBrightness) {
  for (const double wear : {0.02, 0.08, 0.16}) {
    const sim::World world = wallWithWear(wear);
    const Statistics brightness = brightnessOf(sim::Wear(world), kNear);
    EXPECT_NEAR(brightness.mean, 1, 0.2 * wear);
    EXPECT_NEAR(brightness.sigma, wear, 0.1 * wear);
  }
}

TEST(Wear, averagesAwayWhatIsFinerThanAPixel) {
  const sim::World world = wallWithWear(0.1);
  const sim::Wear wear(world);
  const double near = brightnessOf(wear, kNear).sigma, far = brightnessOf(wear, 0.1f).sigma;
  EXPECT_LT(far, 0.8 * near);
  EXPECT_GT(far, 0.2 * near);
  EXPECT_EQ(brightnessOf(wear, 1).sigma, 0);
}

TEST(Wear, repeatsNowhere) {
  const sim::World world = wallWithWear(0.1);
  const sim::Wear wear(world);
  for (const float shift : {0.5f, 0.8f, 1.0f, 1.2f, 2.0f}) {
    double product = 0, square = 0;
    for (float x = 0; x < 5; x += 0.01f) {
      const double here = wear.factorAt(0, {x, 0, 1}, kNear) - 1,
                   there = wear.factorAt(0, {x + shift, 0, 1}, kNear) - 1;
      product += here * there;
      square += here * here;
    }
    EXPECT_LT(std::abs(product), 0.4 * square) << shift;
  }
}

TEST(Wear, comesFromTheSeed) {
  const sim::World one = wallWithWear(0.1, 1), again = wallWithWear(0.1, 1), two = wallWithWear(0.1, 2);
  const Eigen::Vector3f place(1.23f, 0, 0.77f);
  EXPECT_EQ(sim::Wear(one).factorAt(0, place, kNear), sim::Wear(again).factorAt(0, place, kNear));
  EXPECT_NE(sim::Wear(one).factorAt(0, place, kNear), sim::Wear(two).factorAt(0, place, kNear));
}

TEST(Wear, leavesAloneWhatMovesAndWhatIsToBeRead) {
  sim::World world = wallWithWear(0.1);
  small_worlds::addQuad(world, "sign", sim::SurfaceKind::sign, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  small_worlds::addQuad(world, "box", sim::SurfaceKind::object, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  world.bodies.back().track =
      sim::Track(sim::Track::Kind::steps, {{0, small_worlds::at(0, 0)}, {10, small_worlds::at(1, 0)}});
  sim::Material glass;
  glass.transmission = 0.9f;
  small_worlds::addQuad(world, "pane", sim::SurfaceKind::window, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, glass);
  const sim::Wear wear(world);
  const Eigen::Vector3f place(0.31f, 0, 0.47f);
  EXPECT_NE(wear.factorAt(0, place, kNear), 1);
  for (const int surface : {1, 2, 3}) EXPECT_EQ(wear.factorAt(surface, place, kNear), 1) << surface;
}

}  // namespace
}  // namespace wear_test
