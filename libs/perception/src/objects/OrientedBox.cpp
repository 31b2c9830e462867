#include "OrientedBox.h"

#include <omnimapper/geometry/PlaneTangent.h>

#include <algorithm>
#include <limits>

#include "../ConvexHull.h"
#include "../planes/Lanes.h"

namespace omnimapper::perception::objects {

namespace {

using planes::kLanes;
using planes::Lanes;

double crossProduct(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

struct Rectangle {
  Eigen::Vector2d x_axis = Eigen::Vector2d::UnitX();                              // unit; y is 90 degrees to its left
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

struct SpanTask {
  const float *x, *y, *z;
  int count;
  float a, b, c;  // the axis
};

struct Span {
  float low, high;
};

OMNIMAPPER_KERNEL_BODY void widen(const SpanTask& task, const float* x, const float* y, const float* z, Lanes& low,
                                  Lanes& high) {
  Lanes points_x, points_y, points_z;
  planes::load(points_x, x);
  planes::load(points_y, y);
  planes::load(points_z, z);
  const Lanes place = task.a * points_x + (task.b * points_y + task.c * points_z);
  low = place < low ? place : low;
  high = place > high ? place : high;
}

// Extends a span by the positions of points along an axis.
OMNIMAPPER_KERNEL_BODY Span spanBody(const SpanTask& task, const Span& start) {
  Lanes low = Lanes{} + start.low, high = Lanes{} + start.high;
  int i = 0;
  for (; i + kLanes <= task.count; i += kLanes) widen(task, task.x + i, task.y + i, task.z + i, low, high);
  if (i < task.count) {
    float last[3][kLanes];
    const float* const from[3] = {task.x, task.y, task.z};
    for (int d = 0; d < 3; ++d) {
      for (int k = 0; k < kLanes; ++k) last[d][k] = from[d][std::min(i + k, task.count - 1)];
    }
    widen(task, last[0], last[1], last[2], low, high);
  }
  Span span{low[0], high[0]};
  for (int k = 1; k < kLanes; ++k) span = {std::min(span.low, low[k]), std::max(span.high, high[k])};
  return span;
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 Span spanAvx2(const SpanTask& task, const Span& start) {
  return spanBody(task, start);
}
#endif

Span spanOf(const SpanTask& task, const Span& start) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return spanAvx2(task, start);
#endif
  return spanBody(task, start);
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

OrientedBox extended(const OrientedBox& box, const PointList& points) {
  const Eigen::Matrix3d axes = box.frame_from_box.rotation.toRotationMatrix();
  const Eigen::Vector3d middle = axes.transpose() * box.frame_from_box.translation;
  const Eigen::Matrix3f along = axes.transpose().cast<float>();
  Eigen::Array3f low = (middle - 0.5 * box.size).cast<float>(), high = (middle + 0.5 * box.size).cast<float>();
  for (int d = 0; d < 3; ++d) {
    const Span span = spanOf({points.x.data(), points.y.data(), points.z.data(), static_cast<int>(points.size()),
                              along(d, 0), along(d, 1), along(d, 2)},
                             {low[d], high[d]});
    low[d] = span.low;
    high[d] = span.high;
  }
  OrientedBox result = box;
  result.size = (high - low).cast<double>();
  result.frame_from_box.translation = axes * (0.5 * (low + high)).matrix().cast<double>();
  return result;
}

}  // namespace omnimapper::perception::objects
