#pragma once

#include <omnimapper/geometry/Se3.h>

#include <memory>
#include <string_view>

#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// The kinds of variables that this library has. Lengths are in m, angles in rad.

/// "se2": x y yaw; the tangent is that of geometry::Se2.
const std::shared_ptr<const Variable>& se2();
/// "se3": x y z qx qy qz qw, a unit quaternion; the tangent is that of geometry::Se3.
const std::shared_ptr<const Variable>& se3();
/// "point2": x y.
const std::shared_ptr<const Variable>& point2();
/// "point3": x y z.
const std::shared_ptr<const Variable>& point3();
/// "pan_tilt": two angles, first to the left, then down. It is not a place in the map.
const std::shared_ptr<const Variable>& panTilt();

/// The same kinds as types, for SizedFactor.
struct Se2Kind {
  static constexpr std::string_view kName = "se2";
  static constexpr int kTangentSize = 3;
};
struct Se3Kind {
  static constexpr std::string_view kName = "se3";
  static constexpr int kTangentSize = 6;
};
struct Point2Kind {
  static constexpr std::string_view kName = "point2";
  static constexpr int kTangentSize = 2;
};
struct Point3Kind {
  static constexpr std::string_view kName = "point3";
  static constexpr int kTangentSize = 3;
};
struct PanTiltKind {
  static constexpr std::string_view kName = "pan_tilt";
  static constexpr int kTangentSize = 2;
};

/// Converts poses to values as the graph stores them, and back. `value` points to all numbers of a value.
Eigen::Vector3d toValue(const geometry::Se2& pose);
Eigen::Matrix<double, 7, 1> toValue(const geometry::Se3& pose);
inline geometry::Se2 se2FromValue(const double* value) {
  return {value[0], value[1], value[2]};
}
inline geometry::Se3 se3FromValue(const double* value) {
  return {Eigen::Quaterniond(value[6], value[3], value[4], value[5]), {value[0], value[1], value[2]}};
}

}  // namespace omnimapper::graph
