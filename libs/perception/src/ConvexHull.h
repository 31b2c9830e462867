#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception {

/// geometry::convexHull() of many points in less time: of what lies within Akl and Toussaint's polygon of extreme
/// points (A fast convex hull algorithm, IPL 7(5), 1978) nothing is sorted.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// Answers for many points whether they are near a convex hull.
class HullNeighbourhood {
 public:
  HullNeighbourhood() = default;
  /// The corners as convexHull() tells them. A hull of fewer than three has no neighbourhood.
  explicit HullNeighbourhood(const std::vector<Eigen::Vector2d>& corners);

  /// Whether the point lies within the hull, or at most `margin` outside of each of its edges.
  bool holds(const Eigen::Vector2d& point, double margin) const {
    for (const Side& side : sides_) {
      if (side.inwards.dot(point) - side.offset < -margin) return false;
    }
    return !sides_.empty();
  }

 private:
  struct Side {
    Eigen::Vector2d inwards;  // unit
    double offset;            // of the edge along it
  };
  std::vector<Side> sides_;
};

}  // namespace omnimapper::perception
