#include <omnimapper/geometry/Polygon3.h>

#include <Eigen/Geometry>

namespace omnimapper::geometry {

Eigen::Vector3d areaVector(const Polygon3& polygon) {
  Eigen::Vector3d doubled = Eigen::Vector3d::Zero();
  const auto& vertices = polygon.vertices;
  for (std::size_t i = 2; i < vertices.size(); ++i)
    doubled += (vertices[i - 1] - vertices[0]).cross(vertices[i] - vertices[0]);
  return 0.5 * doubled;
}

double area(const Polygon3& polygon) {
  return areaVector(polygon).norm();
}

bool contains(const Polygon3& polygon, const Eigen::Vector3d& point) {
  const Eigen::Vector3d vector = areaVector(polygon);
  if (!(vector.norm() > 0)) return false;
  const Eigen::Vector3d normal = vector.normalized();
  const Eigen::Vector3d foot = point - normal * normal.dot(point - polygon.vertices[0]);
  // Along the axis nearest to the normal, the projection of the polygon is not squeezed to a line.
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  bool inside = false;
  for (std::size_t i = 0, j = polygon.vertices.size() - 1; i < polygon.vertices.size(); j = i++) {
    const Eigen::Vector3d &a = polygon.vertices[i], &b = polygon.vertices[j];
    if ((a[v] > foot[v]) == (b[v] > foot[v])) continue;
    if (foot[u] < a[u] + (foot[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u])) inside = !inside;
  }
  return inside;
}

}  // namespace omnimapper::geometry
