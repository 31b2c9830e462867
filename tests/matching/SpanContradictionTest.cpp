#include <gtest/gtest.h>
#include <omnimapper/matching/SpanContradiction.h>
#include <omnimapper/testing/SimulatedLog.h>

namespace omnimapper::matching::span_contradiction_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

const Matrix2d kCovariance = 1e-4 * Matrix2d::Identity();  // 1 cm

TEST(SpanContradiction, RandomErrorsDoNotContradict) {
  testing::Dice dice(1);
  SpanContradiction test;
  for (int i = 0; i < 600; ++i)
    EXPECT_TRUE(test.add(0.1 * i, {dice.normal(0.01), dice.normal(0.01)}, kCovariance).isZero()) << i;
  EXPECT_EQ(test.contradictedSeconds(), 0);
}

// Less than a standard deviation each time, but always backwards: 8 mm at 10 Hz are 0.64 m in 8 s, where random errors
// of 1 cm make 9 cm.
TEST(SpanContradiction, SmallErrorsOfOneSignAddUp) {
  SpanContradiction test;
  Matrix2d covered = Matrix2d::Zero();
  for (int i = 0; i < 200; ++i) covered += test.add(0.1 * i, {-0.008, 0}, kCovariance);
  EXPECT_GT(test.contradictedSeconds(), 10);
  EXPECT_GT(test.firstSeconds(), 1);
  EXPECT_LT(test.firstSeconds(), 8.1);
  EXPECT_NEAR(test.largest(), 0.64, 0.01);
  EXPECT_GT(std::sqrt(covered(0, 0)), 0.3) << "of 1.6 m in 20 s";
  EXPECT_EQ(covered(1, 1), 0);
}

TEST(SpanContradiction, ASlipContradictsAtOnceAndForNoLongerThanItsSpan) {
  SpanContradiction test;
  for (int i = 0; i < 20; ++i) test.add(0.1 * i, {0, 0}, kCovariance);
  EXPECT_NEAR(test.add(2.0, {0.3, 0}, kCovariance)(0, 0), 0.3 * 0.3 * 0.1 / 0.5, 1e-9) << "by the span of 0.5 s";
  EXPECT_DOUBLE_EQ(test.firstSeconds(), 2.0);
  for (int i = 21; i < 120; ++i) test.add(0.1 * i, {0, 0}, kCovariance);
  EXPECT_TRUE(test.add(12.0, {0, 0}, kCovariance).isZero());
  EXPECT_LT(test.contradictedSeconds(), 8.1);
}

}  // namespace
}  // namespace omnimapper::matching::span_contradiction_test
