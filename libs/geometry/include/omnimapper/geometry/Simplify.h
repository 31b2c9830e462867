#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Which points of a line of the plane are enough for it: none that is left out is farther than `tolerance` from the
/// stretch between those kept before and after it (in the points' own unit). Ascending indices; the first and the last
/// point always stay. Source: Douglas, Peucker: Algorithms for the reduction of the number of points required to
/// represent a digitized line, 1973.
std::vector<std::size_t> keptOfLine(const std::vector<Eigen::Vector2d>& points, double tolerance);

/// The same of a closed line, whose last point is joined to the first: all of them where fewer than three would remain,
/// or if the tolerance is not above 0.
std::vector<std::size_t> keptOfLoop(const std::vector<Eigen::Vector2d>& points, double tolerance);

}  // namespace omnimapper::geometry
