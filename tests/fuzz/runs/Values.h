#pragma once

#include <mrpt/obs/CObservation.h>

#include <functional>
#include <vector>

namespace omnimapper::fuzz {

/// A number that an observation holds, to be read and replaced. Lives no longer than the observation, and no longer
/// than its vectors keep their length.
struct Value {
  std::function<double()> get;
  std::function<void(double)> set;
};

/// What a mutation may replace in an observation of a class that mappers read: apertures, poses, intrinsics,
/// covariances, ranges, sizes, flags. Of long vectors (ranges, depth, points) only some, evenly spread. Classes that
/// nobody reads have the pose of their sensor alone.
std::vector<Value> valuesOf(mrpt::obs::CObservation& observation);

}  // namespace omnimapper::fuzz
