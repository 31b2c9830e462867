#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

namespace omnimapper::perception {

/// Whether the picture of a range camera shows in each pixel what the depth image has there: the size is the same, the
/// place and turn, the focal lengths and the centre. A picture whose camera is not calibrated (focal length 0) counts
/// as taken with the depth image's.
bool isPictureOfDepthView(const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace omnimapper::perception
