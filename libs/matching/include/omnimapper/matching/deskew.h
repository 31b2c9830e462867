#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// Transforms a scan to what it would be if all its points had been measured at one instant of its sweep. During the
/// sweep the sensor moved steadily along a circular arc, by `begin_from_end`. Point i is in the sensor's frame at the
/// time when it was measured, which is `fractions[i]` of the sweep after that instant: 0 to 1 if the instant is the
/// sweep's beginning, -0.5 to 0.5 if it is its middle. Throws base::Error unless there is a fraction for each point.
std::vector<Eigen::Vector2f> deskew(const std::vector<Eigen::Vector2f>& points, const std::vector<float>& fractions,
                                    const mrpt::math::TPose2D& begin_from_end);

}  // namespace omnimapper::matching
