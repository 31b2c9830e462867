#pragma once

#include <mrpt/obs/CObservation.h>

#include <functional>
#include <vector>

namespace omnimapper::fuzz {

/// Access to a number in an observation, to read and replace it. Valid as long as the observation exists and its
/// vectors keep their lengths.
struct Value {
  std::function<double()> get;
  std::function<void(double)> set;
};

/// The values that a mutation may replace in an observation of a class that the programs read: apertures, poses,
/// intrinsics, covariances, ranges, sizes and flags. Of long vectors (ranges, depths, points) it has some values,
/// evenly spread. Of other classes it has only the pose of the sensor.
std::vector<Value> valuesOf(mrpt::obs::CObservation& observation);

}  // namespace omnimapper::fuzz
