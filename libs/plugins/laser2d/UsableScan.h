#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::plugins {

/// Whether two scans of at least ten echoes have echoes in the same beams, and exactly the same ranges there. Noise
/// alone makes two scans differ, even if the base stands still: a laser whose ranges stay the same repeats itself.
bool haveSameRanges(const mrpt::obs::CObservation2DRangeScan& a, const mrpt::obs::CObservation2DRangeScan& b);

/// A copy of a scan in which the beams that ended within `near` [m] of any of the given points are invalid. `points`
/// are in the base [m], as the scan measured them.
mrpt::obs::CObservation2DRangeScan::Ptr withoutBeamsNear(const std::vector<Eigen::Vector2f>& points, float near,
                                                         const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace omnimapper::plugins
