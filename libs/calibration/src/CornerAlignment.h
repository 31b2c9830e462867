#pragma once

#include <omnimapper/calibration/RgbdCamera.h>

#include <vector>

#include "Tracks.h"
#include "View.h"

namespace omnimapper::calibration {

/// Moves the corners of each track to where their surroundings agree best with those in one of its views, warped as the
/// surface there is seen from the other: a corner as it is found is good to a pixel, one as it is aligned to a few
/// tenths. Those that agree badly are left out, and tracks of fewer than `fewest` views then.
void alignCorners(std::vector<Track>& tracks, const std::vector<View>& views, const RgbdCamera& camera,
                  std::size_t fewest);

}  // namespace omnimapper::calibration
