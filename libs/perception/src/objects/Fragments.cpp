#include "Fragments.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::perception::objects {

bool isRestOfPlane(const std::vector<Eigen::Vector3d>& cluster, const std::vector<geometry::Plane3>& planes,
                   const FragmentBounds& bounds) {
  constexpr double kMost = 0.8;
  return std::any_of(planes.begin(), planes.end(), [&](const geometry::Plane3& plane) {
    const auto is_on = [&](const Eigen::Vector3d& point) {
      const double depth = point.z();
      return std::abs(signedDistance(plane, point)) <= bounds.distance + bounds.distance_at_1m * depth * depth;
    };
    const auto on = std::count_if(cluster.begin(), cluster.end(), is_on);
    return static_cast<double>(on) >= kMost * static_cast<double>(cluster.size());
  });
}

bool isRod(const Eigen::Vector3d& size, double max_aspect_ratio) {
  Eigen::Vector3d sides = size;
  std::sort(sides.data(), sides.data() + 3);
  return sides[2] > kLongRod && sides[2] > max_aspect_ratio * sides[1];
}

}  // namespace omnimapper::perception::objects
