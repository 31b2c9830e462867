#include "OdometryOfBase.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>

namespace omnimapper::ros {

std::string OdometryOfBase::move(const Waiting& waiting, const Transforms& transforms) {
  const auto& planned = plan_.odometry();
  const bool is_transform = waiting.role == Role::transforms;
  const bool is_planned = is_transform || planned.isOf(waiting.sensor.first);
  if (!is_planned && !has_planned_ && (planned.isTransform() || !planned.topic.empty()))
    return "before the first odometry that is used";
  if (is_transform && waiting.time <= last_transform_) return "a repetition";
  if (is_transform) last_transform_ = waiting.time;
  has_planned_ = has_planned_ || is_planned;
  const std::string &base = plan_.baseFrame(), &frame = waiting.measured.frame;
  if (frame == base || base.empty() || !transforms.connects(frame, base)) return "";
  const auto frame_from_base = transforms.between(frame, base, waiting.time, kHeldBack);
  if (!frame_from_base) return "no transform from " + frame + " to " + base + " at that time";
  auto& odometry = dynamic_cast<mrpt::obs::CObservationOdometry&>(*waiting.measured.observation);
  const auto odom_from_frame = geometry::lift(geometry::fromMrpt(odometry.odometry));
  odometry.odometry = mrpt::poses::CPose2D(geometry::toMrpt(geometry::project(odom_from_frame * *frame_from_base)));
  odometry.hasVelocities = false;
  return "";
}

}  // namespace omnimapper::ros
