#include <gtest/gtest.h>
#include <omnimapper/graph/ChiSquare.h>

#include <cmath>
#include <stdexcept>

namespace omnimapper::graph::chi_square_test {
namespace {

TEST(ChiSquare, OfTwoDegreesTheQuantileIsALogarithm) {
  for (const double probability : {0.01, 0.5, 0.95, 0.999999999})
    EXPECT_NEAR(chiSquareQuantile(probability, 2), -2 * std::log1p(-probability), 1e-9) << probability;
}

// Abramowitz and Stegun, Handbook of Mathematical Functions, table 26.8.
TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 1), 3.84146, 5e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 6), 16.8119, 5e-5);
  EXPECT_NEAR(chiSquareQuantile(0.999, 30), 59.703, 5e-4);
  EXPECT_NEAR(chiSquareQuantile(0.95, 100), 124.342, 5e-4);
}

TEST(ChiSquare, OfNoDegreeOrACertaintyThereIsNone) {
  EXPECT_THROW(chiSquareQuantile(0.95, 0), std::domain_error);
  EXPECT_THROW(chiSquareQuantile(-0.1, 3), std::domain_error);
  EXPECT_THROW(chiSquareQuantile(1, 3), std::overflow_error);
}

}  // namespace
}  // namespace omnimapper::graph::chi_square_test
