#pragma once

#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/PlaneRegion.h>

namespace omnimapper::perception::planes {

/// Makes an observation of the planes of a depth image: stamp and pose are those of `scan`, colours are means where
/// `view`, its images, has any, and outlines are simplified to within `outline_tolerance` [px].
std::shared_ptr<obs::CObservationPlanes> observe(const PlaneSegmentation& found,
                                                 const mrpt::obs::CObservation3DRangeScan& scan,
                                                 const camera::RgbdView& view, double outline_tolerance);

}  // namespace omnimapper::perception::planes
