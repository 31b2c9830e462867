#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <vector>

namespace omnimapper::source {

/// All images that an observation can hold, empty ones included.
std::vector<const mrpt::img::CImage*> imagesOf(const mrpt::obs::CObservation& observation);

/// Bytes in memory of what a log keeps compressed or in files beside it: images, depth images, clouds.
std::size_t payloadBytes(const mrpt::obs::CObservation& observation);

}  // namespace omnimapper::source
