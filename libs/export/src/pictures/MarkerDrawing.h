#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/geometry/Se3.h>

#include <vector>

#include "pictures/Legend.h"

namespace omnimapper::exports {

/// Draws a dot where the camera of the picture sees each marker, and its number beside it; colours are those of the
/// numbers. `base_from_camera` has x forward, y left, z up. Draws none, and
/// says none, for a camera without calibration. Adds what they mean to `legend`.
void drawMarkers(draw::Image& picture, const mrpt::img::TCamera& camera, const geometry::Se3& base_from_camera,
                 const mrpt::obs::CObservationBearingRange& found, std::vector<LegendRow>& legend);

}  // namespace omnimapper::exports
