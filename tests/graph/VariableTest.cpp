#include <gtest/gtest.h>

#include "Worlds.h"
#include "omnimapper/graph/PlacedVariable.h"
#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph::variable_test {
namespace {

struct Case {
  std::shared_ptr<const Variable> kind;
  Eigen::VectorXd x, y;
  Eigen::VectorXd delta;
};

class VariableTest : public ::testing::TestWithParam<const char*> {
 protected:
  Case draw() {
    const std::string name = GetParam();
    Case c;
    if (name == "se2") c = {se2(), toValue(noise_.se2()), toValue(noise_.se2()), noise_.vector(3)};
    if (name == "se3") {
      c = {se3(), toValue(noise_.se3()), toValue(noise_.se3()), Eigen::VectorXd(6)};
      c.delta << noise_.vector(3), noise_.vector(1.7);
    }
    if (name == "point2")
      c = {point2(), noise_.vector(5).head<2>(), noise_.vector(5).head<2>(), noise_.vector(5).head<2>()};
    if (name == "point3") c = {point3(), noise_.vector(5), noise_.vector(5), noise_.vector(5)};
    return c;
  }
  static Eigen::VectorXd plus(const Variable& kind, const Eigen::VectorXd& x, const Eigen::VectorXd& delta) {
    Eigen::VectorXd y(kind.ambientSize());
    kind.plus(x.data(), delta.data(), y.data());
    return y;
  }
  static Eigen::VectorXd minus(const Variable& kind, const Eigen::VectorXd& y, const Eigen::VectorXd& x) {
    Eigen::VectorXd delta(kind.tangentSize());
    kind.minus(y.data(), x.data(), delta.data());
    return delta;
  }
  Noise noise_{1};
};

TEST_P(VariableTest, SizesAndNameAreThoseOfTheKind) {
  const Case c = draw();
  EXPECT_EQ(c.kind->kind(), GetParam());
  EXPECT_EQ(c.kind->ambientSize(), c.x.size());
  EXPECT_EQ(c.kind->tangentSize(), c.delta.size());
}

TEST_P(VariableTest, PlusZeroStays) {
  const Case c = draw();
  EXPECT_LT((plus(*c.kind, c.x, 0 * c.delta) - c.x).norm(), 1e-14);
}

TEST_P(VariableTest, MinusItselfIsZero) {
  const Case c = draw();
  EXPECT_LT(minus(*c.kind, c.x, c.x).norm(), 1e-14);
}

TEST_P(VariableTest, MinusUndoesPlusAndPlusUndoesMinus) {
  for (int i = 0; i < 50; ++i) {
    const Case c = draw();
    EXPECT_LT((minus(*c.kind, plus(*c.kind, c.x, c.delta), c.x) - c.delta).norm(), 2e-14);
    const Eigen::VectorXd reached = plus(*c.kind, c.x, minus(*c.kind, c.y, c.x));
    EXPECT_LT(minus(*c.kind, reached, c.y).norm(), 2e-14);
  }
}

TEST_P(VariableTest, MovedThereAndBackIsWhereItWas) {
  const auto& kind = dynamic_cast<const PlacedVariable&>(*draw().kind);
  for (int i = 0; i < 20; ++i) {
    const Case c = draw();
    const Eigen::Vector3d by = noise_.vector(3);
    const geometry::Se3 there{Eigen::Quaterniond(Eigen::AngleAxisd(by.z(), Eigen::Vector3d::UnitZ())),
                              {by.x(), by.y(), 0}};
    Eigen::VectorXd moved = c.x;
    kind.move(there, moved.data(), moved.data());
    EXPECT_GT((moved - c.x).norm(), 1e-3);
    kind.move(inverse(there), moved.data(), moved.data());
    EXPECT_LT(minus(kind, moved, c.x).norm(), 1e-12);
  }
}

TEST(PlacedVariable, APointAndAPoseAreTurnedAndShiftedTogether) {
  const geometry::Se3 by{Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())), {10, 5, 0}};
  Eigen::Vector2d point(3, 1);
  Eigen::Vector3d pose(3, 1, M_PI);
  dynamic_cast<const PlacedVariable&>(*point2()).move(by, point.data(), point.data());
  dynamic_cast<const PlacedVariable&>(*se2()).move(by, pose.data(), pose.data());
  EXPECT_LT((point - Eigen::Vector2d(9, 8)).norm(), 1e-12);
  EXPECT_LT((pose - Eigen::Vector3d(9, 8, -M_PI / 2)).norm(), 1e-12);
}

TEST_P(VariableTest, PlusInPlaceIsPlus) {
  const Case c = draw();
  Eigen::VectorXd x = c.x;
  c.kind->plus(x.data(), c.delta.data(), x.data());
  EXPECT_EQ(x, plus(*c.kind, c.x, c.delta));
}

TEST_P(VariableTest, TheTangentAtZeroMovesAtUnitSpeed) {
  const Case c = draw();
  const double h = 1e-7;
  for (int i = 0; i < c.kind->tangentSize(); ++i) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(c.kind->tangentSize(), i);
    EXPECT_LT((minus(*c.kind, plus(*c.kind, c.x, step), c.x) / h - step / h).norm(), 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, VariableTest, ::testing::Values("se2", "se3", "point2", "point3"));

TEST(VariableKinds, RotationsStayOfUnitLengthOverManySteps) {
  Eigen::VectorXd x = toValue(Se3{});
  const Eigen::VectorXd delta = (Eigen::VectorXd(6) << 0.1, 0.2, -0.1, 0.3, -0.2, 0.5).finished();
  for (int i = 0; i < 10000; ++i) se3()->plus(x.data(), delta.data(), x.data());
  EXPECT_NEAR(x.tail<4>().norm(), 1, 1e-14);
}

TEST(VariableKinds, YawStaysWithinHalfATurn) {
  Eigen::VectorXd x = toValue(Se2{0, 0, 3});
  const Eigen::Vector3d delta(0, 0, 0.5);
  se2()->plus(x.data(), delta.data(), x.data());
  EXPECT_NEAR(x[2], 3.5 - 2 * geometry::kPi, 1e-15);
}

}  // namespace
}  // namespace omnimapper::graph::variable_test
