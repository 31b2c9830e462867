#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/CloudPoint.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <vector>

namespace omnimapper::mapper {

/// The points of a depth image with their colours, one of each cube of `options.voxel`; none of other observations, nor
/// where there is no depth. Points at edges of depth, where a pixel sees two surfaces, are left out. Without a picture
/// the points are grey.
std::vector<map::CloudPoint> depthCloud(const mrpt::obs::CObservation& observation, const CloudOptions& options);

}  // namespace omnimapper::mapper
