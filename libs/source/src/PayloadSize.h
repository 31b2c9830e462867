#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <vector>

namespace omnimapper::source {

/// All images that an observation can hold, empty ones included.
std::vector<const mrpt::img::CImage*> imagesOf(const mrpt::obs::CObservation& observation);

/// Bytes in memory of the data that a log keeps compressed or in external files: images, depth images, clouds.
std::size_t payloadBytes(const mrpt::obs::CObservation& observation);

}  // namespace omnimapper::source
