#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception {

/// The same as geometry::convexHull(), but faster for many points: those within a polygon of extreme points are dropped
/// before the others are sorted. Source: Akl and Toussaint: A fast convex hull algorithm, IPL 7(5), 1978.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// Tests whether points lie in or near a convex hull.
class HullNeighbourhood {
 public:
  HullNeighbourhood() = default;
  /// `corners` are in the order of convexHull(). With fewer than three, no point is in the neighbourhood.
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
    double offset;            // of the edge along `inwards`
  };
  std::vector<Side> sides_;
};

}  // namespace omnimapper::perception
