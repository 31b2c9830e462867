#pragma once

#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/Variable.h>

#include <Eigen/Core>
#include <memory>
#include <string_view>

namespace omnimapper::plane_factors {

/// Kind "plane": a plane of the map, which is the set of points p with normal . p + distance = 0. The value is the unit
/// normal x y z, then the distance [m]. Tangent: geometry/PlaneTangent.h, three degrees of freedom. Derivation:
/// doc/derivations/plane.md.
const std::shared_ptr<const graph::Variable>& planeVariable();
/// The kind as a type, for graph::SizedFactor.
struct PlaneKind {
  static constexpr std::string_view kName = "plane";
  static constexpr int kTangentSize = 3;
};

Eigen::Vector4d toValue(const geometry::Plane3& plane);
/// `value`: the four numbers of the variable's value.
inline geometry::Plane3 planeFromValue(const double* value) {
  return {{value[0], value[1], value[2]}, value[3]};
}

}  // namespace omnimapper::plane_factors
