#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <vector>

namespace omnimapper::eval {

/// Poses of both trajectories at one time.
struct PosePair {
  base::Stamp stamp;  ///< of the estimate
  geometry::Se3 estimate;
  geometry::Se3 reference;
};

/// Pairs of poses whose stamps differ by at most `tolerance`, in the order of the estimate's stamps. The nearest poses
/// are paired first, and each pose is used once. A trajectory is paired with itself one to one, whatever the tolerance.
std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& reference, base::Duration tolerance);

/// One pair for every pose of the estimate at whose stamp the reference can be interpolated over at most `longest_gap`.
std::vector<PosePair> associateInterpolated(const Trajectory& estimate, const Trajectory& reference,
                                            base::Duration longest_gap);

}  // namespace omnimapper::eval
