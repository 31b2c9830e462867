#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/CloudPoint.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/perception/Blackboard.h>

#include <vector>

namespace omnimapper::mapper {

/// The coloured points of a depth image in the base frame, one for each cube of side `options.voxel`; empty for other
/// observations and where there is no depth. Points at depth discontinuities, where a pixel covers two surfaces, are
/// left out. Points without a colour are grey. The decoded images are those on the blackboard of the observation. An
/// observation whose images cannot be decoded has no points.
std::vector<map::CloudPoint> depthCloud(const mrpt::obs::CObservation& observation, const CloudOptions& options,
                                        perception::Blackboard& board);

}  // namespace omnimapper::mapper
