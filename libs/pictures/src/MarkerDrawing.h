#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/draw/Legend.h>
#include <omnimapper/geometry/Se3.h>

#include <vector>

namespace omnimapper::pictures {

/// Draws a dot where the camera sees each marker, with its number beside it and in the colour of that number, and adds
/// a row to `legend`. `base_from_camera` has x forward, y left, z up. Draws nothing for a camera without calibration.
void drawMarkers(draw::Image& picture, const mrpt::img::TCamera& camera, const geometry::Se3& base_from_camera,
                 const mrpt::obs::CObservationBearingRange& found, std::vector<draw::LegendRow>& legend);

}  // namespace omnimapper::pictures
