#pragma once

#include <omnimapper/geometry/Se2.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace omnimapper::geometry {

/// The motion of the plane that takes the first point of each pair to the second one with the least squares (Umeyama
/// 1991, in the plane). Points in metres; there must be a pair. With a single pair, or if all first points coincide, it
/// does not turn.
Se2 motionBetween(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& pairs);

}  // namespace omnimapper::geometry
