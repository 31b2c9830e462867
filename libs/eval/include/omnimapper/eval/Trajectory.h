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

/// Poses in the order of their stamps; no stamp occurs twice.
using Trajectory = std::vector<StampedPose>;

/// The poses in the order of their stamps. Throws Error(unreadable_input) if two have the same stamp; the message
/// begins with `name`.
Trajectory sortedByStamp(std::vector<StampedPose> poses, const std::string& name);

/// The trajectory of a part that is fixed to the body: world_from_part = world_from_body * body_from_part.
Trajectory trajectoryOfPart(const Trajectory& trajectory, const geometry::Se3& body_from_part);

/// Index of the pose whose stamp is nearest to `stamp`; of two equally near ones, the earlier. None if it is more than
/// `tolerance` away.
std::optional<std::size_t> nearestPose(const Trajectory& trajectory, base::Stamp stamp, base::Duration tolerance);

/// The pose at a stamp, interpolated along the straight line and the shortest rotation from the pose before to the pose
/// after it. None if the stamp is outside the trajectory, or if these two poses are more than `longest_gap` apart in
/// time.
std::optional<geometry::Se3> interpolatedPose(const Trajectory& trajectory, base::Stamp stamp,
                                              base::Duration longest_gap);

/// Distance travelled from the first pose to each pose [m].
std::vector<double> distanceTravelled(const Trajectory& trajectory);

}  // namespace omnimapper::eval
