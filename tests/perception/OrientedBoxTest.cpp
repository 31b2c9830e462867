#include <gtest/gtest.h>

#include <cmath>

#include "objects/OrientedBox.h"

namespace omnimapper::perception::objects {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(ConvexHull, GoesRoundTheOuterPointsCounterClockwise) {
  const auto hull = convexHull({{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {2, 0}});
  EXPECT_EQ(hull, (std::vector<Vector2d>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(ConvexHull, OfLittleIsLittle) {
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull({{1, 2}}).size(), 1U);
  EXPECT_EQ(convexHull({{0, 0}, {1, 1}, {2, 2}}), (std::vector<Vector2d>{{0, 0}, {2, 2}}));
}

TEST(ConvexHull, IsNearByTheMargin) {
  const std::vector<Vector2d> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_TRUE(isNearHull(square, {1, 1}, 0));
  EXPECT_FALSE(isNearHull(square, {2.05, 1}, 0));
  EXPECT_TRUE(isNearHull(square, {2.05, 1}, 0.1));
  EXPECT_FALSE(isNearHull({{0, 0}, {1, 1}}, {0, 0}, 1)) << "no area";
}

TEST(OrientedBox, OfATurnedBlockIsTheBlock) {
  // 0.4 x 0.2 x 0.1 m, turned by 30 degrees about the vertical.
  const Vector3d x(std::cos(M_PI / 6), std::sin(M_PI / 6), 0), y(-x.y(), x.x(), 0), middle(1, 2, 3);
  std::vector<Vector3d> points;
  for (const double a : {-0.2, 0., 0.2}) {
    for (const double b : {-0.1, 0.1}) {
      for (const double c : {-0.05, 0.05}) points.push_back(middle + a * x + b * y + c * Vector3d::UnitZ());
    }
  }
  const auto box = boxAlong(Vector3d::UnitZ(), points);
  EXPECT_LT((box.size - Vector3d(0.4, 0.2, 0.1)).norm(), 1e-12);
  EXPECT_LT((box.frame_from_box.translation - middle).norm(), 1e-12);
  const Eigen::Matrix3d axes = box.frame_from_box.rotation.toRotationMatrix();
  EXPECT_NEAR(std::abs(axes.col(0).dot(x)), 1, 1e-12);
  EXPECT_NEAR(axes.col(2).z(), 1, 1e-12);
}

TEST(OrientedBox, OfOnePointHasNoSize) {
  const auto box = boxAlong(Vector3d::UnitX(), {{1, 2, 3}});
  EXPECT_EQ(box.size, Vector3d::Zero());
  EXPECT_LT((box.frame_from_box.translation - Vector3d(1, 2, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace omnimapper::perception::objects
