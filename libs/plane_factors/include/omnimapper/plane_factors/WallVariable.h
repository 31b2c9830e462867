#pragma once

#include <omnimapper/geometry/Segment2.h>
#include <omnimapper/graph/Variable.h>

#include <Eigen/Core>
#include <memory>
#include <string_view>

namespace omnimapper::plane_factors {

/// Kind "wall": a wall of a planar map in M-space form (thesis 4.3.2.4; Folkesson, Jensfelt and Christensen 2007). The
/// value is two points on the wall, x y x y [m]; the free side is on the left of the direction from the first point to
/// the second. The tangent is the error that a line can have: a rotation about the middle of the two points [rad], then
/// a shift to the free side [m]. The points never slide along the wall. Derivation: doc/derivations/wall.md.
const std::shared_ptr<const graph::Variable>& wallVariable();
/// The kind as a type, for graph::SizedFactor.
struct WallKind {
  static constexpr std::string_view kName = "wall";
  static constexpr int kTangentSize = 2;
};

Eigen::Vector4d toValue(const geometry::Segment2& wall);
/// `value`: the four numbers of the variable's value.
inline geometry::Segment2 wallFromValue(const double* value) {
  return {{value[0], value[1]}, {value[2], value[3]}};
}

/// The change from one wall to the other: rotation [rad], shift [m].
Eigen::Vector2d wallChange(const geometry::Segment2& from, const geometry::Segment2& to);

/// Unit normal; points to the free side.
inline Eigen::Vector2d normalOf(const geometry::Segment2& wall) {
  const Eigen::Vector2d along = direction(wall);
  return {-along.y(), along.x()};
}

}  // namespace omnimapper::plane_factors
