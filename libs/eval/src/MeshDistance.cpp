#include "MeshDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::eval {

namespace {

using Eigen::Vector3d;

double squaredDistanceFromSegment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double place = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
  return (point - a - place * along).squaredNorm();
}

double squaredDistanceFromTriangle(const Vector3d& point, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool is_over = normal.squaredNorm() > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = t[i], &b = t[(i + 1) % 3];
    is_over = is_over && normal.cross(b - a).dot(point - a) >= 0;
    nearest = std::min(nearest, squaredDistanceFromSegment(point, a, b));
  }
  if (!is_over) return nearest;
  const double height = normal.dot(point - t[0]);
  return height * height / normal.squaredNorm();
}

}  // namespace

MeshDistance::MeshDistance(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box, double margin) {
  const Eigen::AlignedBox3d kept(box.min().array() - margin, box.max().array() + margin);
  for (const auto& corners : mesh.triangles) {
    std::array<Vector3d, 3> triangle;
    Eigen::AlignedBox3d around;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = mesh.vertices[static_cast<std::size_t>(corners[i])];
      around.extend(triangle[i]);
    }
    if (kept.intersects(around)) triangles_.push_back(triangle);
  }
}

double MeshDistance::operator()(const Vector3d& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : triangles_) nearest = std::min(nearest, squaredDistanceFromTriangle(point, triangle));
  return std::sqrt(nearest);
}

}  // namespace omnimapper::eval
