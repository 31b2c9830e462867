#include <gtest/gtest.h>
#include <omnimapper/sim_world/Random.h>

#include <cmath>

namespace random_test {
namespace {

using namespace omnimapper;

TEST(Random, namesMakeTheStream) {
  sim::Random a(7, {1, 2}), b(7, {1, 2}), c(7, {2, 1}), d(8, {1, 2});
  EXPECT_EQ(a.bits(), b.bits());
  EXPECT_NE(sim::Random(7, {1, 2}).bits(), c.bits());
  EXPECT_NE(sim::Random(7, {1, 2}).bits(), d.bits());
}

TEST(Random, momentsAreThoseOfTheirDistributions) {
  sim::Random random(1, {});
  double sum = 0, squares = 0, fourth = 0, flat = 0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double g = random.gaussian();
    sum += g, squares += g * g, fourth += g * g * g * g;
    flat += random.uniform();
  }
  EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2.0 / count));
  EXPECT_NEAR(fourth / count, 3, 4 * std::sqrt(96.0 / count));
  EXPECT_NEAR(flat / count, 0.5, 4 / std::sqrt(12.0 * count));
}

}  // namespace
}  // namespace random_test
