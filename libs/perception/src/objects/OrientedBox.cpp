#include "OrientedBox.h"

#include <omnimapper/geometry/PlaneTangent.h>

#include <algorithm>
#include <limits>

#include "../ConvexHull.h"

namespace omnimapper::perception::objects {

namespace {

double crossProduct(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

struct Rectangle {
  Eigen::Vector2d x_axis = Eigen::Vector2d::UnitX();                              // unit; y is a left turn after it
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  // along the axes
  double area() const { return (high - low).prod(); }
};

Rectangle around(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& x_axis) {
  Rectangle rectangle;
  rectangle.x_axis = x_axis;
  rectangle.low.setConstant(std::numeric_limits<double>::infinity());
  rectangle.high = -rectangle.low;
  for (const auto& point : points) {
    const Eigen::Vector2d along(x_axis.dot(point), crossProduct(x_axis, point));
    rectangle.low = rectangle.low.cwiseMin(along);
    rectangle.high = rectangle.high.cwiseMax(along);
  }
  return rectangle;
}

// One side of the smallest rectangle lies along an edge of the hull.
Rectangle smallestAround(const std::vector<Eigen::Vector2d>& hull) {
  Rectangle best = around(hull, Eigen::Vector2d::UnitX());
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.squaredNorm() > 0)) continue;
    const Rectangle rectangle = around(hull, edge.normalized());
    if (rectangle.area() < best.area()) best = rectangle;
  }
  const Eigen::Vector2d size = best.high - best.low;
  if (size.x() >= size.y()) return best;
  return around(hull, Eigen::Vector2d(-best.x_axis.y(), best.x_axis.x()));
}

}  // namespace

OrientedBox boxAlong(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Matrix<double, 3, 2> across = geometry::tangentBasis(axis);
  std::vector<Eigen::Vector2d> footprint;
  footprint.reserve(points.size());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& point : points) {
    footprint.emplace_back(across.transpose() * point);
    low = std::min(low, axis.dot(point));
    high = std::max(high, axis.dot(point));
  }
  const Rectangle rectangle = smallestAround(convexHull(std::move(footprint)));
  const Eigen::Vector2d y_axis(-rectangle.x_axis.y(), rectangle.x_axis.x());
  Eigen::Matrix3d axes;
  axes << across * rectangle.x_axis, across * y_axis, axis;
  const Eigen::Vector2d middle = 0.5 * (rectangle.low + rectangle.high), size = rectangle.high - rectangle.low;
  OrientedBox box;
  box.frame_from_box = {Eigen::Quaterniond(axes).normalized(),
                        axes * Eigen::Vector3d(middle.x(), middle.y(), 0.5 * (low + high))};
  box.size << size, high - low;
  return box;
}

OrientedBox extended(const OrientedBox& box, const std::vector<Eigen::Vector3f>& points) {
  const Eigen::Matrix3d axes = box.frame_from_box.rotation.toRotationMatrix();
  const Eigen::Vector3d middle = axes.transpose() * box.frame_from_box.translation;
  const Eigen::Matrix3f along = axes.transpose().cast<float>();
  Eigen::Array3f low = (middle - 0.5 * box.size).cast<float>(), high = (middle + 0.5 * box.size).cast<float>();
  for (const auto& point : points) {
    const Eigen::Array3f place = along * point;
    low = low.min(place);
    high = high.max(place);
  }
  OrientedBox result = box;
  result.size = (high - low).cast<double>();
  result.frame_from_box.translation = axes * (0.5 * (low + high)).matrix().cast<double>();
  return result;
}

}  // namespace omnimapper::perception::objects
