#include <gtest/gtest.h>
#include <omnimapper/geometry/PlaneTangent.h>

#include <random>

namespace omnimapper::geometry::plane_tangent_test {
namespace {

Eigen::Vector3d drawn(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  return {normal(engine), normal(engine), normal(engine)};
}

TEST(PlaneTangent, BasisAsWorkedByHand) {
  // UnitZ has the same smallest component along x and y, so the first one is taken.
  const auto up = tangentBasis(Eigen::Vector3d::UnitZ());
  EXPECT_EQ(up.col(0), Eigen::Vector3d::UnitX());
  EXPECT_EQ(up.col(1), Eigen::Vector3d::UnitY());
  const auto left = tangentBasis(Eigen::Vector3d::UnitX());
  EXPECT_EQ(left.col(0), Eigen::Vector3d::UnitY());
  EXPECT_EQ(left.col(1), Eigen::Vector3d::UnitZ());
  const auto tilted = tangentBasis(Eigen::Vector3d(0.6, 0, 0.8));
  EXPECT_EQ(tilted.col(0), Eigen::Vector3d::UnitY());
  EXPECT_LT((tilted.col(1) - Eigen::Vector3d(-0.8, 0, 0.6)).norm(), 1e-15);
}

TEST(PlaneTangent, BasisIsRightHandedAndOrthonormalForAnyNormal) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d normal = drawn(engine).normalized();
    const auto basis = tangentBasis(normal);
    EXPECT_LT((basis.transpose() * basis - Eigen::Matrix2d::Identity()).norm(), 1e-14);
    EXPECT_LT((basis.transpose() * normal).norm(), 1e-14);
    EXPECT_LT((basis.col(0).cross(basis.col(1)) - normal).norm(), 1e-14);
  }
}

TEST(PlaneTangent, PlusTurnsTheNormalTowardsTheBasisAsWorkedByHand) {
  const Plane3 floor{Eigen::Vector3d::UnitZ(), 1};
  const Plane3 turned = plus(floor, {kPi / 6, 0, 0.5});
  EXPECT_LT((turned.normal - Eigen::Vector3d(0.5, 0, std::sqrt(3) / 2)).norm(), 1e-15);
  EXPECT_EQ(turned.distance, 1.5);
}

TEST(PlaneTangent, MinusUndoesPlus) {
  std::mt19937_64 engine(2);
  for (int i = 0; i < 200; ++i) {
    const Plane3 plane{drawn(engine).normalized(), drawn(engine).x()};
    const Eigen::Vector3d change = drawn(engine);
    if (change.head<2>().norm() >= kPi) continue;
    EXPECT_LT((minus(plus(plane, change), plane) - change).norm(), 1e-12);
    const Plane3 other{drawn(engine).normalized(), drawn(engine).x()};
    const Plane3 back = plus(plane, minus(other, plane));
    EXPECT_LT((back.normal - other.normal).norm(), 1e-12);
    EXPECT_NEAR(back.distance, other.distance, 1e-12);
  }
  const Plane3 plane{Eigen::Vector3d::UnitX(), 2}, opposite{-Eigen::Vector3d::UnitX(), 2};
  EXPECT_EQ(minus(plane, plane), Eigen::Vector3d::Zero());
  EXPECT_NEAR(minus(opposite, plane).head<2>().norm(), kPi, 1e-12);
}

TEST(PlaneTangent, TransportAgreesWithMovedSmallChanges) {
  std::mt19937_64 engine(3);
  for (int i = 0; i < 50; ++i) {
    const Se3 a_from_b = plus(Se3{}, (Vector6d() << drawn(engine), drawn(engine)).finished());
    const Plane3 plane{drawn(engine).normalized(), 1.5};
    Eigen::Matrix3d jacobian;
    const double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d change = step * Eigen::Vector3d::Unit(k);
      jacobian.col(k) = minus(a_from_b * plus(plane, change), a_from_b * plane) / step;
    }
    Eigen::Matrix3d root;
    root << drawn(engine), drawn(engine), drawn(engine);
    const Eigen::Matrix3d cov = root * root.transpose();
    const Eigen::Matrix3d expected = jacobian * cov * jacobian.transpose();
    EXPECT_LT((transportCovariance(a_from_b, plane, cov) - expected).norm(), 1e-4 * expected.norm());
  }
}

}  // namespace
}  // namespace omnimapper::geometry::plane_tangent_test
