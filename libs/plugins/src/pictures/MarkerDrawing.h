#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

#include "../output/Image.h"
#include "Legend.h"

namespace omnimapper::plugins {

/// Draws a dot where the camera of the picture sees each marker, and its number beside it; colours are those of the
/// numbers. `base_from_camera` has x forward, y left, z up. Adds what that means to `legend` if there are any.
void drawMarkers(Image& picture, const mrpt::img::TCamera& camera, const mrpt::poses::CPose3D& base_from_camera,
                 const mrpt::obs::CObservationBearingRange& found, std::vector<LegendRow>& legend);

}  // namespace omnimapper::plugins
