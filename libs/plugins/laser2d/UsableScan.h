#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::plugins {

/// Whether two scans of at least ten echoes have exactly the same ranges. Noise alone makes two scans differ, even if
/// the base stands still: a laser whose ranges stay the same repeats itself.
bool haveSameRanges(const mrpt::obs::CObservation2DRangeScan& a, const mrpt::obs::CObservation2DRangeScan& b);

/// A copy of a scan in which the beams that ended on, or within 0.12 m of, any of the given points are invalid.
/// `points` are in the base [m].
mrpt::obs::CObservation2DRangeScan::Ptr withoutBeamsNear(const std::vector<Eigen::Vector2f>& points,
                                                         const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace omnimapper::plugins
