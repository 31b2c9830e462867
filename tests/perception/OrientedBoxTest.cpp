#include <gtest/gtest.h>

#include <cmath>

#include "objects/OrientedBox.h"

namespace omnimapper::perception::objects::oriented_box_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

TEST(OrientedBox, IsExtendedAlongItsAxes) {
  const Vector3d x(std::cos(M_PI / 6), std::sin(M_PI / 6), 0), y(-x.y(), x.x(), 0), middle(1, 2, 3);
  std::vector<Vector3d> corners;
  for (const double a : {-0.2, 0.2}) {
    for (const double b : {-0.1, 0.1}) {
      for (const double c : {-0.05, 0.05}) corners.push_back(middle + a * x + b * y + c * Vector3d::UnitZ());
    }
  }
  const auto box = boxAlong(Vector3d::UnitZ(), corners);
  const auto extendedBy = [&](const Vector3d& point, int inner) {
    PointList points;
    for (int i = 0; i < inner; ++i) points.push_back(middle.cast<float>());
    points.push_back(point.cast<float>());
    return extended(box, points);
  };
  const auto same = extendedBy(middle, 0);
  EXPECT_LT((same.size - box.size).norm(), 1e-6);
  for (int inner = 0; inner < 20; ++inner) {  // at any place in a group of eight points
    const auto longer = extendedBy(middle + 0.4 * x + 0.02 * y, inner);
    EXPECT_LT((longer.size - Vector3d(0.6, 0.2, 0.1)).norm(), 1e-5) << inner;
    EXPECT_LT((longer.frame_from_box.translation - (middle + 0.1 * x)).norm(), 1e-5) << inner;
  }
}

}  // namespace
}  // namespace omnimapper::perception::objects::oriented_box_test
