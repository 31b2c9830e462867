#include <gtest/gtest.h>
#include <omnimapper/geometry/Segment2.h>

namespace omnimapper::geometry::segment2_test {
namespace {

TEST(Segment2, LengthDirectionAndMiddleAsWorkedByHand) {
  const Segment2 segment{{1, 1}, {4, 5}};
  EXPECT_EQ(length(segment), 5);
  EXPECT_LT((direction(segment) - Eigen::Vector2d(0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(middle(segment), Eigen::Vector2d(2.5, 3));
}

TEST(Segment2, NearestPointIsTheFootOrAnEnd) {
  const Segment2 segment{{0, 0}, {4, 0}};
  EXPECT_EQ(nearestPoint(segment, {1, 3}), Eigen::Vector2d(1, 0));
  EXPECT_EQ(nearestPoint(segment, {-2, 3}), Eigen::Vector2d(0, 0));
  EXPECT_EQ(nearestPoint(segment, {9, 3}), Eigen::Vector2d(4, 0));
  EXPECT_EQ(distance(segment, {1, 3}), 3);
  EXPECT_EQ(distance(segment, {7, 4}), 5);
}

TEST(Segment2, OneThatIsAPointHasNoDirection) {
  const Segment2 point{{1, 2}, {1, 2}};
  EXPECT_EQ(length(point), 0);
  EXPECT_EQ(direction(point), Eigen::Vector2d::Zero());
  EXPECT_EQ(distance(point, {4, 6}), 5);
}

}  // namespace
}  // namespace omnimapper::geometry::segment2_test
