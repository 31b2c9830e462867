#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace omnimapper::geometry {

/// A line segment in the plane [m].
struct Segment2 {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

inline double length(const Segment2& segment) {
  return (segment.to - segment.from).norm();
}

/// Unit vector from `from` to `to`; zero if both are the same point.
inline Eigen::Vector2d direction(const Segment2& segment) {
  const double norm = length(segment);
  return norm > 0 ? Eigen::Vector2d((segment.to - segment.from) / norm) : Eigen::Vector2d::Zero();
}

inline Eigen::Vector2d middle(const Segment2& segment) {
  return 0.5 * (segment.from + segment.to);
}

/// The point of the segment, ends included, that is nearest to `point`.
inline Eigen::Vector2d nearestPoint(const Segment2& segment, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double squared = along.squaredNorm();
  if (!(squared > 0)) return segment.from;
  return segment.from + std::clamp((point - segment.from).dot(along) / squared, 0.0, 1.0) * along;
}

/// Distance of a point from the segment, ends included [m].
inline double distance(const Segment2& segment, const Eigen::Vector2d& point) {
  return (point - nearestPoint(segment, point)).norm();
}

}  // namespace omnimapper::geometry
