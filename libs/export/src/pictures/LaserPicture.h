#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/draw/Image.h>

#include <vector>

namespace omnimapper::exports {

/// A 2D scan seen from above, x to the right and y up, in squares of 1 m, or of 10, 100 and so on where more than 100
/// would lie in a row: its points grey, the sensor black, and the lines that were derived of it in the colour of their
/// index, with bars where they end.
draw::Image drawLaserPicture(const mrpt::obs::CObservation2DRangeScan& scan,
                             const std::vector<mrpt::obs::CObservation::Ptr>& derived);

}  // namespace omnimapper::exports
