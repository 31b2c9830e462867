#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace omnimapper::geometry {

/// The middle of the area of a polygon, which need not be convex [m]; none if it has no area.
std::optional<Eigen::Vector2d> centroid(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace omnimapper::geometry
