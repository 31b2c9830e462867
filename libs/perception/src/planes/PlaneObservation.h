#pragma once

#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/PlaneRegion.h>

#include "../RangeScan.h"

namespace omnimapper::perception::planes {

/// The planes of a depth image as an observation, with stamp and pose of `scan`, mean colours where it sees any, and
/// outlines that are true to `outline_tolerance` [px].
std::shared_ptr<obs::CObservationPlanes> observe(const PlaneSegmentation& found,
                                                 const mrpt::obs::CObservation3DRangeScan& scan, const ScanDepth& depth,
                                                 const ScanColours& colours, double outline_tolerance);

}  // namespace omnimapper::perception::planes
