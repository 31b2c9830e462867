#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <optional>
#include <vector>

namespace omnimapper::eval {

/// Pose of a body (robot base or sensor) at one time.
struct StampedPose {
  base::Stamp stamp;
  geometry::Se3 world_from_body;
};

/// Poses by rising stamp, no stamp twice.
using Trajectory = std::vector<StampedPose>;

/// The same poses by rising stamp. Throws Error(unreadable_input) if two have the same stamp; `name` is for its
/// message.
Trajectory sortedByStamp(std::vector<StampedPose> poses, const std::string& name);

/// The trajectory of something fixed to the body: world_from_part = world_from_body * body_from_part.
Trajectory trajectoryOfPart(const Trajectory& trajectory, const geometry::Se3& body_from_part);

/// Index of the pose nearest in time and at most `tolerance` away; the earlier of two equally near.
std::optional<std::size_t> nearestPose(const Trajectory& trajectory, base::Stamp stamp, base::Duration tolerance);

/// The pose at a stamp, on the straight line and the shortest turn between the poses before and after it. None outside
/// the trajectory, and where the two lie further apart than `longest_gap`.
std::optional<geometry::Se3> interpolatedPose(const Trajectory& trajectory, base::Stamp stamp,
                                              base::Duration longest_gap);

/// Distance travelled from the first pose to each pose [m].
std::vector<double> distanceTravelled(const Trajectory& trajectory);

}  // namespace omnimapper::eval
