#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/CloudPoint.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <vector>

namespace omnimapper::mapper {

/// The coloured points of a depth image in the base frame, one for each cube of side `options.voxel`; empty for other
/// observations and where there is no depth. Points at depth discontinuities, where a pixel covers two surfaces, are
/// left out. Without a colour image the points are grey.
std::vector<map::CloudPoint> depthCloud(const mrpt::obs::CObservation& observation, const CloudOptions& options);

}  // namespace omnimapper::mapper
