#pragma once

#include <omnimapper/surfaces/SurfaceSet.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::surfaces {

/// The cells of 5 cm that a surface covers; larger ones for a surface of more than 25 m.
struct FilledCells {
  std::vector<Eigen::Vector3d> middles;  ///< corners of the surface if it covers the middle of no cell
  double area = 0;                       ///< [m^2] of all
};
FilledCells cellsOf(const Surface& surface);

/// The range of the points along a direction [m], without one in thirty at either end and extended by what an even
/// distribution has there. A corner that sticks out, for example where a view mixed two surfaces, has little area and
/// does not change it. There must be a point.
Eigen::Vector2d rangeAlong(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& along);

/// A direction of the floor in space.
inline Eigen::Vector3d onFloor(const Eigen::Vector2d& direction) {
  return {direction.x(), direction.y(), 0};
}

}  // namespace omnimapper::surfaces
