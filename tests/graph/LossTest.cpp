#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include <cmath>

#include "omnimapper/graph/Loss.h"

namespace omnimapper::graph::loss_test {
namespace {

const Loss kLosses[] = {Loss::none(), Loss::huber(1.5), Loss::cauchy(1.5), Loss::tukey(3)};

TEST(Loss, IsTheSquareAtZero) {
  for (const Loss& loss : kLosses) {
    EXPECT_EQ(loss.evaluate(0).rho, 0);
    EXPECT_EQ(loss.evaluate(0).first_derivative, 1);
    EXPECT_NEAR(loss.evaluate(1e-8).rho, 1e-8, 1e-15);
  }
}

TEST(Loss, DerivativesMatchFiniteDifferences) {
  const double h = 1e-5;
  for (const Loss& loss : kLosses)
    for (const double s : {0.1, 1.0, 2.0, 2.5, 8.0, 12.0, 100.0}) {
      const auto before = loss.evaluate(s - h), at = loss.evaluate(s), after = loss.evaluate(s + h);
      EXPECT_NEAR(at.first_derivative, (after.rho - before.rho) / (2 * h), 1e-8) << int(loss.kind()) << ' ' << s;
      EXPECT_NEAR(at.second_derivative, (after.first_derivative - before.first_derivative) / (2 * h), 1e-8)
          << int(loss.kind()) << ' ' << s;
    }
}

TEST(Loss, HandWorkedValues) {
  EXPECT_DOUBLE_EQ(Loss::huber(2).evaluate(9).rho, 8);  // 2 * 2 * 3 - 4
  EXPECT_DOUBLE_EQ(Loss::huber(2).evaluate(4).rho, 4);
  EXPECT_DOUBLE_EQ(Loss::cauchy(1).evaluate(std::exp(1) - 1).rho, 1);
  EXPECT_DOUBLE_EQ(Loss::tukey(3).evaluate(1e9).rho, 3);  // 9 / 3
  EXPECT_DOUBLE_EQ(Loss::none().evaluate(7).rho, 7);
}

TEST(Loss, TurnsOverWithoutASteep) {
  // Continuous where the pieces meet.
  EXPECT_NEAR(Loss::huber(2).evaluate(4 + 1e-9).rho, 4, 1e-8);
  EXPECT_NEAR(Loss::tukey(3).evaluate(9 - 1e-9).rho, 3, 1e-8);
}

TEST(Loss, RefusesAScaleThatIsNone) {
  EXPECT_THROW(Loss::huber(0), base::Error);
  EXPECT_THROW(Loss::cauchy(-1), base::Error);
  EXPECT_THROW(Loss::tukey(std::nan("")), base::Error);
  EXPECT_THROW(Loss(static_cast<Loss::Kind>(4), 1), base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::loss_test
