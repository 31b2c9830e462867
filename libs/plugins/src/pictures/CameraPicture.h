#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <vector>

#include "../output/Image.h"

namespace omnimapper::plugins {

/// What a range camera saw, with what was derived of it drawn over: planes filled in the colour of their index,
/// outlined and with their normals; the points of objects, and their boxes; the points of clouds. Over the colour image
/// where it is of the same view as the depth, else over the depth, near bright.
Image drawCameraPicture(const mrpt::obs::CObservation3DRangeScan& scan,
                        const std::vector<mrpt::obs::CObservation::Ptr>& derived);

}  // namespace omnimapper::plugins
