#include <omnimapper/plane_factors/PlaneAxes.h>

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::plane_factors {

PlaneAxes::PlaneAxes(const geometry::Plane3& plane) : foot(-plane.distance * plane.normal) {
  constexpr double kLevel = 0.9;  // a normal this upright is that of a floor or a table
  const bool level = std::abs(plane.normal.z()) > kLevel;
  const Eigen::Vector3d across =
      level ? Eigen::Vector3d::UnitY().cross(plane.normal).eval() : Eigen::Vector3d::UnitZ().cross(plane.normal).eval();
  u = across.normalized();
  v = plane.normal.cross(u);
}

}  // namespace omnimapper::plane_factors
