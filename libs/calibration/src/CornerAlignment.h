#pragma once

#include <omnimapper/calibration/DepthCamera.h>

#include <vector>

#include "CalibrationView.h"
#include "Tracks.h"

namespace omnimapper::calibration {

/// Moves the corners of each track to where their surroundings agree best with those in one of its views, warped as the
/// surface there is seen from the other: a corner as it is found is good to a pixel, one as it is aligned to a few
/// tenths. Those that agree badly are left out, and tracks of fewer than `fewest` views then.
void alignCorners(std::vector<Track>& tracks, const std::vector<CalibrationView>& views, const DepthCamera& camera,
                  std::size_t fewest);

}  // namespace omnimapper::calibration
