#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <vector>

namespace omnimapper::eval {

/// A pose of each trajectory, at the same time.
struct PosePair {
  base::Stamp stamp;  ///< of the estimate
  geometry::Se3 estimate;
  geometry::Se3 reference;
};

/// Pairs of poses whose stamps differ by at most `tolerance`, in the order of the estimate's stamps. Poses with the
/// nearest stamps are paired first, and each pose is used once. So if both trajectories are the same, each pose is
/// paired with itself, whatever the tolerance.
std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& reference, base::Duration tolerance);

/// One pair for each pose of the estimate at whose stamp interpolatedPose() gives a pose of the reference.
std::vector<PosePair> associateInterpolated(const Trajectory& estimate, const Trajectory& reference,
                                            base::Duration longest_gap);

}  // namespace omnimapper::eval
