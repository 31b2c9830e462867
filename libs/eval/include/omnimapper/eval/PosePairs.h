#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <vector>

namespace omnimapper::eval {

/// One moment at which both trajectories have a pose.
struct PosePair {
  base::Stamp stamp;  ///< of the estimate
  geometry::Se3 estimate;
  geometry::Se3 reference;
};

/// Pairs of poses not further apart in time than `tolerance`, nearest first and each pose used once; by rising stamp of
/// the estimate. A trajectory and itself pair one to one, whatever the tolerance.
std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& reference, base::Duration tolerance);

/// One pair for every pose of the estimate at whose stamp the reference can be interpolated over at most `longest_gap`.
std::vector<PosePair> associateInterpolated(const Trajectory& estimate, const Trajectory& reference,
                                            base::Duration longest_gap);

}  // namespace omnimapper::eval
