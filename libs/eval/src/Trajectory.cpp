#include <omnimapper/base/Error.h>
#include <omnimapper/eval/Trajectory.h>

#include <algorithm>

namespace omnimapper::eval {

namespace {
Trajectory::const_iterator firstNotBefore(const Trajectory& trajectory, base::Stamp stamp) {
  return std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                          [](const StampedPose& pose, base::Stamp t) { return pose.stamp < t; });
}
}  // namespace

Trajectory sortedByStamp(std::vector<StampedPose> poses, const std::string& name) {
  std::sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto twice =
      std::adjacent_find(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  if (twice != poses.end()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      name + ": two poses have the stamp " + base::formatUnix(twice->stamp) + "; remove one");
  }
  return poses;
}

Trajectory trajectoryOfPart(const Trajectory& trajectory, const geometry::Se3& body_from_part) {
  Trajectory of_part = trajectory;
  for (auto& pose : of_part) pose.world_from_body = pose.world_from_body * body_from_part;
  return of_part;
}

std::optional<std::size_t> nearestPose(const Trajectory& trajectory, base::Stamp stamp, base::Duration tolerance) {
  const auto after = firstNotBefore(trajectory, stamp);
  auto best = after;
  if (after != trajectory.begin()) {
    const auto before = std::prev(after);
    if (after == trajectory.end() || stamp - before->stamp <= after->stamp - stamp) best = before;
  }
  if (best == trajectory.end()) return std::nullopt;
  const base::Duration distance = best->stamp < stamp ? stamp - best->stamp : best->stamp - stamp;
  if (distance > tolerance) return std::nullopt;
  return static_cast<std::size_t>(best - trajectory.begin());
}

std::optional<geometry::Se3> interpolatedPose(const Trajectory& trajectory, base::Stamp stamp,
                                              base::Duration longest_gap) {
  const auto after = firstNotBefore(trajectory, stamp);
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp == stamp) return after->world_from_body;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->stamp - before->stamp > longest_gap) return std::nullopt;
  const double share = base::secondsBetween(before->stamp, stamp) / base::secondsBetween(before->stamp, after->stamp);
  const auto& a = before->world_from_body;
  const auto& b = after->world_from_body;
  return geometry::Se3{a.rotation.slerp(share, b.rotation).normalized(),
                       (1 - share) * a.translation + share * b.translation};
}

std::vector<double> distanceTravelled(const Trajectory& trajectory) {
  std::vector<double> travel(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Eigen::Vector3d step =
        trajectory[i].world_from_body.translation - trajectory[i - 1].world_from_body.translation;
    travel[i] = travel[i - 1] + step.norm();
  }
  return travel;
}

}  // namespace omnimapper::eval
