#pragma once

#include <omnimapper/calibration/DepthCamera.h>

#include <vector>

#include "CalibrationView.h"
#include "Tracks.h"

namespace omnimapper::calibration {

/// Refines the corners of each track by aligning the patch around the corner of one view, warped by the surface there,
/// with the other views. The accuracy of a corner improves from a pixel to a few tenths. Corners that agree badly are
/// left out, and then tracks of fewer than `fewest` views.
void alignCorners(std::vector<Track>& tracks, const std::vector<CalibrationView>& views, const DepthCamera& camera,
                  std::size_t fewest);

}  // namespace omnimapper::calibration
