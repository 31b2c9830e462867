#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Simplifies a polyline in the plane. Returns the ascending indices of the points that are kept. No other point is
/// farther than `tolerance` (in the unit of the points) from the segment between the kept points before and after it.
/// The first and the last point are always kept. Source: Douglas, Peucker: Algorithms for the reduction of the number
/// of points required to represent a digitized line, 1973.
std::vector<std::size_t> keptOfLine(const std::vector<Eigen::Vector2d>& points, double tolerance);

/// As keptOfLine(), for a closed polyline, whose last point is joined to the first. All points are kept if fewer than
/// three would remain, or if the tolerance is not above 0.
std::vector<std::size_t> keptOfLoop(const std::vector<Eigen::Vector2d>& points, double tolerance);

}  // namespace omnimapper::geometry
