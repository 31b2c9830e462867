#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// A scan as it would look had all of it been taken at one instant of its sweep, in which the sensor moved steadily,
/// along an arc of a circle, by `begin_from_end`. Point i was measured, in the sensor's frame of that moment,
/// `fractions[i]` of the sweep after that instant: 0 to 1 if it is the sweep's begin, -0.5 to 0.5 its middle. Throws
/// base::Error unless there is a fraction for each point.
std::vector<Eigen::Vector2f> deskew(const std::vector<Eigen::Vector2f>& points, const std::vector<float>& fractions,
                                    const mrpt::math::TPose2D& begin_from_end);

}  // namespace omnimapper::matching
