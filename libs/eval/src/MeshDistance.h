#pragma once

#include <omnimapper/eval/TriangleMesh.h>

#include <Eigen/Geometry>
#include <vector>

namespace omnimapper::eval {

/// Distances from points to the triangles of a mesh that are near a box.
class MeshDistance {
 public:
  /// Keeps the triangles that are at most `margin` [m] from the box along each axis.
  MeshDistance(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box, double margin);

  /// [m] to the nearest triangle that was kept; infinite if none was.
  double operator()(const Eigen::Vector3d& point) const;

 private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
};

}  // namespace omnimapper::eval
