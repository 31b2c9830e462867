#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/draw/Image.h>

#include <vector>

namespace omnimapper::pictures {

/// A 2D scan seen from above, x to the right and y up, on squares of 1 m, or of 10, 100 and so on if there were more
/// than 100 in a row. Points are grey, the sensor is black, and the lines derived from the scan have the colour of
/// their index and bars at their ends.
draw::Image drawLaserPicture(const mrpt::obs::CObservation2DRangeScan& scan,
                             const std::vector<mrpt::obs::CObservation::Ptr>& derived);

}  // namespace omnimapper::pictures
